#include "study/study_plan.hpp"

#include <algorithm>
#include <stdexcept>

#include "scene/integrators.hpp"
#include "study/study_analysis.hpp"

namespace causticl {

namespace {

/// What the other values of a parameter are changes of: the scene as it is, by an integrator that has the
/// parameter.
RenderChange base_of(const StudyParameter& parameter, const ParameterContext& context,
                     const RenderChange& own) {
  return parameter.sppm_only && !traces_photons(context.scene.renderer.integrator)
             ? merged(own, integrator_change(Integrator::sppm))
             : own;
}

/// What "PARAMETER=VALUE" changes.
RenderChange change_of(const std::string& name, const std::string& value, const ParameterContext& context,
                       const RenderChange& own) {
  for (const StudyParameter& parameter : study_parameters()) {
    if (name != parameter.name) continue;
    const RenderChange base = base_of(parameter, context, own);
    for (const ParameterValue& other : parameter.others(context))
      if (other.label == value) return merged(base, other.change);
  }
  throw std::runtime_error("no setting is called " + name + "=" + value);
}

}  // namespace

void plan_settings(Study& study, const std::vector<const StudyParameter*>& parameters,
                   const ParameterContext& context, const RenderChange& own_change,
                   const std::string& sppm_fault) {
  const Integrator integrator = context.scene.renderer.integrator;
  const StudySetting own{"scene", "", own_change, passes_are_samples(integrator)};
  const StudySetting sppm{"integrator", "sppm", merged(own_change, integrator_change(Integrator::sppm)),
                          false};
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
    const StudySetting base = parameter->sppm_only && !traces_photons(integrator) ? sppm : own;
    add(base);
    for (const ParameterValue& value : others) {
      if (name == "integrator" && value.label == "sppm" && !sppm_fault.empty()) {
        study.left_out.push_back("integrator=sppm: " + sppm_fault);
        continue;
      }
      add({name, value.label, merged(base.change, value.change),
           value.change.integrator ? passes_are_samples(*value.change.integrator) : base.path_traced});
    }
    study.own_values[name] = parameter->own(context);
    study.bases[name] = base.id();
  }
}

void restore_settings(Study& study, const ParameterContext& context, const RenderChange& own) {
  for (StudySetting& setting : study.settings) {
    const std::vector<std::string> words = setting.change.words;
    if (setting.parameter == "combined") {
      setting.change = {};
      for (const auto& [name, value] : parts_of_combined(setting.value))
        setting.change = merged(setting.change, change_of(name, value, context, own));
    } else {
      setting.change =
          setting.parameter == "scene" ? own : change_of(setting.parameter, setting.value, context, own);
    }
    if (setting.change.words != words)
      throw std::runtime_error("the options of " + setting.id() + " are not those that it has now");
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
