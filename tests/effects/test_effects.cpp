// What a scene calls for: found by reading it, and of no influence on the picture.
#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "catch2.hpp"
#include "device_fixture.hpp"
#include "effect_scenes.hpp"
#include "effects/effects.hpp"
#include "render/render_fixture.hpp"
#include "shared/effects.h"

using namespace causticl;
using Catch::Contains;
using Catch::Equals;

namespace {

std::string reason(const Effects& effects, unsigned bit) {
  for (const auto& effect : effects)
    if (effect.bit == bit) return effect.reason;
  return "no such effect";
}

std::vector<float> pixels_with(Scene scene, Integrator integrator, const std::string& effects) {
  scene.renderer.integrator = integrator;
  scene.renderer.passes = scene.renderer.samples = 2;
  scene.renderer.photons = 5000;
  RenderOptions options;
  options.effects = effects;
  return render_scene(scene, test_device(), options).picture.rgb;
}

/// The fraction of `one`'s values that `other` does not have to within rounding; a NaN is had by none.
double fraction_different(const std::vector<float>& one, const std::vector<float>& other) {
  REQUIRE(one.size() == other.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    different += !(std::fabs(one[i] - other[i]) <= 1e-5f * (std::fabs(one[i]) + std::fabs(other[i])));
  return static_cast<double>(different) / static_cast<double>(one.size());
}

/// Every bit, on a CPU. A GPU's quotients are 2.5 ulp off at worst, as OpenCL allows, and its compiler turns
/// them out one way or another by what stands around them: now and then a path takes another turn.
void check_same(const std::vector<float>& one, const std::vector<float>& other) {
  if (test_device().info().type == "cpu")
    CHECK(one == other);
  else
    CHECK(fraction_different(one, other) < 0.05);
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  const std::filesystem::path folder = CAUSTICL_SOURCE_DIR "/scenes";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".json") names.push_back(entry.path().lexically_relative(folder));
  std::sort(names.begin(), names.end());
  return names;
}

void check_all_equals_auto(const std::string& name, Integrator integrator) {
  INFO(name << (integrator == Integrator::pt ? ", pt" : ", sppm"));
  const Scene scene = shipped_scene(name, 24, 18);
  check_same(pixels_with(scene, integrator, "all"), pixels_with(scene, integrator, "auto"));
}

}  // namespace

TEST_CASE("every effect has a bit, a key of one word and a name") {
  const Effects effects = find_effects(Scene{});
  unsigned bits = 0;
  for (const auto& effect : effects) {
    CHECK(std::has_single_bit(effect.bit));
    CHECK(effect.bit > bits);
    CHECK(effect.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos);
    CHECK(!effect.name.empty());
    CHECK(effect.reason.empty());
    bits |= effect.bit;
  }
  CHECK(bits == EFFECT_ALL);
}

TEST_CASE("for every effect there is a scene that calls for it, and by what") {
  unsigned shown = 0;
  for (const auto& [key, with, without, reasons] : effect_scenes()) {
    INFO(key);
    const Effects called = find_effects(scene_from_text(with)),
                  spared = find_effects(scene_from_text(without));
    const unsigned bit = chosen_effects(find_effects(Scene{}), key);
    shown |= bit;
    CHECK_THAT(reason(called, bit), Equals(reasons));
    CHECK_THAT(reason(spared, bit), Equals(""));
    CHECK((effect_bits(called) & ~effect_bits(spared) & bit) == bit);
  }
  CHECK(shown == EFFECT_ALL);
}

TEST_CASE("reasons count the objects and name inline materials once") {
  const Effects effects = find_effects(scene_from_text(R"({
    "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 40},
    "materials": {"pane": {"type": "glass"}},
    "objects": [
      {"type": "sphere", "radius": 1, "material": {"type": "mirror"}},
      {"type": "sphere", "radius": 2, "material": "pane"},
      {"type": "sphere", "radius": 3, "material": "pane"}]})"));
  CHECK(reason(effects, EFFECT_SPHERES) == "sphere /objects/0 and 2 more");
  CHECK(reason(effects, EFFECT_MIRROR) == "mirror of /objects/0/material");
  CHECK(reason(effects, EFFECT_GLASS) == "glass of /materials/pane on /objects/1 and 1 more");
  CHECK(reason(effects, EFFECT_SHADOW_RAYS) == "");  // nothing to go to
}

TEST_CASE("a list of effects is read, and must hold what the scene calls for") {
  const Effects effects = find_effects(scene_from_text(effect_scenes().front().without));
  const unsigned called = effect_bits(effects);
  CHECK(chosen_effects(effects, "auto") == called);
  CHECK(chosen_effects(effects, "all") == EFFECT_ALL);
  std::string keys;
  for (const auto& effect : effects)
    if (effect.bit & called) keys += effect.key + ",";
  CHECK(chosen_effects(effects, keys + "curves") == (called | EFFECT_BEZIER));
  CHECK_THROWS_WITH(chosen_effects(effects, keys + "fog"),
                    Contains("no effect is called 'fog'") && Contains("auto, all, or a list of triangles, "));
  CHECK_THROWS_WITH(chosen_effects(effects, "curves"),
                    Contains("the scene calls for ") && Contains("/objects/") && Contains("expected a list"));
  CHECK_THROWS_AS(chosen_effects(effects, ""), UserError);
}

TEST_CASE("kernels compiled for every effect render the picture of those for what the scene calls for") {
  for (const auto& name : shipped_scenes())
    if (!name.starts_with("stress/"))
      check_all_equals_auto(name, shipped_scene(name, 1, 1).renderer.integrator);
}

TEST_CASE("so they do with the other integrator and on hard scenes", "[long]") {
  for (const auto& name : shipped_scenes()) {
    const Integrator own = shipped_scene(name, 1, 1).renderer.integrator;
    if (name.starts_with("stress/")) check_all_equals_auto(name, own);
    check_all_equals_auto(name, own == Integrator::pt ? Integrator::sppm : Integrator::pt);
  }
}

TEST_CASE("where photons carry all light, kernels with shadow rays in them shoot none") {
  Scene scene = shipped_scene("cornell_box.json", 24, 18);
  scene.renderer.direct_light = DirectLight::photons;
  check_same(pixels_with(scene, Integrator::sppm, "all"), pixels_with(scene, Integrator::sppm, "auto"));
}
