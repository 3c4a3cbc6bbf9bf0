// `causticl explain`: what a scene calls for, by what, what is compiled and run because of it, and what it
// costs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "effects/effects.hpp"
#include "effects/passes.hpp"
#include "render/render.hpp"

namespace causticl {

/// What an effect costs, as a ratio of kernel times of two small renders.
struct EffectCost {
  std::string compared;          // "with it, against a pinhole"
  double ratio = 1, spread = 0;  // median of the pairs, and half the distance between their quartiles
};

/// One row of the table.
struct ExplainedEffect {
  Effect effect;
  std::vector<std::string> passes;  // those of this render whose program contains it
  std::optional<EffectCost> cost;   // where it was measured
};

struct Explanation {
  std::string scene, integrator, device;  // the device is empty where nothing was measured
  std::vector<ExplainedEffect> effects;
  std::vector<PassPlan> passes;
  std::vector<std::string> kept;     // what is done for every scene alike, and why
  std::vector<std::string> decided;  // by the pilot of SPPM, where a device ran it
};

/// Needs no device.
Explanation explain(const Scene& scene);

/// Adds what the pilot of SPPM decides, which takes a device: see pilot.hpp.
void explain_pilot(Explanation& explanation, const Scene& scene, Device& device,
                   const RenderOptions& options);

/// Adds the costs on `device`: of an absent effect the time of the kernels with its code compiled in against
/// without; of a present one, where it can be left out (measurable_without), the time with it against
/// without. Each is the median of `pairs` alternating pairs of small renders. `report` is told each effect
/// before it is measured.
void measure_effects(Explanation& explanation, const Scene& scene, Device& device,
                     const RenderOptions& options, const std::function<void(const std::string&)>& report = {},
                     int pairs = 5);

/// The scene without a present effect and what took its place ("a pinhole"); nothing where the picture would
/// be of another scene.
std::optional<std::pair<Scene, std::string>> scene_without(const Scene& scene, unsigned effect);

/// The table, and the same as one JSON object.
std::string explanation_table(const Explanation& explanation);
std::string explanation_json(const Explanation& explanation);

}  // namespace causticl
