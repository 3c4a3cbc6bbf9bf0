// Two rooms on one floor: what is lit in the one is not seen in the other.
#include <algorithm>
#include <array>

#include "catch2.hpp"

#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

std::string shift(double x, double y, double z) {
  return R"({"type": "shift", "x": )" + std::to_string(x) + R"(, "y": )" + std::to_string(y) + R"(, "z": )" +
         std::to_string(z) + "}";
}

std::string box(const std::string& material, const std::string& size, const std::string& place) {
  return R"({"type": "box", "material": ")" + material + R"(", "size": )" + size + R"(, "transform": [)" +
         place + "]}";
}

/// Rooms left and right of x = 0, each 1 wide and high and 3 deep, with a lamp; the camera is in the left
/// one.
Scene rooms(const std::string& wall, double left, double right) {
  const auto lamp = [](double radiance) {
    const std::string r = std::to_string(radiance);
    return R"({"type": "diffuse", "color": [0, 0, 0], "emission": [)" + r + "," + r + "," + r + "]}";
  };
  return scene_from_text(R"({"width": 48, "height": 36,
    "camera": {"position": [-0.9, 0.8, 1.9], "target": [-0.1, 0.1, -0.6], "fov": 60},
    "renderer": {"type": "sppm", "photon_sample": 20000, "radius": 0.12},
    "materials": {"white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]}, "left": )" +
                         lamp(left) + R"(, "right": )" + lamp(right) + R"(}, "objects": [)" +
                         box("white", "[2.2, 0.1, 3.2]", shift(0, -0.05, 0.5)) + "," +
                         box("white", "[2.2, 0.1, 3.2]", shift(0, 1.05, 0.5)) + "," +
                         box("white", "[0.1, 1.2, 3.2]", shift(-1.05, 0.5, 0.5)) + "," +
                         box("white", "[0.1, 1.2, 3.2]", shift(1.05, 0.5, 0.5)) + "," +
                         box("white", "[2.2, 1.2, 0.1]", shift(0, 0.5, -1.05)) + "," +
                         box("white", "[2.2, 1.2, 0.1]", shift(0, 0.5, 2.05)) + "," +
                         box("left", "[0.2, 0.02, 0.2]", shift(-0.5, 0.9, -0.3)) + "," +
                         box("right", "[0.2, 0.02, 0.2]", shift(0.5, 0.9, -0.3)) + "," + wall + "]}");
}

const std::string across = R"({"type": "rotate", "axis": "y", "degree": 90}, )";

const std::vector<std::string> walls{
    R"({"type": "rectangle", "material": "white", "transform": [{"type": "scale", "x": 3.4, "y": 3.4, "z": 1}, )" +
        across + shift(0, 0.5, 0.5) + "]}",
    box("white", "[0.001, 2, 3.2]", shift(0, 0.5, 0.5)),
    R"({"type": "plane", "material": "white", "transform": [)" + across + shift(0, 0, 0) + "]}"};

}  // namespace

TEST_CASE("a lamp in the next room lights nothing here") {
  for (const std::string& wall : walls)
    for (const DirectLight direct : {DirectLight::shadow_rays, DirectLight::photons}) {
      INFO(wall);
      Scene scene = rooms(wall, 0, 100);
      scene.renderer.direct_light = direct;
      const auto picture = render_with(scene, Integrator::sppm, 4).picture;
      double brightest = 0;
      for (const float value : picture.rgb) brightest = std::max<double>(brightest, value);
      CHECK(brightest == 0);
    }
}

TEST_CASE("a wall of many small triangles lets nothing through") {
  // Smaller than half the radius, and than a quarter.
  for (const int cells : {64, 160}) {
    INFO(cells << " cells");
    const TemporaryFolder folder;
    std::string mesh;
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i)
        mesh += "v 0 " + std::to_string(3.4 * j / cells - 1.2) + " " + std::to_string(3.4 * i / cells - 1.2) +
                "\n";
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const int a = j * (cells + 1) + i + 1, b = a + cells + 1;
        for (const auto& [p, q, r] : {std::array{a, a + 1, b + 1}, std::array{a, b + 1, b}})
          mesh += "f " + std::to_string(p) + " " + std::to_string(q) + " " + std::to_string(r) + "\n";
      }
    const std::string file = folder.write("wall.obj", mesh);
    Scene scene = rooms(R"({"type": "mesh", "material": "white", "path": ")" + file + "\"}", 0, 100);
    const auto picture = render_with(scene, Integrator::sppm, 4).picture;
    CHECK(*std::max_element(picture.rgb.begin(), picture.rgb.end()) == 0);
  }
}

