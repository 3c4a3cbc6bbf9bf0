#include "study/study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "base/error.hpp"
#include "scene/integrators.hpp"
#include "study/study_analysis.hpp"
#include "study/study_page.hpp"
#include "study/study_session.hpp"

namespace causticl {
namespace {

/// Of the runs that go on for long; short ones count up from the seed itself.
std::uint32_t long_seed(std::uint32_t seed) { return seed + 1000000; }

constexpr std::uint32_t most_seeds = 16;
constexpr int most_long_runs = 3;

/// Looks at the scene with a pass, and lists what will be rendered; a study that goes on has its list.
void plan(StudySession& session) {
  Study& study = session.study;
  const RenderSetup setup = session.renderer.setup_of(session.own_change);
  const Scene& scene = setup.scene;
  const bool fp64 = find_device(session.request.device).fp64;
  if (!study.settings.empty()) try {
      return restore_settings(study, {scene, study.first_radius, fp64}, session.own_change);
    } catch (const std::runtime_error& error) {
      throw UserError(session.path("study.json") + ": not a study that this version wrote (" + error.what() +
                      "); --restart begins it anew");
    }
  std::string sppm_fault;
  try {
    const StudySetting sppm{"sppm", "", merged(session.own_change, integrator_change(Integrator::sppm)),
                            false};
    const auto one_pass =
        session.renderer.render(sppm, study.seed, nullptr, [](const RenderState&) { return true; });
    study.first_radius = one_pass.first_radius;
  } catch (const UserError& error) {
    if (traces_photons(scene.renderer.integrator)) throw;
    sppm_fault = error.what();
  }
  plan_settings(study, wanted_parameters(session.request.study.parameters), {scene, study.first_radius, fp64},
                session.own_change, sppm_fault);
}

/// One run of `seconds` of passes, or to the point of the budget where `end` is; false if it was interrupted.
bool measure(StudySession& session, const StudySetting& setting, std::uint32_t seed, double seconds,
             double end, bool is_long) {
  // A long run has shown what it can when it is below the smallest error that anybody asks for.
  const double enough = study_targets.back();
  auto measured = session.renderer.render(setting, seed, &session.reference, [&](const RenderState& now) {
    const bool done = is_long && !now.run.samples.empty() && now.run.samples.back().error_90 < enough;
    return done || session.interrupted() || now.seconds + now.last_pass / 2 > seconds ||
           session.spent() + now.last_pass > end;
  });
  if (session.interrupted()) return false;
  measured.run.is_long = is_long;
  if (seed == session.study.seed) write_picture(session.path(picture_name(setting)), measured.picture, {});
  const StudySample& last = measured.run.samples.back();
  char text[160];
  std::snprintf(text, sizeof text, ", seed %u: %llu passes in %.1f s, 90%% of pixels within %.3g%%", seed,
                static_cast<unsigned long long>(last.passes), last.seconds, 100 * last.error_90);
  session.study.runs.push_back(std::move(measured.run));
  session.save();
  session.say(setting.id() + text);
  return true;
}

/// Every setting with one seed, then with the next, so that wherever the budget ends all have about as many.
bool measure_short_runs(StudySession& session) {
  Study& study = session.study;
  const double end = session.budget.short_runs_end();
  if (study.run_seconds == 0) {
    // What a pass takes, and what a run takes besides, told by the scene as it is.
    const auto pilot =
        session.renderer.render(study.settings[0], study.seed, nullptr,
                                [](const RenderState& now) { return now.seconds > now.last_pass; });
    const double pass = pilot.pass_seconds / static_cast<double>(pilot.passes);
    const double overhead = pilot.seconds - pilot.pass_seconds + pass;  // a pass warms up each setting
    plan_runs(study, end - session.spent(), pass, overhead, session.request.study.seeds);
    char text[160];
    std::snprintf(text, sizeof text,
                  "%zu settings, %d seeds, %.1f s of passes each; %.0f s of the budget are spent",
                  study.settings.size(), study.seeds, study.run_seconds, session.spent());
    session.save();
    session.say(text);
  }
  double longest = study.run_seconds;
  for (std::uint32_t round = 0; round < most_seeds; ++round)
    for (std::size_t i = 0; i < study.settings.size(); ++i) {
      const StudySetting setting = study.settings[i];
      const std::uint32_t seed = study.seed + round;
      if (study.run(setting, seed, false)) continue;
      // At least the scene itself is measured, whatever the budget.
      if (!study.runs.empty() && session.spent() + longest > end) continue;
      const double before = session.spent();
      if (!measure(session, setting, seed, study.run_seconds, session.budget.long_runs_end(), false))
        return false;
      longest = std::max(study.run_seconds, std::min(session.spent() - before, 1.5 * study.run_seconds));
    }
  return true;
}

/// The best values of all parameters together, which may beat each alone, or may not.
bool measure_combined(StudySession& session) {
  Study& study = session.study;
  const auto known =
      std::find_if(study.settings.begin(), study.settings.end(),
                   [](const StudySetting& setting) { return setting.parameter == "combined"; });
  if (known != study.settings.end()) return true;
  const auto combined = combined_setting(study, analyse(study));
  if (!combined || session.spent() + 2 * study.run_seconds > session.budget.long_runs_end()) return true;
  study.settings.push_back(*combined);
  study.bases["combined"] = study.settings[0].path_traced ? "integrator=sppm" : "scene";
  return measure(session, *combined, study.seed, study.run_seconds, session.budget.long_runs_end(), false);
}

/// The setting that promises an error the soonest of those that have not gone on for long with `seed` yet and
/// are not known well: of 2%, or of the least of which any does. None where none comes near.
const StudySetting* most_promising(const Study& study, const StudyAnalysis& analysis, std::uint32_t seed) {
  constexpr std::size_t smallest = 2;  // of study_targets
  for (std::size_t target = smallest + 1; target-- > 0;) {
    const StudySetting* best = nullptr;
    double least = HUGE_VAL;
    for (const auto& candidate : analysis.settings) {
      const Reach& reach = candidate.error_90[target];
      const Reach& last = candidate.error_90.back();
      const bool all_is_known = last.reached && !last.extrapolated;
      if (!reach.reached || reach.seconds >= least || all_is_known ||
          study.run(candidate.setting, seed, true))
        continue;
      least = reach.seconds;
      best = &candidate.setting;
    }
    if (best) return best;
  }
  return nullptr;
}

/// What is left of the budget shows how the most promising settings go on.
bool measure_long_runs(StudySession& session) {
  Study& study = session.study;
  const std::uint32_t seed = long_seed(study.seed);
  for (int i = 0; i < most_long_runs; ++i) {
    const double left = session.budget.long_runs_end() - session.spent();
    if (left < 4 * study.run_seconds) return true;
    const StudyAnalysis analysis = analyse(study);
    const StudySetting* best = most_promising(study, analysis, seed);
    if (!best) return true;
    const double end = session.spent() + (i + 1 < most_long_runs ? 0.6 : 1.0) * left;
    if (!measure(session, *best, seed, HUGE_VAL, end, true)) return false;
  }
  return true;
}

}  // namespace

StudyOutcome run_study(const StudyRequest& request, KernelCache& kernels,
                       const std::function<void(const std::string&)>& say,
                       const std::function<bool()>& interrupted) {
  StudySession session(request, kernels, say, interrupted);
  StudyOutcome outcome;
  plan(session);
  try {
    if (!interrupted()) make_reference(session);
    outcome.interrupted = interrupted() || !measure_short_runs(session) || !measure_combined(session) ||
                          !measure_long_runs(session);
  } catch (const Interrupted&) {
    outcome.interrupted = true;
  }
  session.save();
  if (!session.study.reference) return outcome;
  const StudyAnalysis analysis = analyse(session.study);
  write_study_page(session.folder, session.study, analysis);
  outcome.summary = study_summary(session.study, analysis, session.folder);
  return outcome;
}

}  // namespace causticl
