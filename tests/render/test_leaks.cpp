// Two rooms on one floor: what is lit in the one is not seen in the other.
#include "catch2.hpp"

#include "render_fixture.hpp"

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
