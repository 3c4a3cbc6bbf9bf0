// The medium against closed forms.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/report.hpp"
#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

Scene fog(const std::string& medium, const std::string& objects, const std::string& renderer, int max_depth) {
  return scene_from_text(R"({"width": 8, "height": 8, "max_depth": )" + std::to_string(max_depth) +
                         R"(, "renderer": {"type": "pt", "photon_sample": 5000, "radius": 0.3)" + renderer +
                         R"(},
      "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01},
      "medium": {)" + medium +
                         R"(}, "objects": [)" + objects + "]}");
}

const char* const lamp_ahead =
    R"({"type": "rectangle", "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [1, 1, 1]}})";

Vec3 mean(const Picture& picture) {
  Vec3 sum;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) sum[static_cast<int>(i % 3)] += picture.rgb[i];
  return sum / (static_cast<double>(picture.width) * picture.height);
}

/// Mean over the directions in which a sphere is seen from `distance` of exp(-extinction * way to its
/// surface), times their solid angle.
double sphere_seen(double distance, double radius, double extinction) {
  constexpr int steps = 32;
  const double drop = 1 - std::sqrt(1 - radius * radius / (distance * distance));
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = 1 - drop * (i + 0.5) / steps, miss2 = distance * distance * (1 - cosine * cosine);
    sum += std::exp(-extinction * (distance * cosine - std::sqrt(std::max(0.0, radius * radius - miss2)))) /
           steps;
  }
  return sum * 2 * std::numbers::pi * drop;
}

/// Light of a small lamp of radiance 1 at (0, 2, 0) that is scattered once to a camera at (0, 0, 5), which
/// looks along -z past it to a black wall at z = -5: the integral along the ray, by the midpoint rule.
double single_scattering(double absorption, double scattering, double g, double lamp_radius) {
  constexpr int steps = 20000;
  double sum = 0;
  const double extinction = absorption + scattering;
  for (int i = 0; i < steps; ++i) {
    const double t = 10 * (i + 0.5) / steps, z = 5 - t, distance = std::hypot(2, z);
    // Light goes from the lamp to the ray, then along +z to the camera.
    const double phase =
        (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * z / distance, 1.5));
    sum += scattering * phase * std::exp(-extinction * t) * sphere_seen(distance, lamp_radius, extinction) *
           10 / steps;
  }
  return sum;
}

}  // namespace

TEST_CASE("a medium that only absorbs leaves exp(-absorption * distance) of a lamp") {
  const Scene scene = fog("\"absorption\": [0, 0.1, 0.4]", lamp_ahead, "", 8);
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    const Vec3 found =
        mean(render_with(scene, integrator, integrator == Integrator::pt ? 1024 : 256).picture);
    const double tolerance = 5 * 1.0 / std::sqrt(64 * 1024.0);
    CHECK(found.x == Approx(1).margin(tolerance));
    CHECK(found.y == Approx(std::exp(-0.5)).margin(tolerance));
    CHECK(found.z == Approx(std::exp(-2.0)).margin(tolerance));
  }
}

TEST_CASE("single scattering of a small lamp is the integral along the ray") {
  constexpr double lamp_radius = 0.2;
  const std::string objects =
      R"({"type": "sphere", "radius": 0.2, "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [1, 1, 1]},
     "transform": [{"type": "shift", "x": 0, "y": 2, "z": 0}]},
    {"type": "rectangle", "material": {"type": "diffuse", "color": [0, 0, 0]},
     "transform": [{"type": "scale", "x": 20, "y": 20, "z": 1}, {"type": "shift", "x": 0, "y": 0, "z": -5}]})";
  for (const double g : {0.0, 0.6, -0.5}) {
    const std::string medium =
        "\"absorption\": [0.02, 0.02, 0.1], \"scattering\": [0.1, 0.3, 0.2], \"g\": " + std::to_string(g);
    const Vec3 exact{single_scattering(0.02, 0.1, g, lamp_radius),
                     single_scattering(0.02, 0.3, g, lamp_radius),
                     single_scattering(0.1, 0.2, g, lamp_radius)};
    const auto check = [&](const Vec3& found, double tolerance) {
      for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(exact[c]).epsilon(tolerance));
    };
    CAPTURE(g);
    {
      INFO("path tracing");
      check(mean(render_with(fog(medium, objects, "", 1), Integrator::pt, 4096).picture), 0.02);
    }
    {
      INFO("SPPM by shadow rays");
      check(mean(render_with(fog(medium, objects, "", 1), Integrator::sppm, 512).picture), 0.02);
    }
    {
      // The kernel blurs the density across the ray, which is one for all pixels: a small bias, and noise of
      // 1 to 2%.
      INFO("SPPM by photons");
      Scene scene = fog(medium, objects, ", \"direct_light\": \"photons\"", 1);
      scene.renderer.photons = 50000;
      check(mean(render_with(scene, Integrator::sppm, 256).picture), 0.04);
    }
  }
}

TEST_CASE("light that is scattered many times is the same by path tracing and by photons in the medium") {
  Scene scene = scene_from_text(R"({"width": 16, "height": 12, "max_depth": 24,
    "renderer": {"type": "sppm", "photon_sample": 5000, "radius": 0.5, "view_point_sample": 4},
    "camera": {"position": [0, 1.5, 6], "target": [0, 1, 0], "fov": 50},
    "medium": {"absorption": [0.02, 0.05, 0.1], "scattering": [0.2, 0.4, 0.6], "g": 0.5},
    "materials": {"grey": {"type": "diffuse", "color": [0.6, 0.5, 0.4]},
      "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [8, 8, 8]}},
    "objects": [
      {"type": "box", "size": [10, 6, 16], "material": "grey", "transform": [{"type": "shift", "x": 0, "y": 3, "z": 0}]},
      {"type": "box", "size": [1, 1, 1], "material": {"type": "glass", "ior": 1.5, "absorption": [0.5, 0.1, 0.1]},
       "transform": [{"type": "shift", "x": -1.2, "y": 0.6, "z": 0}]},
      {"type": "sphere", "radius": 0.8, "material": "lamp", "transform": [{"type": "shift", "x": 1, "y": 4, "z": -1}]}]})");
  const double exact = mean_luminance(render_with(scene, Integrator::pt, 2048).picture);
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 200).picture) == Approx(exact).epsilon(0.03));
  scene.renderer.direct_light = DirectLight::photons;
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 200).picture) == Approx(exact).epsilon(0.03));
}

TEST_CASE("the summary of a scene tells its medium, and no medium of nothing") {
  CHECK_THAT(
      scene_summary(fog("\"absorption\": [0, 0.1, 0.4], \"g\": 0.5", lamp_ahead, "", 4)),
      Catch::Contains("medium      absorption (0, 0.1, 0.4), scattering (0, 0, 0) per unit length, g 0.5\n"));
  CHECK_THAT(scene_summary(fog("\"g\": 0.5", lamp_ahead, "", 4)), !Catch::Contains("medium"));
}

TEST_CASE("a medium of nothing changes no bit") {
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm})
    CHECK(render_with(fog("", lamp_ahead, "", 4), integrator, 2).picture.rgb ==
          render_with(
              fog("\"absorption\": [0, 0, 0], \"scattering\": [0, 0, 0], \"g\": 0.5", lamp_ahead, "", 4),
              integrator, 2)
              .picture.rgb);
}
