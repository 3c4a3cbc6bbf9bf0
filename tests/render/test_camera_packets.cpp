// Whole pictures with camera rays in packets and one at a time: the same to the bit, with the same counts.
#include "catch2.hpp"

#include "device_fixture.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

RenderResult render_by(CameraRays camera_rays, const Scene& scene) {
  RenderOptions options;
  options.camera_rays = camera_rays;
  return render_scene(scene, test_device(), options);
}

void check_same(Scene scene, int visible_points = 4) {
  for (const auto integrator : {Integrator::sppm, Integrator::pt}) {
    scene.renderer.integrator = integrator;
    scene.renderer.passes = scene.renderer.samples = 2;
    scene.renderer.photons = 10000;
    scene.renderer.visible_points = visible_points;
    const auto single = render_by(CameraRays::single, scene);
    const auto packets = render_by(CameraRays::packets, scene);
    INFO(scene.file << ", " << visible_points << " visible points, " << scene.width << " x " << scene.height);
    CHECK(single.statistics.camera_rays == "one at a time");
    CHECK(packets.statistics.camera_rays == "in packets of 16");
    check_same_render(single, packets);
  }
}

}  // namespace

TEST_CASE(
    "packets of camera rays give the picture of single ones: meshes, textures, shapes among triangles") {
  check_same(shipped_scene("2_glass_knot.json", 64, 48));
  check_same(shipped_scene("cornell_box.json", 61, 47));
  check_same(shipped_scene("1_textured_balls.json", 33, 29));
  check_same(shipped_scene("stress/bezier_goblet.json", 32, 24));
}

TEST_CASE("packets of camera rays give the picture of single ones: lens, motion, medium, hard cases") {
  check_same(shipped_scene("4_focus_near.json", 48, 36));
  check_same(shipped_scene("effects/moving_balls.json", 48, 36));
  check_same(shipped_scene("effects/fog.json", 40, 30));
  check_same(shipped_scene("stress/duplicates.json", 40, 30));
}

TEST_CASE("packets of camera rays give the picture of single ones: any number of visible points a pixel") {
  for (const int visible_points : {1, 2, 3, 5, 8, 9, 16, 17})
    check_same(shipped_scene("cornell_box.json", 19, 13), visible_points);
}

TEST_CASE("packets of camera rays give the picture of single ones: chunks that end within a row") {
  // 65,536 paths a launch end in the middle of a pixel row and in that of a tile.
  check_same(shipped_scene("cornell_box.json", 163, 211), 2);
}

TEST_CASE(
    "camera rays go one by one where the scene has no triangle, in double, and by the precomputed test") {
  Scene scene = shipped_scene("2_glass_knot.json", 16, 12);
  scene.renderer.integrator = Integrator::pt;
  scene.renderer.samples = 1;
  RenderOptions options;
  options.camera_rays = CameraRays::packets;
  options.triangle_test = TriangleTest::precomputed;
  CHECK(render_scene(scene, test_device(), options).statistics.camera_rays == "one at a time");
  options.triangle_test = TriangleTest::watertight;
  if (test_device().info().fp64) {
    options.precision = Precision::float64;
    CHECK(render_scene(scene, test_device(), options).statistics.camera_rays == "one at a time");
  }
  options.precision = Precision::float32;
  Scene spheres = shipped_scene("analytic_sphere.json", 16, 12);
  spheres.renderer.passes = spheres.renderer.samples = 1;
  CHECK(render_scene(spheres, test_device(), options).statistics.camera_rays == "one at a time");
}
