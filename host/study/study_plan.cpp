#include "study/study_plan.hpp"

#include <algorithm>

namespace causticl {

std::vector<std::string> merged_words(const std::vector<std::string>& words,
                                      const std::vector<std::string>& more) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i + 1 < words.size(); i += 2)  // every option here takes one value
    if (words[i] == "-D" || std::find(more.begin(), more.end(), words[i]) == more.end())
      result.insert(result.end(), {words[i], words[i + 1]});
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

void plan_settings(Study& study, const std::vector<const StudyParameter*>& parameters,
                   const ParameterContext& context, const std::vector<std::string>& own_words,
                   const std::string& sppm_fault) {
  const bool own_pt = context.scene.renderer.integrator == Integrator::pt;
  const StudySetting own{"scene", "", own_words, own_pt};
  const StudySetting sppm{"integrator", "sppm", merged_words(own_words, {"--integrator", "sppm"}), false};
  study.settings = {own};
  const auto add = [&](const StudySetting& setting) {
    if (!study.setting(setting.parameter, setting.value)) study.settings.push_back(setting);
  };
  for (const StudyParameter* parameter : parameters) {
    const std::string name = parameter->name;
    if (parameter->sppm_only && !sppm_fault.empty()) {
      study.left_out.push_back(name + ": photon mapping cannot render this scene: " + sppm_fault);
      continue;
    }
    const auto others = parameter->others(context);
    if (others.empty()) {
      study.left_out.push_back(name + ": there is nothing to choose in this scene or on this device");
      continue;
    }
    const StudySetting base = parameter->sppm_only && own_pt ? sppm : own;
    add(base);
    for (const ParameterValue& value : others) {
      if (name == "integrator" && value.label == "sppm" && !sppm_fault.empty()) {
        study.left_out.push_back("integrator=sppm: " + sppm_fault);
        continue;
      }
      add({name, value.label, merged_words(base.words, value.words),
           name == "integrator" ? value.label == "pt" : base.path_traced});
    }
    study.own_values[name] = parameter->own(context);
    study.bases[name] = base.id();
  }
}

void plan_runs(Study& study, double seconds, double pass_seconds, double overhead, int wanted_seeds) {
  constexpr double fewest_passes = 3;
  constexpr int fewest_seeds = 2;
  const double needed = fewest_passes * pass_seconds;
  const auto seconds_a_run = [&](std::size_t settings, int seeds) {
    return seconds / (static_cast<double>(settings) * seeds) - overhead;
  };
  study.seeds = wanted_seeds;
  while (study.seeds > fewest_seeds && seconds_a_run(study.settings.size(), study.seeds) < 2 * needed)
    --study.seeds;
  while (study.settings.size() > 1 && seconds_a_run(study.settings.size(), study.seeds) < needed) {
    study.left_out.push_back(study.settings.back().id() + ": no time for it within the budget");
    study.settings.pop_back();
  }
  study.run_seconds = std::max(seconds_a_run(study.settings.size(), study.seeds), pass_seconds);
}

}  // namespace causticl
