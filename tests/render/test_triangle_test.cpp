// Whole pictures by both ways in which rays can meet triangles.
#include "catch2.hpp"

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

TEST_CASE("the triangle test changes nothing where there is no triangle, whatever is compiled in") {
  // More shapes in one place than a block holds.
  std::string balls;
  for (int i = 0; i < 12; ++i) balls += R"({"type": "sphere", "radius": 0.8, "material": "white"},)";
  const Scene scene = scene_from_text(R"({
    "width": 16, "height": 12,
    "renderer": {"type": "sppm", "photon_sample": 5000, "radius": 0.2, "rounds": 2},
    "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "fov": 45},
    "materials": {"white": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
      "glass": {"type": "glass", "ior": 1.5},
      "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [9, 9, 9]}},
    "objects": [)" + balls + R"(
      {"type": "sphere", "radius": 0.79, "material": "glass", "transform": [{"type": "shift", "x": 0.1, "y": 0, "z": 0}]},
      {"type": "sphere", "radius": 0.3, "material": "lamp", "transform": [{"type": "shift", "x": 1, "y": 2, "z": 1}]}]
  })");
  const auto rendered = [&](TriangleTest triangle_test, const char* effects) {
    RenderOptions options;
    options.triangle_test = triangle_test;
    options.effects = effects;
    options.photon_rays = PhotonRays::tree;
    return render_scene(scene, test_device(), options).picture.rgb;
  };
  const auto expected = rendered(TriangleTest::watertight, "auto");
  CHECK(*std::max_element(expected.begin(), expected.end()) > 0);
  CHECK(rendered(TriangleTest::precomputed, "auto") == expected);
  // Only CPUs round alike in programs for more effects.
  if (test_device().has_serial_work_items()) CHECK(rendered(TriangleTest::precomputed, "all") == expected);
}
