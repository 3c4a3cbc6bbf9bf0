// Photons that plates with bent shading normals scatter: SPPM agrees with path tracing.
#include <cmath>
#include <cstdio>

#include "catch2.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

/// A square of side 2 across y at `height`, whose normal is tilted from +y towards +x by `degrees`.
std::string tilted_square(double height, double degrees, int first) {
  char text[400];
  const double tilt = degrees * M_PI / 180;
  std::snprintf(text, sizeof text,
                "v -1 %g -1\nv -1 %g 1\nv 1 %g 1\nv 1 %g -1\nvn %.9g %.9g 0\nf %d//%d %d//%d %d//%d %d//%d\n",
                height, height, height, height, std::sin(tilt), std::cos(tilt), 4 * first + 1, first + 1,
                4 * first + 2, first + 1, 4 * first + 3, first + 1, 4 * first + 4, first + 1);
  return text;
}

/// The square of `obj`, of `material`, below a lamp that shines down on it. `rest` is what the camera sees: a
/// white wall or floor that no direct light reaches.
std::string plate_scene(const std::string& obj, const std::string& material, const std::string& rest) {
  return R"({"width": 8, "height": 8, "max_depth": 4,
    "renderer": {"type": "sppm", "photon_sample": 30000, "radius": 0.12},
    "objects": [
      {"type": "mesh", "path": ")" +
         obj + R"(", "material": )" + material + R"(},
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [10, 10, 10]},
       "transform": [{"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 0, "y": 2, "z": 0}]},
      )" +
         rest + "}";
}

/// A wall at x = 3, of which the camera sees what lies higher than the lamp.
const char* const wall = R"(
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
       "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1}, {"type": "rotate", "axis": "y", "degree": -90},
                     {"type": "shift", "x": 3, "y": 3, "z": 0}]}],
    "camera": {"position": [1, 2.7, 0], "target": [3, 2.7, 0], "up": [0, 1, 0], "fov": 28})";

/// A floor at y = -1, of which the camera sees what lies below the middle of the plate.
const char* const floor_below = R"(
      {"type": "rectangle", "material": {"type": "diffuse", "color": [0.8, 0.8, 0.8]},
       "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90},
                     {"type": "shift", "x": 0, "y": -1, "z": 0}]}],
    "camera": {"position": [0, -0.4, 0], "target": [0, -1, 0.001], "up": [0, 0, 1], "fov": 60})";

void check_agreement(const std::string& scene_text, const char* name) {
  const Scene scene = scene_from_text(scene_text);
  const auto sppm = render_with(scene, Integrator::sppm, 96);
  const auto pt = render_with(scene, Integrator::pt, 8192);
  const double seen = mean_luminance(sppm.picture), exact = mean_luminance(pt.picture);
  std::printf("%-24s SPPM %.5g, path tracing %.5g: %.4f\n", name, seen, exact, seen / exact);
  CHECK(sppm.statistics.diagnostics.saturated == 0);
  CHECK(exact > 1e-3);
  CHECK(seen == Approx(exact).epsilon(0.04));
}

}  // namespace

TEST_CASE("plates with bent shading normals reflect as much light by photons as by camera paths") {
  const TemporaryFolder folder;
  const std::pair<const char*, const char*> materials[] = {
      {"mirror", R"({"type": "mirror", "color": [1, 1, 1]})"},
      {"conductor", R"({"type": "conductor", "eta": [0.2, 0.9, 1.1], "k": [3.9, 2.4, 2.2]})"},
      {"rough conductor",
       R"({"type": "conductor", "eta": [0.2, 0.9, 1.1], "k": [3.9, 2.4, 2.2], "roughness": 0.3})"},
      {"thin glass", R"({"type": "thin_glass", "ior": 2.5, "color": [0.3, 0.9, 0.6]})"},
      {"plastic", R"({"type": "plastic", "color": [0.8, 0.8, 0.8]})"},
      {"rough plastic", R"({"type": "plastic", "color": [0.8, 0.8, 0.8], "roughness": 0.3})"},
      {"diffuse", R"({"type": "diffuse", "color": [0.8, 0.8, 0.8]})"}};
  const std::string obj = folder.write("plate.obj", tilted_square(0, 25, 0));
  for (const auto& [name, material] : materials) {
    INFO(name);
    check_agreement(plate_scene(obj, material, wall), name);
  }
}

TEST_CASE(
    "slabs of glass with bent shading normals let as much light through by photons as by camera paths") {
  const TemporaryFolder folder;
  // Both faces, the lower one turned down.
  std::string lower = tilted_square(-0.2, 0, 1);
  lower.replace(lower.find("vn"), lower.find('f') - lower.find("vn"), "vn 0 -1 0\n");
  lower.replace(lower.find('f'), std::string::npos, "f 8//2 7//2 6//2 5//2\n");
  const std::string obj = folder.write("slab.obj", tilted_square(0, 45, 0) + lower);
  check_agreement(plate_scene(obj, R"({"type": "glass", "ior": 1.5})", floor_below), "glass slab");
  check_agreement(plate_scene(obj, R"({"type": "glass", "ior": 1.5, "roughness": 0.2})", floor_below),
                  "rough slab");
  check_agreement(plate_scene(folder.write("pane.obj", tilted_square(0, 45, 0)),
                              R"({"type": "thin_glass", "color": [0.3, 0.9, 0.6]})", floor_below),
                  "thin pane");
}
