// Glass that absorbs, against the closed form.
#include <cmath>
#include <numbers>

#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

constexpr double ior = 1.5, thickness = 0.8;
const Vec3 absorption{0, 0.5, 2};

/// A wide slab of glass before a lamp of radiance 1, seen at an angle through a pinhole that sees one
/// direction.
Scene slab(double angle, double roughness) {
  const double distance = 6;
  const std::string x = std::to_string(distance * std::tan(angle));
  return scene_from_text(
      R"({
    "width": 8, "height": 8, "max_depth": 20, "renderer": {"type": "pt", "photon_sample": 100, "radius": 0.1},
    "camera": {"position": [)" +
      x + R"(, 0, 6], "target": [0, 0, 0], "fov": 0.01},
    "objects": [
      {"type": "box", "size": [400, 400, )" +
      std::to_string(thickness) +
      R"(], "material": {"type": "glass", "ior": 1.5, "absorption": [0, 0.5, 2], "roughness": )" +
      std::to_string(roughness) + R"(}},
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [1, 1, 1]},
       "transform": [{"type": "scale", "x": 400, "y": 400, "z": 1}, {"type": "shift", "x": 0, "y": 0, "z": -2}]}]})");
}

/// What the slab lets through at this angle, inner reflections included.
Vec3 slab_transmittance(double angle) {
  const double cosine = std::cos(angle), sine_t = std::sin(angle) / ior,
               cosine_t = std::sqrt(1 - sine_t * sine_t);
  const double parallel = (ior * cosine - cosine_t) / (ior * cosine + cosine_t);
  const double perpendicular = (cosine - ior * cosine_t) / (cosine + ior * cosine_t);
  const double r = 0.5 * (parallel * parallel + perpendicular * perpendicular);
  Vec3 result;
  for (int c = 0; c < 3; ++c) {
    const double once = std::exp(-absorption[c] * thickness / cosine_t);
    result[c] = (1 - r) * (1 - r) * once / (1 - r * r * once * once);
  }
  return result;
}

Vec3 mean(const Picture& picture) {
  Vec3 sum;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) sum[static_cast<int>(i % 3)] += picture.rgb[i];
  return sum / (static_cast<double>(picture.width) * picture.height);
}

}  // namespace

TEST_CASE(
    "a slab of glass absorbs by Beer and Lambert between its Fresnel reflections, in both integrators") {
  for (const double degrees : {0.0, 30.0, 65.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3 exact = slab_transmittance(angle);
    // Whether a path is reflected is drawn: a standard deviation below 0.5 a path.
    const double tolerance = 5 * 0.5 / std::sqrt(64 * 1024.0);
    // A lobe of 0.0025 radians, which takes the way of rough glass.
    for (const double roughness : {0.0, 0.05}) {
      const Scene scene = slab(angle, roughness);
      for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
        const Vec3 found =
            mean(render_with(scene, integrator, integrator == Integrator::pt ? 1024 : 256).picture);
        CAPTURE(degrees, roughness, static_cast<int>(integrator));
        for (int c = 0; c < 3; ++c) CHECK(found[c] == Approx(exact[c]).margin(tolerance));
      }
    }
  }
}
