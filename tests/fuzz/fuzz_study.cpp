// The study.json that a study goes on from.
#include <sstream>

#include "base/printable.hpp"
#include "fuzz_input.hpp"
#include "study/study_analysis.hpp"
#include "study/study_page.hpp"
#include "study/study_store.hpp"

namespace causticl {

void fuzz_study(const std::string& bytes) {
  read_or_refuse([&] {
    const Study study = study_from_json("study.json", bytes);
    const std::string text = study_json(study);
    promise(study_json(study_from_json("study.json", text)) == text, "a written study reads back the same");
    promise(difference_of(study, study).empty(), "a study is of the same things as itself");
    promise(!study_csv(study).empty(), "a study has a table");
    const StudyAnalysis analysis = analyse(study);
    promise(!study_page_data(study, analysis, "{}").empty(), "a study has a page");
    std::istringstream summary(printable(study_summary(study, analysis, "folder")));
    for (std::string line; std::getline(summary, line);) promise_for_terminal(line);
  });
}

}  // namespace causticl
