// The sample dimensions of camera paths: what they are worth, and that a picture knows it.
#include <algorithm>
#include <cmath>
#include <string>

#include "accuracy/calibration.hpp"
#include "device_fixture.hpp"
#include "image/luminance.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

constexpr int seeds = 24;

struct Errors {
  double truth = 0, noise = 0, half_difference = 0;  // root mean squares, of luminance
  double within = 1;  // of the worst seed: the fraction of its uncertain pixels within 1.64 pooled_noise
};

std::vector<double> luminances(const Picture& picture) {
  std::vector<double> result;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) result.push_back(luminance(&picture.rgb[i]));
  return result;
}

/// Of renders with each of the seeds, against `truth`.
Errors errors_of(const Scene& scene, const std::vector<double>& truth) {
  const TemporaryFolder folder;
  Errors errors;
  const double weight = 1.0 / (seeds * static_cast<double>(truth.size()));
  for (int seed = 1; seed <= seeds; ++seed) {
    RenderOptions options;
    options.seed = static_cast<std::uint32_t>(seed);
    options.outputs = {folder.path("picture.exr")};  // no channels without
    const auto pixels = errors_of(render_scene(scene, test_device(), options).picture);
    REQUIRE(pixels.size() == truth.size());
    double uncertain = 0, within = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double off = pixels[i].luminance - truth[i];
      errors.truth += weight * off * off;
      errors.noise += weight * std::pow(static_cast<double>(pixels[i].noise), 2);
      errors.half_difference += weight * std::pow(static_cast<double>(pixels[i].half_difference), 2);
      const auto pooled = static_cast<double>(pixels[i].pooled_noise);
      if (off == 0 && pooled == 0) continue;
      ++uncertain;
      within += std::fabs(off) <= 1.64 * pooled;
    }
    errors.within = std::min(errors.within, within / uncertain);
  }
  for (double* square : {&errors.truth, &errors.noise, &errors.half_difference}) *square = std::sqrt(*square);
  return errors;
}

std::vector<double> truth_of(Scene scene, int samples) {
  scene.renderer.sampler = Sampler::independent;
  return luminances(render_with(scene, Integrator::pt, samples, 100).picture);
}

/// A lit ball: light from a lamp that no other surface reflects.
Scene lit_ball(Integrator integrator) {
  Scene scene = shipped_scene("analytic_sphere.json", 32, 24);
  scene.max_depth = 1;
  scene.renderer.integrator = integrator;
  return scene;
}

void check_gain(Scene scene, const std::vector<double>& truth) {
  scene.renderer.sampler = Sampler::independent;
  const Errors independent = errors_of(scene, truth);
  scene.renderer.sampler = Sampler::sobol;
  const Errors low_discrepancy = errors_of(scene, truth);
  CAPTURE(independent.truth, independent.half_difference, low_discrepancy.truth, low_discrepancy.noise,
          low_discrepancy.half_difference);
  CHECK(independent.half_difference == Approx(independent.truth).epsilon(0.15));
  CHECK(low_discrepancy.noise == Approx(low_discrepancy.truth).epsilon(0.15));
  CHECK(low_discrepancy.half_difference == Approx(low_discrepancy.truth).epsilon(0.15));
  CHECK(independent.truth > 1.5 * low_discrepancy.truth);
}

}  // namespace

TEST_CASE("sixteen samples a pixel have much less error where they are even, and their pictures know it") {
  const auto truth = truth_of(lit_ball(Integrator::pt), 8192);
  Scene path_traced = lit_ball(Integrator::pt);
  path_traced.renderer.samples = 16;
  check_gain(path_traced, truth);
  // The visible points of all passes are one sequence.
  Scene mapped = lit_ball(Integrator::sppm);
  mapped.renderer.visible_points = 4;
  mapped.renderer.passes = 4;
  check_gain(mapped, truth);
}

TEST_CASE(
    "where all pixels share a pass's time or wavelengths, noise is not taken from halves of the passes") {
  const std::string lit = R"({"width": 32, "height": 24, "max_depth": 4,
    "camera": {"position": [0, 0, 8], "target": [0, 0, 0], "fov": 40, "shutter": [0, 1]},
    "materials": {"lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [1, 1, 1]})";
  const std::string moving = R"(}, "objects": [{"type": "sphere", "radius": 1.5, "material": "lamp",
    "transform": [{"type": "shift", "x": -2, "y": 0, "z": 0}], "motion": {"shift": {"x": 3, "y": 0.2, "z": 0}}}]})";
  std::string dispersed = R"(, "flint": {"type": "glass", "cauchy": [1.5, 0.2]}},
    "objects": [{"type": "box", "size": [12, 12, 2], "material": "flint",
    "transform": [{"type": "rotate", "axis": "y", "degree": 50}]})";
  for (int stripe = -9; stripe <= 9; ++stripe)
    dispersed += R"(, {"type": "rectangle", "material": "lamp",
      "transform": [{"type": "scale", "x": 1, "y": 20, "z": 1}, {"type": "shift", "x": )" +
                 std::to_string(2 * stripe) + R"(, "y": 0, "z": -12}]})";
  dispersed += "]}";
  for (const auto& object : {moving, dispersed}) {
    Scene scene = scene_from_text(lit + object);
    scene.renderer.integrator = Integrator::pt;
    scene.renderer.samples = 16;
    const Errors errors = errors_of(scene, truth_of(scene, 4096));
    CHECK(errors.truth > 0.01);
    CHECK(errors.within > 0.9);
  }
}
