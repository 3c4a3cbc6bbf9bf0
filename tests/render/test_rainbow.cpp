// Dispersion as pictures show it.
#include <cmath>

#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// A ball of glass in a furnace of radiance 1: infinite planes all round, so that every path ends in light.
Scene furnace(const std::string& index, const std::string& type) {
  const auto plane = [](const std::string& turn, double side) {
    return R"({"type": "plane", "material": "wall", "transform": [{"type": "shift", "x": 0, "y": 0, "z": )" +
           std::to_string(side) + "}" + turn + "]}";
  };
  const std::string x = R"(, {"type": "rotate", "axis": "y", "degree": 90})",
                    y = R"(, {"type": "rotate", "axis": "x", "degree": 90})";
  return scene_from_text(R"({"width": 24, "height": 24, "max_depth": 64, "renderer": {"type": ")" + type +
                         R"("},
    "camera": {"position": [0, 0, 3], "target": [0, 0, 0], "fov": 30},
    "materials": {"wall": {"type": "diffuse", "color": [0, 0, 0], "emission": [1, 1, 1], "two_sided": true}},
    "objects": [{"type": "sphere", "radius": 1, "material": {"type": "glass", )" +
                         index + "}}, " + plane("", 9) + ", " + plane("", -9) + ", " + plane(x, 9) + ", " +
                         plane(x, -9) + ", " + plane(y, 9) + ", " + plane(y, -9) + "]}");
}

}  // namespace

TEST_CASE("glass without dispersion is the same by ior and by cauchy, to the bit") {
  const auto by_ior = render_with(furnace("\"ior\": 1.5", "pt"), Integrator::pt, 4).picture;
  const auto by_cauchy = render_with(furnace("\"cauchy\": [1.5, 0]", "pt"), Integrator::pt, 4).picture;
  CHECK(by_ior.rgb == by_cauchy.rgb);
}

TEST_CASE("dispersive glass loses no light of any channel") {
  const Picture picture = render_with(furnace("\"cauchy\": [1.5, 0.05]", "pt"), Integrator::pt, 512).picture;
  double sums[3] = {};
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) sums[i % 3] += picture.rgb[i];
  // A path that meets the ball shows one channel, three times as bright: a standard deviation below 1.5 a
  // path.
  const double pixels = 24 * 24, tolerance = 5 * 1.5 / std::sqrt(pixels * 512);
  for (const double sum : sums) CHECK(sum / pixels == Approx(1).margin(tolerance));
}
