// Convergence as theory has it, on a scene whose picture is known in closed form
// (scenes/analytic_sphere.json).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "../render/render_fixture.hpp"
#include "catch2.hpp"
#include "device_fixture.hpp"
#include "study/study_analysis.hpp"

using namespace causticl;

namespace {

constexpr int extent = 24;  // pixels of an edge

/// The form factor of the lamp from a point of the sphere with outward normal n: B-43 of Howell's catalogue,
/// as the scene file has it. The lamp has radius 1.
double form_factor(Vec3 point, Vec3 n) {
  const Vec3 d = Vec3{3, 4, 3} - point;
  const double h = length(d), c = dot(n, d) / h;
  if (c >= 1 / h) return c / (h * h);
  if (c <= -1 / h) return 0;
  const double s = std::sqrt(1 - c * c), q = std::sqrt(h * h - 1);
  return 0.5 - std::asin(q / (h * s)) / std::numbers::pi +
         (c * std::acos(-q * c / s) - q * std::sqrt(1 - h * h * c * c)) / (std::numbers::pi * h * h);
}

/// The radiance over reflectance along a camera ray through a point of the film, in units of its half extent.
double radiance(double x, double y) {
  const double half = std::tan(27 * std::numbers::pi / 360);
  const Vec3 origin{0, 0, 10},
      direction = Vec3{half * x, half * y, -1} * (1 / length({half * x, half * y, -1}));
  const double b = dot(origin, direction), discriminant = b * b - dot(origin, origin) + 4;
  if (discriminant < 0) return 0;
  const Vec3 point = origin + direction * (-b - std::sqrt(discriminant));
  return 12 * form_factor(point, point * 0.5);
}

/// The picture, by 64 x 64 points a pixel.
Picture analytic_picture() {
  constexpr int points = 64;
  const double reflectance[] = {0.8, 0.5, 0.25};
  Picture picture{extent, extent, {}};
  for (int row = 0; row < extent; ++row)
    for (int column = 0; column < extent; ++column) {
      double sum = 0;
      for (int v = 0; v < points; ++v)
        for (int u = 0; u < points; ++u)
          sum += radiance(2 * (column + (u + 0.5) / points) / extent - 1,
                          1 - 2 * (row + (v + 0.5) / points) / extent);
      for (const double color : reflectance)
        picture.rgb.push_back(static_cast<float>(color * sum / (points * points)));
    }
  return picture;
}

/// Relative MSE by passes from `first` on, the mean over seeds.
std::map<std::uint64_t, double> measured_errors(const Scene& scene, int seeds, std::uint64_t first) {
  const Picture truth = analytic_picture();
  std::map<std::uint64_t, double> mse;
  for (int seed = 1; seed <= seeds; ++seed) {
    RenderOptions options;
    options.seed = static_cast<std::uint32_t>(seed);
    options.snapshot = [&](const Snapshot& now) {
      if (now.passes >= first) mse[now.passes] += relative_mse(now.picture, truth) / seeds;
    };
    render_scene(scene, test_device(), options);
  }
  return mse;
}

double slope_of(const std::map<std::uint64_t, double>& mse) { return log_slope({mse.begin(), mse.end()}); }

}  // namespace

TEST_CASE("the error of path tracing falls with slope -1, and faster where samples are even") {
  Scene scene = shipped_scene("analytic_sphere.json", extent, extent);
  scene.renderer.integrator = Integrator::pt;
  scene.renderer.samples = 256;
  scene.renderer.sampler = Sampler::independent;
  const auto independent = measured_errors(scene, 8, 4);
  std::printf("path tracing: MSE ~ samples^%.3f\n", slope_of(independent));
  CHECK(slope_of(independent) == Approx(-1).epsilon(0.1));
  scene.renderer.sampler = Sampler::sobol;
  const auto low_discrepancy = measured_errors(scene, 8, 4);
  const double gain = independent.rbegin()->second / low_discrepancy.rbegin()->second;
  std::printf("with Sobol's sequence: MSE ~ samples^%.3f, after 256 of them a %.1fth\n",
              slope_of(low_discrepancy), gain);
  CHECK(slope_of(low_discrepancy) < -1.1);
  CHECK(gain > 3);
}

TEST_CASE("the error of photon mapping falls with slope -2/3 at alpha 2/3", "[long]") {
  // All light by photons, so few that their noise, and what the radius blurs, are all of the error.
  Scene scene = shipped_scene("analytic_sphere.json", extent, extent);
  scene.renderer.integrator = Integrator::sppm;
  scene.renderer.direct_light = DirectLight::photons;
  scene.renderer.schedule = Schedule::global;
  scene.renderer.alpha = 2.0 / 3;
  scene.renderer.radius = 0.5;
  scene.renderer.photons = 2000;
  scene.renderer.passes = 768;
  const double slope = slope_of(measured_errors(scene, 16, 12));
  std::printf("photon mapping: MSE ~ passes^%.3f\n", slope);
  CHECK(slope == Approx(-2.0 / 3).epsilon(0.1));
}