TEST_CASE("a bright lamp in the next room changes nothing here") {
  // What a pixel divides by is of the floor on this side alone: the foot of the wall is as bright as path
  // tracing has it.
  const Scene scene = rooms(walls[1], 1, 100);
  // The lamp beyond the wall adds nothing, and takes nearly all light samples: the reference does without it.
  const auto traced = render_with(rooms(walls[1], 1, 0), Integrator::pt, 1024).picture;
  const auto mapped = render_with(scene, Integrator::sppm, 48).picture;
  // One photon in a hundred is of the lamp on this side: the noise of the mean is about 2%.
  CHECK(mean_luminance(mapped) == Approx(mean_luminance(traced)).epsilon(0.06));
}

TEST_CASE("what lies on a thin ceiling does not light the floor beneath it") {
  // Nothing but the floor is below the ceiling: its own upper side holds the photons.
  const std::string up = R"({"type": "rotate", "axis": "x", "degree": -90}, )";
  const auto flat = [&](const std::string& type, double height) {
    return R"({"type": ")" + type +
           R"(", "material": "white", "transform": [{"type": "scale", "x": 9, "y": 9, "z": 9}, )" + up +
           shift(0, height, 0) + "]}";
  };
  for (const std::string type : {"plane", "rectangle"}) {
    INFO(type);
    // A rectangle lets light in at its edges, but for a box around it.
    const std::string around = type == "plane" ? ""
                                               : "," + box("white", "[0.2, 3, 9.2]", shift(-4.6, 0, 0)) +
                                                     "," + box("white", "[0.2, 3, 9.2]", shift(4.6, 0, 0)) +
                                                     "," + box("white", "[9.2, 3, 0.2]", shift(0, 0, -4.6)) +
                                                     "," + box("white", "[9.2, 3, 0.2]", shift(0, 0, 4.6));
    Scene scene = scene_from_text(R"({"width": 32, "height": 24,
      "camera": {"position": [0, 0.03, 0.5], "target": [0, 0.01, 0], "fov": 60},
      "renderer": {"type": "sppm", "photon_sample": 20000, "radius": 0.12},
      "materials": {"white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]}},
      "lights": [{"type": "point", "position": [0, 1, 0], "intensity": [1, 1, 1]}],
      "objects": [)" + flat(type, 0) +
                                  "," + flat(type, 0.04) + around + "]}");
    scene.renderer.direct_light = DirectLight::photons;  // so that the ceiling holds photons
    const auto picture = render_with(scene, Integrator::sppm, 4).picture;
    CHECK(*std::max_element(picture.rgb.begin(), picture.rgb.end()) == 0);
  }
}

TEST_CASE("nothing leaks out of bodies, or past plates, that are smaller than the search radius") {
  const auto dark_scene = [](const std::string& view, double radius, const std::string& light,
                             const std::string& objects) {
    Scene scene = scene_from_text(R"({"width": 24, "height": 18, "camera": )" + view +
                                  R"(, "renderer": {"type": "sppm", "photon_sample": 5000, "radius": )" +
                                  std::to_string(radius) + R"(}, "materials": {
      "white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]}, "black": {"type": "diffuse", "color": [0, 0, 0]}},
      "lights": [{"type": "point", "position": )" +
                                  light + R"(, "intensity": [10, 10, 10]}], "objects": [)" + objects + "]}");
    scene.renderer.direct_light = DirectLight::photons;
    return scene;
  };
  const std::string outside = R"({"position": [0, 0.5, 2], "target": [0, 0, 0], "fov": 30})";
  const std::string sphere = R"({"type": "sphere", "radius": 0.3, "material": "white"})";
  // A black plate between two floors, each 0.3 from it and not seen from the other's lamp.
  const auto floor = [](double x) {
    return R"({"type": "rectangle", "material": "white", "transform": [{"type": "rotate", "axis": "x", "degree": -90}, )" +
           shift(x, 0, 0) + "]}";
  };
  const std::string plate = box("black", "[0.02, 9, 9]", shift(0, 0, 0));
  const std::string beside = R"({"position": [-0.8, 0.5, 0], "target": [-0.79, 0, 0], "fov": 30})";
  const std::vector<std::pair<std::string, Scene>> scenes{
      {"a lamp in a sphere", dark_scene(outside, 1, "[0, 0, 0]", sphere)},
      {"a lamp in a box",
       dark_scene(outside, 1, "[0, 0, 0]", box("white", "[0.4, 0.4, 0.4]", shift(0, 0, 0)))},
      {"floors at a plate",
       dark_scene(beside, 1, "[0.8, 0.5, 0]", floor(-0.81) + "," + floor(0.81) + "," + plate)}};
  for (const auto& [name, scene] : scenes) {
    INFO(name);
    const auto picture = render_with(scene, Integrator::sppm, 2).picture;
    CHECK(*std::max_element(picture.rgb.begin(), picture.rgb.end()) == 0);
  }
}
