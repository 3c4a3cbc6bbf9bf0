// What effects cost on a device: pairs of small renders, with and without.
#include <algorithm>

#include "render/explain.hpp"
#include "scene/integrators.hpp"
#include "scene/material_kind.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr int longest_side = 160;  // pixels

/// Small enough for tens of renders, large enough to fill a device for a few milliseconds.
Scene small_scene(Scene scene) {
  const double scale = std::min(1.0, static_cast<double>(longest_side) / std::max(scene.width, scene.height));
  scene.width = std::max(1, static_cast<int>(scene.width * scale));
  scene.height = std::max(1, static_cast<int>(scene.height * scale));
  scene.renderer.photons = std::min<std::int64_t>(scene.renderer.photons, 50000);
  scene.renderer.passes = 2;
  scene.renderer.samples = 4;
  return scene;
}

/// Milliseconds of all kernels of a render.
double kernel_milliseconds(const Scene& scene, Device& device, const RenderOptions& options) {
  double sum = 0;
  for (const auto& [name, time] : render_scene(scene, device, options).statistics.kernels)
    sum += time.milliseconds;
  return sum;
}

/// Of the materials of an effect, diffuse ones of the same colour.
Scene with_diffuse(Scene scene, unsigned effect) {
  for (auto& material : scene.materials) {
    if (effect_of(material.kind) != effect) continue;
    if (length(material.eta) > 0) material.color = {0.8, 0.8, 0.8};  // of a conductor, which has no colour
    material.kind = MaterialSpec::Kind::diffuse;
    material.roughness = 0;
  }
  return scene;
}

/// Alternating pairs, so that what else the machine does falls on both alike. The first pair, which compiles,
/// does not count.
template <typename With, typename Without>
EffectCost measured(const std::string& compared, int pairs, const With& with, const Without& without) {
  with();
  without();
  std::vector<double> ratios;
  for (int pair = 0; pair < pairs; ++pair) {
    const double first = with(), second = without();
    if (second > 0) ratios.push_back(first / second);
  }
  std::sort(ratios.begin(), ratios.end());
  const std::size_t count = ratios.size();
  if (count == 0) return {compared, 1, 0};
  return {compared, ratios[count / 2], (ratios[count * 3 / 4] - ratios[count / 4]) / 2};
}

}  // namespace

std::optional<std::pair<Scene, std::string>> scene_without(const Scene& scene, unsigned effect) {
  Scene plain = scene;
  switch (effect) {
    case EFFECT_LENS:
      plain.camera.aperture = 0;
      return std::pair{plain, "a pinhole"};
    case EFFECT_SHADOW_RAYS:
      if (!traces_photons(scene.renderer.integrator)) return {};
      plain.renderer.direct_light = DirectLight::photons;
      return std::pair{plain, "direct light by photons"};
    case EFFECT_TEXTURES:
      for (auto& material : plain.materials) {
        if (material.color_texture >= 0) material.color = {0.5, 0.5, 0.5};
        material.color_texture = -1;
      }
      return std::pair{plain, "plain grey"};
    case EFFECT_ROUGH:
      for (auto& material : plain.materials) material.roughness = 0;
      return std::pair{plain, "smooth surfaces"};
    case EFFECT_ABSORPTION:
      for (auto& material : plain.materials) material.absorption = {};
      return std::pair{plain, "clear glass"};
    case EFFECT_DISPERSION:
      for (auto& material : plain.materials) material.dispersion = 0;
      return std::pair{plain, "one index for all wavelengths"};
    case EFFECT_SMOOTH:
      for (auto& object : plain.objects) object.smooth = false;
      return std::pair{plain, "flat faces"};
    case EFFECT_MOTION:
      for (auto& object : plain.objects) object.motion = {};
      return std::pair{plain, "a still"};
    case EFFECT_MEDIUM:
      plain.medium = {};
      return std::pair{plain, "empty space"};
    default:
      if ((effect & effects_of_kinds(REFLECTS | TRANSMITS)) == 0) return {};
      return std::pair{with_diffuse(scene, effect), "diffuse surfaces"};
  }
}

void measure_effects(Explanation& explanation, const Scene& scene, Device& device,
                     const RenderOptions& options, const std::function<void(const std::string&)>& report,
                     int pairs) {
  explanation.device = device.info().name;
  if (passes_to_run(explanation.passes).empty()) return;
  const Scene small = small_scene(scene);
  const Effects effects = find_effects(small);
  const unsigned called = effect_bits(effects);
  const auto time_of = [&](const Scene& which, const std::string& compiled) {
    RenderOptions each = options;
    each.effects = compiled;
    return kernel_milliseconds(which, device, each);
  };
  for (auto& row : explanation.effects) {
    if (report) report(row.effect.key);
    if (!row.effect.reason.empty()) {
      if (const auto without = scene_without(small, row.effect.bit))
        row.cost = measured(
            "with it, against " + without->second, pairs, [&] { return time_of(small, "auto"); },
            [&] { return time_of(without->first, "auto"); });
      continue;
    }
    const bool read =
        std::any_of(explanation.passes.begin(), explanation.passes.end(), [&](const PassPlan& pass) {
          return pass.skipped.empty() && (effects_of_pass(pass.name) & row.effect.bit);
        });
    if (!read) continue;
    std::string list;
    for (const auto& effect : effects)
      if (effect.bit & (called | row.effect.bit)) list += (list.empty() ? "" : ",") + effect.key;
    row.cost = measured(
        "compiled in, against left out", pairs, [&] { return time_of(small, list); },
        [&] { return time_of(small, "auto"); });
  }
}

}  // namespace causticl
