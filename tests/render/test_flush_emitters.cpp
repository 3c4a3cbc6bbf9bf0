// Lamps that lie in a ceiling as far as single precision can tell give the light of lamps a little below it.
#include "catch2.hpp"

#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// A room of planes with a lamp at this height; the ceiling is at 2.7.
Scene room(const std::string& lamp, double height, const std::string& ceiling) {
  const std::string at = R"({"type": "shift", "x": 0.1, "y": )" + std::to_string(height) + R"(, "z": 0.2}])";
  const std::string shape = lamp == "disk" ? R"("type": "disk", "radius": 0.5)" : R"("type": "rectangle")";
  return scene_from_text(R"({"width": 12, "height": 9, "max_depth": 8,
    "renderer": {"type": "sppm", "photon_sample": 50000},
    "camera": {"position": [0, 1.2, 3.5], "target": [0, 1.5, 0], "fov": 60},
    "materials": {"grey": {"type": "diffuse", "color": [0.6, 0.5, 0.4]},
                  "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [10, 10, 10]}},
    "objects": [
      {"type": "plane", "material": "grey", "transform": [{"type": "rotate", "axis": "x", "degree": -90}]},
      {"type": "plane", "material": "grey", "transform": [{"type": "shift", "x": 0, "y": 0, "z": -2}]},)" +
                         ceiling + R"(,
      {)" + shape + R"(, "material": "lamp", "transform": [{"type": "rotate", "axis": "x", "degree": 90}, )" +
                         at + R"(}]})");
}

const std::string plane_ceiling = R"({"type": "plane", "material": "grey",
  "transform": [{"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 0, "y": 2.7, "z": 0}]})";
const std::string box_ceiling = R"({"type": "box", "size": [9, 0.2, 9], "material": "grey",
  "transform": [{"type": "shift", "x": 0, "y": 2.8, "z": 0}]})";
const std::string open_ceiling = R"({"type": "rectangle", "material": "grey",
  "transform": [{"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 1.1, "y": 2.7, "z": 0.2}]})";

double mean_of(const Scene& scene, Integrator integrator) {
  return mean_luminance(render_with(scene, integrator, integrator == Integrator::pt ? 128 : 8).picture);
}

}  // namespace

TEST_CASE("a lamp in a ceiling shines as one below it does") {
  const auto [lamp, ceiling] = GENERATE(table<std::string, std::string>(
      {{"disk", plane_ceiling}, {"rectangle", plane_ceiling}, {"disk", box_ceiling}}));
  const double expected = mean_of(room(lamp, 2.69, ceiling), Integrator::pt);
  for (const double height : {2.7, 2.7 - 1e-6}) {
    INFO(lamp << " at " << height << " in " << ceiling);
    const Scene scene = room(lamp, height, ceiling);
    CHECK(scene.notices.size() == 1);
    CHECK(mean_of(scene, Integrator::pt) == Approx(expected).epsilon(0.03));
    CHECK(mean_of(scene, Integrator::sppm) == Approx(expected).epsilon(0.03));
  }
}

TEST_CASE("a lamp just above a ceiling is hidden") {
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    const Scene scene = room("disk", 2.7 + 1e-6, plane_ceiling);
    CHECK(scene.objects.back().transform.translation.y > 2.7 + 1e-5);
    CHECK(mean_of(scene, integrator) == 0);
  }
}

TEST_CASE("a lamp beside or clear of a surface stays where it is") {
  for (const auto& [height, ceiling] : {std::pair{2.7, open_ceiling}, std::pair{2.6995, plane_ceiling}}) {
    const Scene scene = room("rectangle", height, ceiling);
    CHECK(scene.notices.empty());
    CHECK(scene.objects.back().transform.translation.y == Approx(height).epsilon(1e-12));
  }
}
