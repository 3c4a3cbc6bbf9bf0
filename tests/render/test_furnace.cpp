// Pictures whose every pixel is known.
#include "catch2.hpp"

#include "render_fixture.hpp"

using namespace causticl;

namespace {

// Inside a closed sphere that reflects half of the light and emits radiance 1/2, radiance is
// 1/2 + 1/2 (1/2 + ...) = 1 everywhere; 1e-9 is cut off at 30 surface hits.
const char* const closed_sphere = R"({
  "width": 24, "height": 16, "max_depth": 30,
  "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 200000, "radius": 0.5, "direct_light": "DIRECT"},
  "camera": {"position": [0.2, 0.1, 0.3], "target": [1, 0.2, 0], "fov": 80},
  "materials": {"wall": {"type": "diffuse", "color": [0.5, 0.5, 0.5], "emission": [0.5, 0.5, 0.5], "two_sided": true}},
  "objects": [{"type": "sphere", "radius": 2, "material": "wall"}]
})";

Scene furnace(const std::string& direct_light) {
  std::string text = closed_sphere;
  text.replace(text.find("DIRECT"), 6, direct_light);
  return scene_from_text(text);
}

double largest_deviation(const Picture& picture) {
  double worst = 0;
  for (const float value : picture.rgb) worst = std::max(worst, std::fabs(static_cast<double>(value) - 1));
  return worst;
}

}  // namespace

TEST_CASE("inside a closed sphere with Kd = Le = 1/2 path tracing gives 1 in every pixel") {
  const auto result = render_with(furnace("shadow_rays"), Integrator::pt, 4096);
  // Light sampling alone has a standard deviation of about 0.5 a sample; BSDF sampling has none. The power
  // heuristic leaves 0.1: six standard deviations of the mean of 4096 samples.
  CHECK(largest_deviation(box_filtered(result.picture, 8)) < 1e-3);
  CHECK(result.statistics.diagnostics.non_finite == 0);
}

TEST_CASE(
    "inside a closed sphere with Kd = Le = 1/2 SPPM gives 1 in every pixel, with shadow rays and without") {
  // The cap of a sphere within distance R of a point of it has area pi R^2 exactly, so that the density
  // estimate has no bias here and a large radius only makes it smoother.
  Scene scene = furnace("shadow_rays");
  scene.renderer.radius = 0.95;
  scene.renderer.indirect_radius = 2.0;
  scene.renderer.alpha = 0.95;
  scene.renderer.boundary_correction = false;
  // Only the indirect quarter is estimated, from some millions of photons a pixel.
  CHECK(largest_deviation(render_with(scene, Integrator::sppm, 64).picture) < 1e-3);
  // Photons alone estimate half, of twice as many photons; the emission stays exact.
  scene.renderer.radius = 1.9;
  scene.renderer.indirect_radius = 1.0;
  scene.renderer.direct_light = DirectLight::photons;
  CHECK(largest_deviation(render_with(scene, Integrator::sppm, 128).picture) < 1e-3);
  // A hundred probes of a disc as wide as the sphere, where surface stands up to twice as steep, are noisy.
  scene.renderer.boundary_correction = true;
  const Picture corrected = render_with(scene, Integrator::sppm, 64).picture;
  CHECK(largest_deviation(corrected) < 0.16);
  CHECK(mean_luminance(corrected) == Approx(1).margin(0.012));
}

TEST_CASE("path tracing reaches 1 within 1e-3 in each single pixel", "[long]") {
  Scene scene = furnace("shadow_rays");
  scene.width = 8;
  scene.height = 5;
  CHECK(largest_deviation(render_with(scene, Integrator::pt, 400000).picture) < 1e-3);
}
