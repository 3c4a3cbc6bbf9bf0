// What the pilot of SPPM decides, and that pictures hold: first radius, emission, and errors that are not
// known.
#include <cmath>
#include <functional>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "photons/pilot.hpp"
#include "render/render_fixture.hpp"

using namespace causticl;

namespace {

const std::string planes = R"("objects": [
  {"type": "plane", "material": "white", "transform": [
    {"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": 0, "y": -2, "z": 0}]},
  {"type": "plane", "material": "white", "transform": [
    {"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": 0, "y": 2, "z": 0}]},
  {"type": "plane", "material": "white", "transform": [
    {"type": "rotate", "axis": "y", "degree": 90}, {"type": "shift", "x": -3, "y": 0, "z": 0}]},
  {"type": "plane", "material": "white", "transform": [
    {"type": "rotate", "axis": "y", "degree": -90}, {"type": "shift", "x": 3, "y": 0, "z": 0}]},
  {"type": "plane", "material": "white", "transform": [{"type": "shift", "x": 0, "y": 0, "z": -4}]},
  {"type": "plane", "material": "white", "transform": [
    {"type": "rotate", "axis": "y", "degree": 180}, {"type": "shift", "x": 0, "y": 0, "z": 6}]},
)";

/// Keeps what a render says, but for that its kernels compile, which depends on what ran before.
std::function<void(const std::string&)> pilot_notes(std::vector<std::string>& notes) {
  return [&notes](const std::string& note) {
    if (!note.starts_with("compiling kernels")) notes.push_back(note);
  };
}

/// A room of infinite planes, 6 by 4 by 10, and a lamp.
Scene room_of_planes(const std::string& lamp, const std::string& renderer = "") {
  return scene_from_text(R"({
    "width": 16, "height": 12, "max_depth": 12, "renderer": {"type": "sppm", "photon_sample": 20000)" +
                         renderer +
                         R"(},
    "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 60},
    "materials": {"white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]}},)" +
                         planes + lamp + "]}");
}

std::string sphere_lamp(const std::string& radius, const std::string& height, const std::string& radiance) {
  return R"({"type": "sphere", "radius": )" + radius + R"(, "transform": [{"type": "shift", "x": 0, "y": )" +
         height + R"(, "z": 0}], "material": {"type": "diffuse", "color": [0, 0, 0], "emission": [)" +
         radiance + ", " + radiance + ", " + radiance + "]}}";
}

/// Whether the true error is at most three times the claimed one, but for the noise of the reference.
bool is_honest(const RenderResult& render, const RenderResult& reference) {
  const double claimed = render.statistics.error->error, noise = reference.statistics.error->error;
  const double off = compare_pictures(render.picture, reference.picture).error_90;
  INFO("claimed " << claimed << ", off by " << off << ", reference by " << noise);
  return off * off <= 9 * claimed * claimed + noise * noise;
}

}  // namespace

TEST_CASE(
    "a room is as wide as the median way to what lies around, and an open scene as what is seen of it") {
  std::vector<Vec3> points;
  std::vector<float> distances;
  for (int i = 0; i < 100; ++i) {
    points.push_back({0.1 * i, 5, 0.02 * i});
    distances.push_back(static_cast<float>(i));
  }
  CHECK(surroundings_of(points, distances).room == Approx(50).epsilon(0.02));
  for (int i = 40; i < 100; ++i) distances[static_cast<std::size_t>(i)] = INFINITY;
  // The box of the middle nine tenths is 9 by 0 by 1.8.
  CHECK(surroundings_of(points, distances).room == Approx(1.8).epsilon(0.02));
  CHECK(!surroundings_of({}, {}).sees_surface);
}

TEST_CASE("a small lamp among infinite planes has a first radius of the room's scale, and no light is lost") {
  const Scene scene = room_of_planes(sphere_lamp("0.003", "1", "111111"));
  const auto sppm = render_with(scene, Integrator::sppm, 16), pt = render_with(scene, Integrator::pt, 512);
  CHECK(sppm.statistics.first_radius > 0.02);
  CHECK(sppm.statistics.first_radius < 0.25);
  // 0.1545 by 1024 samples a pixel, in a picture of other pixels 0.1543 to 0.1547.
  CHECK(mean_luminance(pt.picture) == Approx(0.1545).epsilon(0.015));
  CHECK(mean_luminance(sppm.picture) == Approx(0.1545).epsilon(0.02));
  CHECK(is_honest(sppm, pt));
}

