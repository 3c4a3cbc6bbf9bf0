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
/// first. `own` is an --integrator of the user. `sppm_fault` says why photon mapping cannot render the scene;
/// empty where it can.
void plan_settings(Study& study, const std::vector<const StudyParameter*>& parameters,
                   const ParameterContext& context, const RenderChange& own, const std::string& sppm_fault);

/// Gives the settings of a study that was read back what they change, which its file says in words alone.
/// Throws std::runtime_error for a setting that is none of the plan's, or says something else.
void restore_settings(Study& study, const ParameterContext& context, const RenderChange& own);

/// How long each short run takes and with how many seeds, so that all settings fit into `seconds`: at least
/// three passes of `pass_seconds` each, and two seeds. Settings at the end of the list are dropped where even
/// that does not fit, and said to be left out. `overhead` is what a run takes besides its passes.
void plan_runs(Study& study, double seconds, double pass_seconds, double overhead, int wanted_seeds);

}  // namespace causticl
