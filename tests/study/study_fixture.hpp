// Studies made up for tests, whose curves are known.
#pragma once

#include <cmath>

#include "study/study_store.hpp"

namespace causticl {

/// A run whose relative MSE is mse * passes^slope, with a pass of `pass_seconds`.
inline StudyRun made_run(const StudySetting& setting, std::uint32_t seed, double mse, double slope,
                         double pass_seconds, std::uint64_t last, bool is_long = false) {
  StudyRun run;
  run.parameter = setting.parameter;
  run.value = setting.value;
  run.seed = seed;
  run.is_long = is_long;
  run.setup_seconds = 0.25;
  run.kernel_milliseconds = {{"gather_photons", 3.0 * static_cast<double>(last)},
                             {"trace_photons", 5.0 * static_cast<double>(last)}};
  for (std::uint64_t passes = 1; passes <= last; passes *= 2) {
    StudySample sample;
    sample.passes = passes;
    sample.photons = 1000 * passes;
    sample.seconds = pass_seconds * static_cast<double>(passes);
    sample.relative_mse = mse * std::pow(static_cast<double>(passes), slope);
    sample.error_90 = 1.5 * std::sqrt(sample.relative_mse);
    sample.flip = 0.1;
    sample.mean = 1.0 / 3;
    run.samples.push_back(sample);
  }
  return run;
}

/// The scene as it is (slope -2/3), a quicker setting that stops improving, and path tracing (slope -1).
inline Study made_study() {
  Study study;
  study.scene = "scenes/a \"b\".json";
  study.scene_hash = "0123";
  study.version = CAUSTICL_VERSION;
  study.device = "a device";
  study.words = {"--size", "40x30", "-D", "objects.0.name=it's"};
  study.width = 40;
  study.height = 30;
  study.date = "2026-01-02";
  study.run_seconds = 6.4;
  study.seeds = 2;
  study.first_radius = 0.1;
  study.settings = {{"scene", "", {}, false},
                    {"max_depth", "2", {{"-D", "max_depth=2"}}, false},
                    {"integrator", "pt", integrator_change(Integrator::pt), true}};
  study.own_values = {{"max_depth", "16"}, {"integrator", "sppm"}};
  study.bases = {{"max_depth", "scene"}, {"integrator", "scene"}};
  study.left_out = {"alpha, beta: \"no time\""};
  study.spent_seconds = 12.5;
  study.reference = StudyReference{"two\nhalves", 1e-6, 1e-4, 0.5, 3};
  for (const std::uint32_t seed : {1u, 2u}) {
    const double noise = seed == 1 ? 0.9 : 1.1;
    study.runs.push_back(made_run(study.settings[0], seed, 0.04 * noise + 1e-6, -2.0 / 3, 0.1, 64));
    study.runs.push_back(made_run(study.settings[1], seed, 0.03 * noise + 1e-6, -0.01, 0.05, 64));
    study.runs.push_back(made_run(study.settings[2], seed, 0.09 * noise + 1e-6, -1, 0.1, 64));
  }
  return study;
}

}  // namespace causticl
