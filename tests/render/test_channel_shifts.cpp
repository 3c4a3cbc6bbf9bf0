// Lamps whose colour channels differ by many powers of ten keep each channel in SPPM.
#include "device_scene/channel_shifts.hpp"

#include <cstdio>

#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// A white sphere all around, a ball that reflects no red, and a lamp for each emission.
Scene lit_by(const std::vector<std::string>& emissions) {
  std::string lamps;
  for (std::size_t i = 0; i < emissions.size(); ++i)
    lamps += R"(, {"type": "sphere", "radius": 1,
      "material": {"type": "diffuse", "color": [0, 0, 0], "emission": )" +
             emissions[i] + R"(}, "transform": [{"type": "shift", "x": -3, "y": )" +
             std::to_string(2 - 3 * static_cast<int>(i)) + R"(, "z": 2}]})";
  return scene_from_text(R"({
    "width": 8, "height": 8, "max_depth": 6,
    "renderer": {"type": "sppm", "photon_sample": 20000, "radius": 0.3},
    "camera": {"position": [0, 1, 3.9], "target": [0, 1, 0], "fov": 40},
    "objects": [
      {"type": "sphere", "radius": 6, "material": {"type": "diffuse", "color": [0.5, 0.5, 0.5]},
       "transform": [{"type": "shift", "x": 0, "y": 1, "z": 0}]},
      {"type": "sphere", "radius": 0.8, "material": {"type": "diffuse", "color": [0, 0.7, 0.7]},
       "transform": [{"type": "shift", "x": 0.3, "y": 1, "z": 0}]})" +
                         lamps + "]}");
}

double mean_of_channel(const Picture& picture, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < picture.rgb.size(); i += 3) sum += picture.rgb[i];
  return 3 * sum / static_cast<double>(picture.rgb.size());
}

}  // namespace

TEST_CASE("photons of a lamp whose channels are 10^24 apart keep each to 1%") {
  const Scene scene = lit_by({"[1e12, 1e-12, 1e-12]"});
  const Picture sppm = render_with(scene, Integrator::sppm, 48).picture;
  const Picture pt = render_with(scene, Integrator::pt, 4096).picture;
  for (const std::size_t channel : {0, 1, 2}) {
    const double exact = mean_of_channel(pt, channel), seen = mean_of_channel(sppm, channel);
    std::printf("channel %zu: SPPM %.6g, path tracing %.6g: %.4f\n", channel, seen, exact, seen / exact);
    CHECK(exact > 0);
    CHECK(seen == Approx(exact).epsilon(0.01));
  }
}

TEST_CASE("channels are carried in units of their own where all lamps have little of them") {
  CHECK(channel_shifts(lit_by({"[9, 9, 9]"})) == 0);
  CHECK(channel_shifts(lit_by({"[256, 1, 0]"})) == 0);
  CHECK(channel_shifts(lit_by({"[1024, 1, 0]"})) == 10u << 8);
  CHECK(channel_shifts(lit_by({"[1e-12, 1e-9, 1e12]"})) == (79u | 69u << 8));
  CHECK(channel_shifts(lit_by({"[1e-5, 1, 1e-4]"})) == (16u | 13u << 16));
  // The channel that one of two lamps has is not scaled.
  CHECK(channel_shifts(lit_by({"[1024, 1, 1]", "[1, 1, 0]"})) == 10u << 16);
  CHECK(channel_shifts(lit_by({})) == 0);
}

TEST_CASE("lamps that photons carry a channel of as noise are named") {
  CHECK(coarse_channel_notices(lit_by({"[1e12, 1e-12, 1e-12]"})).empty());
  CHECK(coarse_channel_notices(lit_by({"[1000, 1, 1]", "[1, 1, 1]"})).empty());
  const auto notices = coarse_channel_notices(lit_by({"[1, 1, 1]", "[1e9, 1, 0]"}));
  REQUIRE(notices.size() == 1);
  CHECK(notices[0].find("the green of /objects/3") == 0);
}
