// What a study found, for people: a page that needs nothing but itself, and lines for the terminal.
#pragma once

#include <string>

#include "study/study_analysis.hpp"
#include "study/study_store.hpp"

namespace causticl {

/// The parts of the page, from host/study/study_page.{html,css,plot.js,js}, that travel inside the binary.
extern const char* const study_page_html;
extern const char* const study_page_css;
extern const char* const study_page_plot_js;
extern const char* const study_page_js;

/// Writes study.html into `folder`, with the pictures that it holds. Throws UserError.
void write_study_page(const std::string& folder, const Study& study, const StudyAnalysis& analysis);

/// All numbers of the page as one JSON object: the study, its analysis and the table of parameters.
std::string study_page_data(const Study& study, const StudyAnalysis& analysis, const std::string& insets);

/// What the study recommends, and where the page is.
std::string study_summary(const Study& study, const StudyAnalysis& analysis, const std::string& folder);

}  // namespace causticl
