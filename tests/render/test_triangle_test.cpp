// Whole pictures by both ways in which rays can meet triangles.
#include <catch2/catch.hpp>

#include "device_fixture.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

RenderResult render_knot(TriangleTest triangle_test, Integrator integrator) {
  Scene scene = shipped_scene("2_glass_knot.json", 64, 48);
  scene.renderer.integrator = integrator;
  scene.renderer.passes = scene.renderer.samples = 4;
  scene.renderer.photons = 50000;
  RenderOptions options;
  options.triangle_test = triangle_test;
  return render_scene(scene, test_device(), options);
}

}  // namespace

TEST_CASE("both triangle tests give the same picture but for roundings and leaks") {
  for (const auto integrator : {Integrator::sppm, Integrator::pt}) {
    const auto watertight = render_knot(TriangleTest::watertight, integrator);
    const auto precomputed = render_knot(TriangleTest::precomputed, integrator);
    // Hits differ in their last digits, so some paths do; the seed is the same, so most do not.
    CHECK(watertight.picture.rgb != precomputed.picture.rgb);
    std::size_t same = 0;
    for (std::size_t i = 0; i < watertight.picture.rgb.size(); ++i)
      same += std::fabs(watertight.picture.rgb[i] - precomputed.picture.rgb[i]) <=
              0.01f * watertight.picture.rgb[i];
    CHECK(same > watertight.picture.rgb.size() * 8 / 10);
    CHECK(mean_luminance(precomputed.picture) == Approx(mean_luminance(watertight.picture)).epsilon(0.02));
    // The transforms of a block are as large as the block.
    CHECK(precomputed.statistics.device_bytes > watertight.statistics.device_bytes);
  }
}
