// `causticl explain`: every effect in one table, with what it costs where that is measured.
#include "render/explain.hpp"

#include <nlohmann/json.hpp>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "effect_scenes.hpp"
#include "render/render_fixture.hpp"
#include "shared/effects.h"

using namespace causticl;
using Catch::Contains;

namespace {

const ExplainedEffect& row_of(const Explanation& explanation, unsigned bit) {
  for (const auto& row : explanation.effects)
    if (row.effect.bit == bit) return row;
  throw std::logic_error("no such effect");
}

const std::string glass_ball = effect_scene(ball_of(R"({"type": "glass"})"));

}  // namespace

TEST_CASE("an explanation names what calls for each effect and the programs that hold it") {
  const Explanation explanation = explain(scene_from_text(glass_ball));
  CHECK(explanation.effects.size() == find_effects(Scene{}).size());
  const auto& glass = row_of(explanation, EFFECT_GLASS);
  CHECK(glass.effect.reason == "glass of /objects/2/material");
  CHECK(glass.passes == std::vector<std::string>{"photon", "camera"});
  CHECK(!glass.cost);
  CHECK(row_of(explanation, EFFECT_LENS).passes.empty());
  const std::string table = explanation_table(explanation);
  for (const auto& row : explanation.effects) CHECK_THAT(table, Contains("\n" + row.effect.key + " "));
  CHECK_THAT(table, Contains("glass of /objects/2/material") && Contains("photon, camera"));

  const auto json = nlohmann::json::parse(explanation_json(explanation));
  CHECK(json["effects"].size() == explanation.effects.size());
  CHECK(json["effects"][7]["key"] == "glass");
  CHECK(json["effects"][7]["called_for"] == true);
  CHECK(json["effects"][8]["called_for"] == false);
  CHECK(json["passes"][0]["runs"] == true);
}

TEST_CASE("an explanation tells of passes that are left out") {
  Scene scene = scene_from_text(glass_ball);
  scene.max_depth = 1;
  CHECK_THAT(explanation_table(explain(scene)), Contains("skipped: max_depth is 1"));
  CHECK(row_of(explain(scene), EFFECT_GLASS).passes == std::vector<std::string>{"camera"});
  for (auto& material : scene.materials) material.emission = {0, 0, 0};
  CHECK_THAT(explanation_table(explain(scene)), Contains("skipped: nothing emits light"));
}

TEST_CASE("what can be left out of a scene is, and nothing else") {
  const unsigned replaceable = EFFECT_LENS | EFFECT_SHADOW_RAYS | EFFECT_TEXTURES | EFFECT_ROUGH |
                               EFFECT_MIRROR | EFFECT_GLASS | EFFECT_CONDUCTOR | EFFECT_PLASTIC |
                               EFFECT_ABSORPTION | EFFECT_DISPERSION | EFFECT_MOTION | EFFECT_MEDIUM |
                               EFFECT_SMOOTH | EFFECT_THIN_GLASS;
  for (const auto& [key, with, without, reason] : effect_scenes()) {
    INFO(key);
    const Scene scene = scene_from_text(with);
    const unsigned bit = chosen_effects(find_effects(Scene{}), key),
                   before = effect_bits(find_effects(scene));
    const auto plain = scene_without(scene, bit);
    CHECK(plain.has_value() == ((replaceable & bit) != 0));
    // Dielectrics that touch something go with the glass.
    const unsigned gone = bit == EFFECT_GLASS ? bit | EFFECT_NESTED : bit;
    if (plain) CHECK((effect_bits(find_effects(plain->first)) & (before | bit)) == (before & ~gone));
  }
}

TEST_CASE("measuring gives a ratio and its spread for every effect that a program may hold") {
  const Scene scene = scene_from_text(effect_scene(""));
  Explanation explanation = explain(scene);
  std::vector<std::string> told;
  RenderOptions options;
  measure_effects(
      explanation, scene, test_device(), options, [&](const std::string& key) { told.push_back(key); }, 3);
  CHECK(told.size() == explanation.effects.size());
  CHECK(explanation.device == test_device().info().name);
  for (const auto& [effect, passes, cost] : explanation.effects) {
    INFO(effect.key);
    const bool geometry = effect.bit == EFFECT_TRIANGLES || effect.bit == EFFECT_SPHERES,
               host_only = effect.bit == EFFECT_MOTION;
    REQUIRE(cost.has_value() == !(geometry || host_only));  // what cannot be left out, what no kernel reads
    if (!cost) continue;
    CHECK(cost->ratio > 0.05);
    CHECK(cost->ratio < 20);
    CHECK(cost->spread >= 0);
    CHECK(cost->compared == (effect.bit == EFFECT_SHADOW_RAYS ? "with it, against direct light by photons"
                                                              : "compiled in, against left out"));
  }
  CHECK_THAT(explanation_table(explanation), Contains("cost "));
}
