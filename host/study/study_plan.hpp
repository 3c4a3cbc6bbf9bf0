// What a study renders, and how its budget is shared out.
#pragma once

#include <string>
#include <vector>

#include "study/study_parameters.hpp"
#include "study/study_store.hpp"

namespace causticl {

/// Parts of the budget, as the fraction of it that is spent when each ends.
struct StudyBudget {
  double seconds = 300;
  bool own_reference = true;
  double reference_end() const { return own_reference ? 0.28 * seconds : 0; }
  double short_runs_end() const { return (own_reference ? 0.66 : 0.55) * seconds; }
  double long_runs_end() const { return 0.96 * seconds; }
};

/// Fills in the settings, the parameters' own values and what each is compared with; the scene as it is comes
/// first. `own_words` are those of an --integrator of the user. `sppm_fault` says why photon mapping cannot
/// render the scene; empty where it can.
void plan_settings(Study& study, const std::vector<const StudyParameter*>& parameters,
                   const ParameterContext& context, const std::vector<std::string>& own_words,
                   const std::string& sppm_fault);

/// How long each short run takes and with how many seeds, so that all settings fit into `seconds`: at least
/// three passes of `pass_seconds` each, and two seeds. Settings at the end of the list are dropped where even
/// that does not fit, and said to be left out. `overhead` is what a run takes besides its passes.
void plan_runs(Study& study, double seconds, double pass_seconds, double overhead, int wanted_seeds);

/// `more` after `words`; of an option other than -D that both have, the later value is kept.
std::vector<std::string> merged_words(const std::vector<std::string>& words,
                                      const std::vector<std::string>& more);

}  // namespace causticl
