// Stress scenes: each hard case beside the same picture made the easy way.
#include <cstdio>
#include <filesystem>
#include <set>

#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// What each pair needs until the noise of both is well under the criterion, by path tracing or photon
/// mapping.
struct Budget {
  const char* name;
  Integrator integrator;
  int passes, photons = 50000;
};
const std::vector<Budget> budgets{
    {"bezier_goblet", Integrator::sppm, 600}, {"duplicates", Integrator::sppm, 600},
    {"far_room", Integrator::sppm, 400},      {"grazed_sphere", Integrator::pt, 4096},
    {"needle_glass", Integrator::sppm, 600},  {"nested_glass", Integrator::sppm, 600},
    {"tiny_light", Integrator::sppm, 400},
};

struct Pair {
  Picture hard, easy;
};

/// Both pictures at 64 x 48 with different seeds: what they have in common is not noise.
Pair render_pair(const Budget& budget, int passes) {
  const auto render = [&](const std::string& name, unsigned seed) {
    Scene scene = shipped_scene("stress/" + name + ".json", 64, 48);
    scene.renderer.photons = budget.photons;
    scene.renderer.visible_points = 1;
    const RenderResult result = render_with(scene, budget.integrator, passes, seed);
    CHECK(result.statistics.diagnostics.non_finite == 0);
    CHECK(result.statistics.diagnostics.traversal_bound == 0);
    return result.picture;
  };
  return {render(budget.name, 1), render(std::string(budget.name) + "_easy", 2)};
}

}  // namespace

TEST_CASE("every stress scene has its easy form and a budget here") {
  std::set<std::string> shipped, known;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(CAUSTICL_SOURCE_DIR) + "/scenes/stress"))
    if (entry.path().extension() == ".json") shipped.insert(entry.path().stem().string());
  for (const auto& budget : budgets) {
    known.insert(budget.name);
    known.insert(std::string(budget.name) + "_easy");
  }
  CHECK(shipped == known);
}

TEST_CASE("stress scenes look like their easy forms") {
  for (const auto& budget : budgets) {
    INFO(budget.name);
    const auto [hard, easy] = render_pair(budget, budget.integrator == Integrator::pt ? 64 : 12);
    CHECK(mean_luminance(easy) > 0.05);
    // A coarse check of coarse pictures; the long test has the real criterion.
    CHECK(mean_luminance(hard) == Approx(mean_luminance(easy)).epsilon(0.05));
    CHECK(relative_mse(box_filtered(hard, 8), box_filtered(easy, 8)) < 0.02);
  }
}

TEST_CASE("stress scenes converge to the pictures of their easy forms", "[long]") {
  for (const auto& budget : budgets) {
    DYNAMIC_SECTION(budget.name) {
      const auto [hard, easy] = render_pair(budget, budget.passes);
      const double brightness = mean_luminance(hard) / mean_luminance(easy);
      const double difference = relative_mse(box_filtered(hard, 4), box_filtered(easy, 4));
      std::printf("%-24s brightness ratio %.5f, relative MSE %.2e\n", budget.name, brightness, difference);
      std::fflush(stdout);
      CHECK(brightness == Approx(1).epsilon(0.005));
      CHECK(difference < 1e-3);
    }
  }
}
