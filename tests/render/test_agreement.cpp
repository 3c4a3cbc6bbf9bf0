// Two integrators, one truth: path tracing and SPPM of every shipped scene.
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>

#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// What each scene needs until noise and bias are well under the criterion. Glints of a lamp in
/// glass are found by camera paths alone: scenes with many take more passes of fewer photons.
struct Budget {
  const char* scene;
  int passes, photons, samples;
  int width = 64, height = 48;
  std::optional<double> radius = {};
  // Materials in the place of smooth glass and panes: path tracing never finds the caustics of point and
  // directional lights.
  std::vector<const char*> made_white = {};
};
const std::vector<Budget> budgets{
    {"1_textured_balls.json", 800, 50000, 8192},
    {"2_glass_knot.json", 800, 50000, 8192},
    {"3_bezier_solids.json", 400, 60000, 2048},
    {"4_focus_near.json", 96, 250000, 1024},
    {"5_focus_middle.json", 96, 250000, 1024},
    {"6_furnished_room.json", 400, 60000, 4096},
    {"7_sppm_room.json", 400, 60000, 4096},
    {"analytic_sphere.json", 64, 250000, 512},
    {"cornell_box.json", 96, 250000, 1024},
    {"furnace.json", 64, 250000, 512},
    {"glass_caustic.json", 12000, 5000, 40000, 32, 24, 0.4},
    {"tumbler.json", 8000, 10000, 65536, 32, 24, 0.3},
    {"effects/rough_metals.json", 800, 60000, 4096, 64, 40, 0.08},
    {"effects/point_lights.json", 400, 60000, 2048, 64, 40, 0.08},
    {"effects/sky.json", 8000, 10000, 65536, 32, 20, 0.06},
    {"effects/picture_lamp.json", 400, 60000, 4096, 64, 40, 0.08},
    {"effects/spot_caustic.json", 200, 60000, 4096, 64, 40, 0.08, {"materials.ball"}},
    {"effects/sun.json", 96, 100000, 1024, 64, 40, 0.1, {"materials.glass", "materials.blue"}},
    {"effects/leaded_window.json",
     400,
     60000,
     4096,
     64,
     40,
     0.1,
     {"materials.red", "materials.gold", "materials.green", "materials.blue", "materials.clear"}},
    {"effects/coloured_glass.json", 1600, 30000, 16384, 64, 40, 0.1},
    {"effects/prism.json", 4000, 30000, 160000, 32, 20, 0.1},
    {"effects/moving_balls.json", 1600, 30000, 16384, 64, 40, 0.1},
    {"effects/next_room.json", 400, 60000, 131072, 24, 18, 0.12},
    {"effects/tubes.json", 1600, 30000, 16384, 64, 40, 0.1},
    {"effects/clay.json", 800, 60000, 8192, 64, 40, 0.1},
    {"effects/fog.json", 2400, 300000, 16384, 64, 40, 0.2},
};

Scene scene_of(const Budget& budget, int width, int height) {
  SceneOptions options;
  options.size = {width, height};
  for (const char* material : budget.made_white)
    options.overrides.push_back({material, R"({"type": "diffuse", "color": [0.8, 0.8, 0.8]})"});
  return load_scene(std::string(CAUSTICL_SOURCE_DIR) + "/scenes/" + budget.scene, options);
}

}  // namespace

TEST_CASE("every shipped scene has a budget here") {
  std::set<std::string> shipped, known;
  const std::filesystem::path folder = std::string(CAUSTICL_SOURCE_DIR) + "/scenes";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    // Those of stress/ are compared with their easy forms, in test_stress.
    if (entry.path().extension() == ".json" && !name.starts_with("stress/")) shipped.insert(name);
  }
  for (const auto& budget : budgets) known.insert(budget.scene);
  CHECK(shipped == known);
}

TEST_CASE("every shipped scene renders with both integrators to about the same brightness") {
  for (const auto& budget : budgets) {
    INFO(budget.scene);
    Scene scene = scene_of(budget, 32, 24);
    scene.renderer.photons = 50000;
    const auto sppm = render_with(scene, Integrator::sppm, 8);
    const auto pt = render_with(scene, Integrator::pt, 128);
    CHECK(sppm.statistics.diagnostics.non_finite == 0);
    CHECK(pt.statistics.diagnostics.non_finite == 0);
    CHECK(mean_luminance(pt.picture) > 0.01);
    // A coarse check of a coarse picture; the long test has the real criterion.
    CHECK(mean_luminance(sppm.picture) == Approx(mean_luminance(pt.picture)).epsilon(0.1));
  }
}

TEST_CASE("on every shipped scene path tracing and SPPM agree", "[long]") {
  for (const auto& budget : budgets) {
    DYNAMIC_SECTION(budget.scene) {
      Scene scene = scene_of(budget, budget.width, budget.height);
      scene.renderer.photons = budget.photons;
      if (budget.radius) scene.renderer.radius = budget.radius;
      const Picture sppm = render_with(scene, Integrator::sppm, budget.passes).picture;
      const Picture pt = render_with(scene, Integrator::pt, budget.samples).picture;
      const double brightness = mean_luminance(sppm) / mean_luminance(pt);
      const double difference = relative_mse(box_filtered(sppm, 4), box_filtered(pt, 4));
      std::printf("%-24s brightness ratio %.5f, relative MSE %.2e\n", budget.scene, brightness, difference);
      std::fflush(stdout);
      CHECK(brightness == Approx(1).epsilon(0.005));
      CHECK(difference < 1e-3);
    }
  }
}
