// A pane of thin glass against one of glass with two faces, close together.
#include <cmath>
#include <cstdio>

#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

const Color color{0.9, 0.5, 0.2};

/// A square pane of thin glass in z = 0.
std::string thin_pane(double size) {
  const std::string edge = std::to_string(size);
  return R"({"type": "rectangle", "material": {"type": "thin_glass", "color": [0.9, 0.5, 0.2], "ior": 1.5},
  "transform": [{"type": "scale", "x": )" +
         edge + R"(, "y": )" + edge + R"(, "z": 1}]})";
}

/// The same pane as two faces, with what absorbs as much on the way from one to the other.
std::string thick_pane(double size, double thickness) {
  char text[300];
  std::snprintf(text, sizeof text,
                R"({"type": "box", "size": [%.9g, %.9g, %.9g],
  "material": {"type": "glass", "ior": 1.5, "absorption": [%.9g, %.9g, %.9g]}})",
                size, size, thickness, -std::log(color.x) / thickness, -std::log(color.y) / thickness,
                -std::log(color.z) / thickness);
  return text;
}

/// A pane in z = 0 that the camera sees under `degrees`, and a light that fills the half space behind it, or
/// before it.
std::string pane_scene(const std::string& pane, double degrees, bool behind) {
  const double angle = degrees * M_PI / 180;
  char text[700];
  std::snprintf(text, sizeof text,
                R"({"width": 8, "height": 8, "max_depth": 40,
  "camera": {"position": [%.9g, 0, %.9g], "target": [0, 0, 0], "up": [0, 1, 0], "fov": 0.5},
  "renderer": {"type": "sppm", "photon_sample": 2000, "radius": 0.5, "view_point_sample": 4},
  "objects": [{"type": "rectangle", "material": {"type": "diffuse", "color": 0, "emission": 1, "two_sided": true},
               "transform": [{"type": "scale", "x": 4000, "y": 4000, "z": 1}, {"type": "shift", "x": 0, "y": 0, "z": %d}]},
    )",
                10 * std::sin(angle), 10 * std::cos(angle), behind ? -30 : 30);
  return text + pane + "]}";
}

/// The floor of a room whose lamp shines through the pane.
std::string lit_through(const std::string& pane) {
  return R"({"width": 12, "height": 8, "max_depth": 24,
  "camera": {"position": [0, 0, -1], "target": [0.5, 0, -2], "up": [0, 1, 0], "fov": 50},
  "renderer": {"type": "sppm", "photon_sample": 60000, "radius": 0.15},
  "objects": [
    {"type": "rectangle", "material": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
     "transform": [{"type": "scale", "x": 12, "y": 12, "z": 1}, {"type": "shift", "x": 0, "y": 0, "z": -2}]},
    {"type": "sphere", "radius": 0.5, "material": {"type": "diffuse", "color": 0, "emission": 30},
     "transform": [{"type": "shift", "x": 1, "y": 0, "z": 2.5}]},
    )" + pane +
         "]}";
}

void check_close(Vec3 a, Vec3 b, double relative) {
  CHECK(a.x == Approx(b.x).epsilon(relative));
  CHECK(a.y == Approx(b.y).epsilon(relative));
  CHECK(a.z == Approx(b.z).epsilon(relative));
}

}  // namespace

TEST_CASE("thin glass reflects and transmits as two faces of glass do, at every angle") {
  for (const double degrees : {0.0, 30.0, 50.0, 65.0, 80.0}) {
    for (const bool behind : {true, false}) {
      INFO(degrees << (behind ? " degrees, transmitted" : " degrees, reflected"));
      const Scene thin = scene_from_text(pane_scene(thin_pane(4), degrees, behind)),
                  thick = scene_from_text(pane_scene(thick_pane(4, 1e-3), degrees, behind));
      const Vec3 exact = mean_color(render_with(thick, Integrator::pt, 8192).picture);
      const Vec3 by_paths = mean_color(render_with(thin, Integrator::pt, 4096).picture);
      const Vec3 by_sppm = mean_color(render_with(thin, Integrator::sppm, 1024).picture);
      std::printf(
          "%2g degrees, %-11s two faces %.4f %.4f %.4f, thin by pt %.4f %.4f %.4f, by sppm %.4f %.4f %.4f\n",
          degrees, behind ? "transmitted" : "reflected", exact.x, exact.y, exact.z, by_paths.x, by_paths.y,
          by_paths.z, by_sppm.x, by_sppm.y, by_sppm.z);
      check_close(by_paths, exact, 0.005);
      check_close(by_sppm, exact, 0.005);
    }
  }
}

TEST_CASE("photons go through thin glass as through two faces of glass") {
  const Vec3 thin =
      mean_color(render_with(scene_from_text(lit_through(thin_pane(14))), Integrator::sppm, 128).picture);
  const Vec3 thick = mean_color(
      render_with(scene_from_text(lit_through(thick_pane(14, 1e-2))), Integrator::sppm, 128).picture);
  const Vec3 by_paths =
      mean_color(render_with(scene_from_text(lit_through(thin_pane(14))), Integrator::pt, 4096).picture);
  std::printf("lit through: two faces %.4f %.4f %.4f, thin %.4f %.4f %.4f, thin by pt %.4f %.4f %.4f\n",
              thick.x, thick.y, thick.z, thin.x, thin.y, thin.z, by_paths.x, by_paths.y, by_paths.z);
  check_close(thin, thick, 0.005);
  check_close(thin, by_paths, 0.01);
}
