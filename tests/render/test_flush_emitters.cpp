// Lamps that lie in a ceiling as far as single precision can tell give the light of lamps a little below it.
#include "catch2.hpp"

#include "render_fixture.hpp"
#include "scene/flush_emitters.hpp"

using namespace causticl;

namespace {

std::string shortest(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

/// A room of planes with a lamp at this height; the ceiling is at 2.7.
Scene room(const std::string& lamp, double height, const std::string& ceiling) {
  const std::string at = R"({"type": "shift", "x": 0.1, "y": )" + shortest(height) + R"(, "z": 0.2}])";
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
  return mean_luminance(render_with(scene, integrator, integrator == Integrator::pt ? 256 : 12).picture);
}

}  // namespace

TEST_CASE("a lamp in a ceiling shines as one below it does") {
  const auto [lamp, ceiling] = GENERATE(table<std::string, std::string>(
      {{"disk", plane_ceiling}, {"rectangle", plane_ceiling}, {"disk", box_ceiling}}));
  const double expected = mean_of(room(lamp, 2.69, ceiling), Integrator::pt);
  for (const double height : {2.7, 2.7 - 2e-7}) {
    INFO(lamp << " at " << height << " in " << ceiling);
    const Scene scene = room(lamp, height, ceiling);
    CHECK(scene.notices.size() == 1);
    CHECK(mean_of(scene, Integrator::pt) == Approx(expected).epsilon(0.03));
    CHECK(mean_of(scene, Integrator::sppm) == Approx(expected).epsilon(0.06));
  }
}

TEST_CASE("a lamp that rounding has put just behind a ceiling shines, one well behind it is hidden") {
  const double expected = mean_of(room("disk", 2.69, plane_ceiling), Integrator::pt);
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    CHECK(mean_of(room("disk", 2.7 + 2e-7, plane_ceiling), integrator) == Approx(expected).epsilon(0.06));
    CHECK(mean_of(room("disk", 2.701, plane_ceiling), integrator) == 0);
  }
}

TEST_CASE("the nearest surface counts, and no lamp is moved by more than roundings of its place") {
  // A room at 10^5, where a lamp 0.1 below the ceiling is a dozen roundings away from it.
  Scene far = room("disk", 2.6, plane_ceiling);
  for (Object& object : far.objects)
    object.transform.translation = object.transform.translation + Vec3{1e5, 1e5, 1e5};
  CHECK(lift_flush_emitters(far).empty());
  far.objects.back().transform.translation.y = 1e5 + 2.7;
  const auto moved = lift_flush_emitters(far);
  REQUIRE(moved.size() == 1);
  CHECK(moved[0].find("lies in /objects/2 ") != std::string::npos);
  CHECK(std::fabs(far.objects.back().transform.translation.y - (1e5 + 2.7)) < 0.15);
}

TEST_CASE("a lamp beside or clear of a surface stays where it is") {
  for (const auto& [height, ceiling] : {std::pair{2.7, open_ceiling}, std::pair{2.6999, plane_ceiling}}) {
    const Scene scene = room("rectangle", height, ceiling);
    CHECK(scene.notices.empty());
    CHECK(scene.objects.back().transform.translation.y == Approx(height).epsilon(1e-12));
  }
}

TEST_CASE("a pane of thin glass that lies in a wall is seen as one before it") {
  const auto with_pane = [](double z) {
    const std::string pane = R"({"type": "rectangle", "material": {"type": "thin_glass", "color": 0.1},
      "transform": [{"type": "scale", "x": 4, "y": 2.6, "z": 1}, {"type": "shift", "x": 0, "y": 1.4, "z": )";
    return room("disk", 2.69, plane_ceiling + ", " + pane + shortest(z) + "}]}");
  };
  const Scene before = with_pane(-1.99), flush = with_pane(-2);
  CHECK(before.notices.empty());
  CHECK(flush.notices.size() == 1);
  const double expected = mean_of(before, Integrator::pt);
  CHECK(expected < 0.95 * mean_of(room("disk", 2.69, plane_ceiling), Integrator::pt));
  CHECK(mean_of(flush, Integrator::pt) == Approx(expected).epsilon(0.03));
  CHECK(mean_of(flush, Integrator::sppm) == Approx(expected).epsilon(0.06));
}

TEST_CASE("lamps in panes and panes in faces of glass are moved, lamps in faces of glass are not") {
  const auto notices = [](const std::string& lamp_material, const std::string& body) {
    return scene_from_text(
               R"({"camera": {"position": [0, 1, 9], "target": [0, 0, 0], "fov": 40}, "objects": [)" + body +
               R"(, {"type": "rectangle", "material": )" + lamp_material +
               R"(, "transform": [{"type": "shift", "x": 0.1, "y": 0, "z": 1}]},
               {"type": "sphere", "radius": 0.1, "material": {"type": "diffuse", "emission": 1},
                "transform": [{"type": "shift", "x": 0, "y": 3, "z": 0}]}]})")
        .notices.size();
  };
  const std::string lamp = R"({"type": "diffuse", "emission": 1})", pane = R"({"type": "thin_glass"})";
  const std::string box = R"({"type": "box", "size": [4, 4, 2], "material": {"type": "glass"}})",
                    sheet = R"({"type": "rectangle", "material": {"type": "thin_glass"}, "transform": [
                      {"type": "scale", "x": 4, "y": 4, "z": 1}, {"type": "shift", "x": 0, "y": 0, "z": 1}]})";
  CHECK(notices(pane, box) ==
        notices(pane, R"({"type": "sphere", "radius": 0.2, "material": {"type": "glass"}})") + 1);
  CHECK(notices(lamp, sheet) == 1);
  CHECK(notices(lamp, box) ==
        notices(lamp, R"({"type": "sphere", "radius": 0.2, "material": {"type": "glass"}})"));
}
