// Direct light against a closed form.
#include "catch2.hpp"

#include "render_fixture.hpp"

using namespace causticl;

namespace {

// A spherical lamp under a ceiling, seen at a grazing angle, far from the origin: where offsets off the
// surface are longest and a shadow ray most easily meets the lamp that it was aimed at.
const char* const lamp_under_ceiling = R"({
  "width": 32, "height": 8, "max_depth": 1,
  "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 300000, "radius": 0.7, "direct_light": "DIRECT"},
  "camera": {"position": [650, 574, 1700], "target": [650, 582, 1492], "fov": 1.2},
  "materials": {
    "ceiling": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
    "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [30, 30, 30]}},
  "objects": [
    {"type": "plane", "material": "ceiling",
     "transform": [{"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 0, "y": 581.6, "z": 0}]},
    {"type": "sphere", "radius": 7, "material": "lamp", "transform": [{"type": "shift", "x": 650, "y": 570, "z": 1492}]}]
})";

/// The mean over the picture of reflected radiance, rho L (r / d)^2 cos (a sphere of radiance L and radius r
/// at distance d, wholly above the horizon), at the points that the camera's pixels show.
double exact_mean(const Scene& scene) {
  const int n = 512;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const CameraSpec& camera = scene.camera;
      const Vec3 d = camera.axis + camera.right * ((i + 0.5) / n - 0.5) + camera.up * ((j + 0.5) / n - 0.5);
      const Vec3 point = camera.origin + d * ((581.6 - camera.origin.y) / d.y);
      const Vec3 to_lamp = Vec3{650, 570, 1492} - point;
      const double distance = length(to_lamp);
      sum += 0.8 * 30 * 49 / (distance * distance) * (11.6 / distance);
    }
  return sum / (static_cast<double>(n) * n);
}

}  // namespace

TEST_CASE("a ceiling under a spherical lamp has the irradiance of the closed form") {
  std::string text = lamp_under_ceiling;
  text.replace(text.find("DIRECT"), 6, "shadow_rays");
  Scene scene = scene_from_text(text);
  const double exact = exact_mean(scene);
  // Cone sampling leaves under 2% of noise in a sample; the figures average 10^5 of them.
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 100).picture) == Approx(exact).epsilon(2e-3));
  CHECK(mean_luminance(render_with(scene, Integrator::pt, 400).picture) == Approx(exact).epsilon(2e-3));
  scene.renderer.direct_light = DirectLight::photons;
  // Some 10^7 photons, and a kernel that blurs over 0.7 of the 11.6 units between ceiling and lamp.
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 60).picture) == Approx(exact).epsilon(1e-2));
}

namespace {

// A floor of small black and white squares under a lamp on one side, straight from above.
const char* const checkered_floor = R"({
  "width": 16, "height": 16, "max_depth": 1,
  "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 200000, "radius": 0.2, "direct_light": "DIRECT"},
  "camera": {"position": [0, 6, 0.01], "target": [0, 0, 0], "fov": 20},
  "materials": {
    "floor": {"type": "diffuse", "color": {"type": "checker", "a": [0, 0, 0], "b": [0.8, 0.8, 0.8], "scale": [80, 80]}},
    "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [10, 10, 10]}},
  "objects": [
    {"type": "rectangle", "material": "floor",
     "transform": [{"type": "scale", "x": 8, "y": 8, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]},
    {"type": "rectangle", "material": "lamp",
     "transform": [{"type": "scale", "x": MIRROR, "y": 1, "z": 1}, {"type": "rotate", "axis": "x", "degree": 90},
                   {"type": "shift", "x": 0, "y": 3, "z": 3}]}]
})";

Scene checkered(const std::string& direct_light, const std::string& mirror = "1") {
  std::string text = checkered_floor;
  text.replace(text.find("DIRECT"), 6, direct_light);
  text.replace(text.find("MIRROR"), 6, mirror);
  return scene_from_text(text);
}

}  // namespace

TEST_CASE("photons on black texels light the white ones beside them, with every schedule of the radius") {
  const double expected = mean_luminance(render_with(checkered("shadow_rays"), Integrator::sppm, 40).picture);
  REQUIRE(expected > 0.01);
  for (const Schedule schedule : {Schedule::pixel, Schedule::global, Schedule::geometric}) {
    Scene scene = checkered("photons");
    scene.renderer.schedule = schedule;
    INFO("schedule " << static_cast<int>(schedule));
    CHECK(mean_luminance(render_with(scene, Integrator::sppm, 40).picture) == Approx(expected).epsilon(0.01));
  }
}

TEST_CASE("a radius that a schedule shrinks to nothing leaves a finite picture") {
  Scene scene = checkered("photons");
  scene.renderer.schedule = Schedule::geometric;
  scene.renderer.radius_decay = 1e-3;
  scene.renderer.photons = 1000;
  const auto result = render_with(scene, Integrator::sppm, 30);
  CHECK(result.statistics.diagnostics.non_finite == 0);
}

TEST_CASE("a mirrored rectangle still emits towards its local +z") {
  const double expected = mean_luminance(render_with(checkered("shadow_rays"), Integrator::sppm, 20).picture);
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt})
    CHECK(mean_luminance(render_with(checkered("shadow_rays", "-1"), integrator, 80).picture) ==
          Approx(expected).epsilon(0.01));
}
