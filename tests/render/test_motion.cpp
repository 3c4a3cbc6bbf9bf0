// Motion blur: what moves is the mean of its stills.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/report.hpp"
#include "catch2.hpp"
#include "device_fixture.hpp"
#include "device_scene/motion.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// A ball, a box and a lamp of which each moves, by `time` times what it moves in all where the scene is a
/// still.
Scene moving_scene(std::optional<double> still = {}) {
  const auto placed = [&](double x, double y, double z, double dx, double dy, double dz) {
    const auto text = [](double a, double b, double c) {
      return std::to_string(a) + ", \"y\": " + std::to_string(b) + ", \"z\": " + std::to_string(c);
    };
    const double t = still.value_or(0);
    return "\"transform\": [{\"type\": \"shift\", \"x\": " + text(x + t * dx, y + t * dy, z + t * dz) + "}]" +
           (still ? "" : ", \"motion\": {\"shift\": {\"x\": " + text(dx, dy, dz) + "}}");
  };
  return scene_from_text(
      R"({"width": 24, "height": 16, "max_depth": 6,
      "renderer": {"type": "sppm", "photon_sample": 4000, "radius": 0.4, "view_point_sample": 4},
      "camera": {"position": [0, 2, 8], "target": [0, 1, 0], "fov": 40, "shutter": [0, 1]},
      "materials": {"grey": {"type": "diffuse", "color": [0.6, 0.6, 0.6]}, "glass": {"type": "glass", "ior": 1.5},
        "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [20, 18, 16]}},
      "objects": [
        {"type": "rectangle", "material": "grey",
         "transform": [{"type": "scale", "x": 9, "y": 9, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]},
        {"type": "sphere", "radius": 0.8, "material": "glass", )" +
      placed(-1.5, 0.9, 0, 1, 0, 0) + R"(},
        {"type": "box", "size": [0.5, 1, 0.5], "material": "grey", )" +
      placed(1, 0.6, 0, 0.5, 0.5, 0.25) + R"(},
        {"type": "sphere", "radius": 0.6, "material": "lamp", )" +
      placed(-1, 4, 1, 2, 0, 0.5) + "}]}");
}

template <typename T>
bool same_bytes(const cl::Buffer& a, const cl::Buffer& b, std::size_t count) {
  const auto x = test_device().download<T>(a, count), y = test_device().download<T>(b, count);
  return std::memcmp(x.data(), y.data(), count * sizeof(T)) == 0;
}

}  // namespace

TEST_CASE("a scene placed at a time is the still of that time, to the bit") {
  const Scene moving = moving_scene();
  DeviceScene placed = update_device_scene(moving, test_device(), 1);
  for (const double time : {0.625, 0.125, 0.0}) {
    place_flat_scene(moving, time, test_device(), placed);
    const DeviceScene still = update_device_scene(moving_scene(time), test_device(), 1);
    CHECK(same_bytes<KdNode>(placed.nodes, still.nodes, 1));
    CHECK(same_bytes<Emitter>(placed.emitters, still.emitters, still.emitter_count));
    CHECK(same_bytes<Shape>(placed.shapes, still.shapes, still.shapes_count));
    CHECK(same_bytes<TriangleBlock>(placed.blocks, still.blocks, 1));
    CHECK(placed.center == still.center);
  }
}

TEST_CASE("the summary of a scene tells what moves, and when the shutter is open") {
  CHECK_THAT(scene_summary(moving_scene()), Catch::Contains("  moving    3, shutter from 0 to 1\n"));
  CHECK_THAT(scene_summary(moving_scene(0.5)), !Catch::Contains("moving"));
}

TEST_CASE("the times of any range of passes fill the shutter's interval evenly") {
  CameraSpec camera;
  camera.shutter = {-1, 3};
  for (const std::uint32_t seed : {1u, 4000000000u})
    for (const std::uint32_t first : {0u, 3999999000u}) {
      std::vector<double> times;
      for (std::uint32_t pass = 0; pass < 200; ++pass) times.push_back(pass_time(camera, seed, first + pass));
      std::sort(times.begin(), times.end());
      double worst = 0;
      for (std::size_t i = 0; i < times.size(); ++i)
        worst = std::max(worst, std::fabs((times[i] + 1) / 4 - (static_cast<double>(i) + 0.5) / 200));
      CHECK(worst < 0.02);
    }
}

TEST_CASE("what moves looks as the mean of stills does, with its light, its shadow and its caustic") {
  constexpr int stills = 16, passes = 24;
  for (const Integrator integrator : {Integrator::pt, Integrator::sppm}) {
    const int each = integrator == Integrator::pt ? 4 * passes : passes;
    const Picture moving = render_with(moving_scene(), integrator, stills * each).picture;
    Picture mean = moving;
    std::fill(mean.rgb.begin(), mean.rgb.end(), 0.0f);
    for (int i = 0; i < stills; ++i) {
      const Picture still =
          render_with(moving_scene((i + 0.5) / stills), integrator, each, static_cast<unsigned>(100 + i))
              .picture;
      for (std::size_t k = 0; k < mean.rgb.size(); ++k) mean.rgb[k] += still.rgb[k] / stills;
    }
    CAPTURE(static_cast<int>(integrator));
    CHECK(mean_luminance(moving) == Approx(mean_luminance(mean)).epsilon(0.02));
    CHECK(relative_mse(box_filtered(moving, 4), box_filtered(mean, 4)) < 4e-3);
    // A still is another picture: the comparison can tell.
    const Picture still = render_with(moving_scene(0), integrator, each).picture;
    CHECK(relative_mse(box_filtered(still, 4), box_filtered(mean, 4)) > 1e-2);
  }
}