TEST_CASE("a lamp that pokes through the ceiling lights the room by photons from where it does") {
  const Scene scene = room_of_planes(sphere_lamp("60", "61.99", "40"));
  std::vector<std::string> notes;
  Scene small = scene;
  small.renderer.passes = 24;
  const auto sppm = render_scene(small, test_device(), {}, {}, pilot_notes(notes));
  CHECK(sppm.statistics.first_radius < 0.3);
  bool told = false;
  for (const auto& note : notes) told = told || note.find("emission map: ") != std::string::npos;
  CHECK(told);
  const auto pt = render_with(scene, Integrator::pt, 2048);
  CHECK(mean_luminance(sppm.picture) == Approx(mean_luminance(pt.picture)).epsilon(0.08));
  CHECK(is_honest(sppm, pt));
}

TEST_CASE(
    "a room lit through a gap renders as well by itself as with the keys that were set for it by hand") {
  Scene by_hand = shipped_scene("effects/next_room.json", 40, 30);
  by_hand.renderer.passes = 12;
  Scene by_itself = by_hand;
  by_itself.renderer.radius.reset();
  by_itself.renderer.guided_photons.reset();
  std::vector<std::string> notes;
  const auto own = render_scene(by_itself, test_device(), {}, {}, pilot_notes(notes));
  const auto set = render_scene(by_hand, test_device(), {}, {}, {});
  // What is learned from the few useful photons would put much of the flux on a few of them: copies alone are
  // better.
  CHECK(notes.size() == 2);
  CHECK(notes.back().find("Metropolis photons: ") != std::string::npos);
  CHECK(own.statistics.error->error < 1.15 * set.statistics.error->error);
}

TEST_CASE("keys of the scene win over the pilot") {
  const Scene scene =
      room_of_planes(sphere_lamp("60", "61.99", "40"), R"(, "radius": 0.07, "guided_photons": false)");
  Scene small = scene;
  small.renderer.passes = 1;
  std::vector<std::string> notes;
  const auto result = render_scene(small, test_device(), {}, {}, pilot_notes(notes));
  CHECK(result.statistics.first_radius == 0.07);
  CHECK(notes.empty());
}

TEST_CASE("a picture that found no photon has no known error, and a wanted error does not end it") {
  Scene scene = room_of_planes(sphere_lamp("0.3", "1", "11.1"), R"(, "radius": 1e-6)");
  scene.renderer.passes = 20;
  RenderOptions options;
  options.wanted_error = 0.9;
  const auto result = render_scene(scene, test_device(), options);
  REQUIRE(result.statistics.error);
  CHECK(std::isinf(result.statistics.error->error));
  CHECK(result.statistics.error->unknown > 0.9);
  CHECK(result.statistics.stop == StopReason::passes);
  scene.renderer.radius = 0.1;
  const auto known = render_scene(scene, test_device(), options);
  REQUIRE(known.statistics.error);
  CHECK(known.statistics.error->error < 0.9);
  CHECK(known.statistics.error->unknown == 0);
  CHECK(known.statistics.stop == StopReason::error);
}

TEST_CASE("where no photon is stored nearby, the error of what shadow rays bring is known") {
  // A ball far above a floor that is all that is seen: what the ball scatters down is next to nothing there.
  Scene scene = scene_from_text(R"({
    "width": 16, "height": 12, "renderer": {"type": "sppm", "photon_sample": 5000},
    "camera": {"position": [0, 2, 0], "target": [0, 0, 0], "up": [0, 0, 1], "fov": 40},
    "materials": {"white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]}},
    "lights": [{"type": "point", "position": [0, 3, 0], "intensity": [10, 10, 10]}],
    "objects": [{"type": "rectangle", "material": "white", "transform": [
      {"type": "scale", "x": 6, "y": 6, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]}]
  })");
  scene.renderer.passes = 8;
  const auto result = render_scene(scene, test_device(), {});
  REQUIRE(result.statistics.error);
  CHECK(result.statistics.error->unknown == 0);
}
