// Pictures under point, spot and directional lights and under environments, against closed forms.
#include <cstdio>
#include <filesystem>
#include <functional>

#include "catch2.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// The mean over all channels.
double mean_value(const Picture& picture) {
  double sum = 0;
  for (const float value : picture.rgb) sum += value;
  return sum / static_cast<double>(picture.rgb.size());
}

// A floor of reflectance 0.6 in y = 0, whose middle the camera sees from above.
const char* const lit_floor = R"({
  "width": 64, "height": 64, "max_depth": 1,
  "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 200000, "radius": 0.15},
  "camera": {"position": [0, 5, 0.01], "target": [0, 0, 0], "fov": 22},
  "materials": {"floor": {"type": "diffuse", "color": [0.6, 0.6, 0.6]}},
  "objects": [{"type": "rectangle", "material": "floor",
    "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]}],
  "lights": [LIGHT]
})";

/// The mean over the picture of 0.6 / pi times the irradiance at the point that is seen.
double exact_mean(const Scene& scene, const std::function<double(Vec3)>& irradiance) {
  const int n = 256;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const CameraSpec& camera = scene.camera;
      const Vec3 d = camera.axis + camera.right * ((i + 0.5) / n - 0.5) + camera.up * ((j + 0.5) / n - 0.5);
      sum += 0.6 / M_PI * irradiance(camera.origin - d * (camera.origin.y / d.y));
    }
  return sum / (static_cast<double>(n) * n);
}

/// All three ways to the same mean.
void check_means(Scene scene, double exact, int samples, double tolerance, int photon_passes,
                 double photon_tolerance) {
  CHECK(mean_value(render_with(scene, Integrator::pt, samples).picture) == Approx(exact).epsilon(tolerance));
  CHECK(mean_value(render_with(scene, Integrator::sppm, samples / 4).picture) ==
        Approx(exact).epsilon(tolerance));
  scene.renderer.direct_light = DirectLight::photons;
  CHECK(mean_value(render_with(scene, Integrator::sppm, photon_passes).picture) ==
        Approx(exact).epsilon(photon_tolerance));
}

}  // namespace

TEST_CASE("the irradiance of point, spot and directional lights is that of the closed form") {
  const Vec3 place{0.4, 2, -0.3};
  const auto by_distance = [&](Vec3 p, double intensity) {
    const Vec3 to_light = place - p;
    const double square = dot(to_light, to_light);
    return intensity / square * (to_light.y / std::sqrt(square));
  };
  struct Case {
    const char* light;
    std::function<double(Vec3)> irradiance;
  };
  const Case cases[] = {
      {R"({"type": "point", "position": [0.4, 2, -0.3], "intensity": [10, 10, 10]})",
       [&](Vec3 p) { return by_distance(p, 10); }},
      // Straight down, 40 degrees wide, of which the outer half falls off.
      {R"({"type": "spot", "position": [0.4, 2, -0.3], "target": [0.4, 0, -0.3], "angle": 40, "blend": 0.5,
           "intensity": [10, 10, 10]})",
       [&](Vec3 p) {
         const double cosine = place.y / length(place - p), outer = std::cos(M_PI / 9),
                      low_discrepancy = std::cos(M_PI / 18);
         const double t = std::clamp((cosine - outer) / (low_discrepancy - outer), 0.0, 1.0);
         return by_distance(p, 10) * t * t * (3 - 2 * t);
       }},
      {R"({"type": "directional", "direction": [3, -4, 0], "irradiance": [2, 2, 2]})",
       [](Vec3) { return 2 * 0.8; }},
  };
  for (const Case& c : cases) {
    INFO(c.light);
    const Scene scene = scene_from_text(replaced(lit_floor, "LIGHT", c.light));
    // Without photons nothing is random but the place in the pixel. Some 10^6 photons lie in the picture.
    check_means(scene, exact_mean(scene, c.irradiance), 16, 2e-3, 16, 6e-3);
  }
}

TEST_CASE("several lights add up, each chosen by its power") {
  const Scene scene = scene_from_text(replaced(
      lit_floor, "LIGHT", R"({"type": "directional", "direction": [0, -1, 0], "irradiance": [0.5, 0.5, 0.5]},
      {"type": "directional", "direction": [3, -4, 0], "irradiance": [1, 1, 1]},
      {"type": "environment", "radiance": [0.25, 0.25, 0.25]})"));
  check_means(scene, exact_mean(scene, [](Vec3) { return 0.5 + 0.8 + 0.25 * M_PI; }), 128, 5e-3, 20, 6e-3);
}

TEST_CASE("a rough lobe reflects a point light alike in both integrators, with shadow rays and without") {
  std::string text = replaced(lit_floor, "LIGHT",
                              R"({"type": "point", "position": [0.4, 2, -0.3], "intensity": [10, 10, 10]})");
  text = replaced(text, R"({"type": "diffuse", "color": [0.6, 0.6, 0.6]})",
                  R"({"type": "conductor", "eta": [0.2, 0.2, 0.2], "k": [3, 3, 3], "roughness": 0.5})");
  const Scene scene = scene_from_text(text);
  const double expected = mean_value(render_with(scene, Integrator::pt, 16).picture);
  REQUIRE(expected > 0.1);
  check_means(scene, expected, 16, 3e-3, 4, 3e-3);
}

TEST_CASE("a white ball under an even sky of 1 cannot be told from it") {
  const Scene scene = scene_from_text(R"({
    "width": 128, "height": 96, "max_depth": 4,
    "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 200000, "radius": 0.5},
    "camera": {"position": [0, 0.3, 3], "target": [0, 0, 0], "fov": 45},
    "objects": [{"type": "sphere", "radius": 1, "material": {"type": "diffuse", "color": [1, 1, 1]}}],
    "lights": [{"type": "environment", "radiance": [1, 1, 1]}]})");
  const auto pt = render_with(scene, Integrator::pt, 128);
  // A sample has a standard deviation of about 0.5 on the ball.
  CHECK(mean_value(pt.picture) == Approx(1).margin(1e-3));
  CHECK(pt.statistics.diagnostics.non_finite == 0);
  // Light sampling alone: 1.2.
  CHECK(mean_value(render_with(scene, Integrator::sppm, 16).picture) == Approx(1).margin(2.5e-3));
  Scene photons = scene;
  photons.renderer.direct_light = DirectLight::photons;
  photons.renderer.boundary_correction = false;  // there is none: a sphere's cap is as large as the disc
  CHECK(mean_value(render_with(photons, Integrator::sppm, 12).picture) == Approx(1).margin(2e-3));
  photons.renderer.boundary_correction = true;  // few and noisy probes to divide by
  CHECK(mean_value(render_with(photons, Integrator::sppm, 12).picture) == Approx(1).margin(8e-3));
}

TEST_CASE("under a sky that is white above and black below a tilted plate sees its part of the sky") {
  LightSpec sky;
  sky.kind = LightSpec::Kind::environment;
  sky.map.width = 128;
  sky.map.height = 64;
  for (int i = 0; i < 128 * 64; ++i)
    for (int c = 0; c < 4; ++c) sky.map.rgba.push_back(c == 3 || i >= 128 * 32 ? 1.0f : 0.0f);
  Scene scene = scene_from_text(replaced(lit_floor, "LIGHT", ""));
  scene.lights = {sky};
  for (const double tilt : {0.0, 60.0, 130.0}) {
    INFO("tilt " << tilt);
    const Transform turn = Transform::rotate(2, tilt * M_PI / 180);
    Scene tilted = scene;
    tilted.objects[0].transform = tilted.objects[0].transform.followed_by(turn);
    tilted.camera.origin = turn.point(scene.camera.origin);
    for (Vec3* v : {&tilted.camera.axis, &tilted.camera.right, &tilted.camera.up}) *v = turn.vector(*v);
    check_means(tilted, 0.6 * (1 + std::cos(tilt * M_PI / 180)) / 2, 128, 6e-3, 24, 2e-2);
  }
}

TEST_CASE("an environment lies where its map says, and turns about +y") {
  LightSpec sky;
  sky.kind = LightSpec::Kind::environment;
  sky.map.width = 64;
  sky.map.height = 32;
  sky.map.rgba.assign(4 * 64 * 32, 0.0f);
  // A bright texel and its neighbours toward +x, a quarter up from the horizon.
  for (int row = 23; row < 25; ++row)
    for (int column = 47; column < 49; ++column)
      sky.map.rgba[4 * static_cast<std::size_t>(row * 64 + column)] = 5;
  Scene scene = scene_from_text(replaced(lit_floor, "LIGHT", ""));
  scene.camera.origin = {0, 3, 0};
  scene.camera.right = {};
  scene.camera.up = {};
  const auto seen = [&](Vec3 direction, double rotation) {
    scene.lights = {sky};
    scene.lights[0].rotation = rotation;
    scene.camera.axis = normalize(direction);
    return render_with(scene, Integrator::pt, 1).picture.rgb[0];
  };
  CHECK(seen({1, 1, 0}, 0) == Approx(5).epsilon(1e-3));
  CHECK(seen({-1, 1, 0}, 0) == 0);
  CHECK(seen({0, 1, -1}, 0) == 0);
  // About +y, x goes to -z.
  CHECK(seen({0, 1, -1}, 90) == Approx(5).epsilon(1e-3));
  CHECK(seen({1, 1, 0}, 90) == 0);
  CHECK(seen({1, 1, 0}, -360) == Approx(5).epsilon(1e-3));
}

TEST_CASE("no light from beyond gets into a closed box") {
  Scene scene = scene_from_text(R"({
    "width": 16, "height": 16, "max_depth": 6,
    "renderer": {"type": "sppm", "photon_sample": 200000, "radius": 0.1},
    "camera": {"position": [0, 0, 0.9], "target": [0, 0, 0], "fov": 80},
    "objects": [{"type": "box", "size": [2, 2, 2], "material": {"type": "diffuse", "color": [0.8, 0.8, 0.8]}}],
    "lights": [{"type": "environment", "radiance": [1, 1, 1]},
               {"type": "directional", "direction": [1, -2, 3], "irradiance": [5, 5, 5]}]})");
  CHECK(mean_value(render_with(scene, Integrator::pt, 256).picture) == 0);
  CHECK(mean_value(render_with(scene, Integrator::sppm, 10).picture) == 0);
}

TEST_CASE("both integrators agree under real environments") {
  for (const std::string name : {"studio.exr", "sunset.exr"}) {
    const std::string file = std::string(CAUSTICL_SOURCE_DIR) + "/../shared/assets/" + name;
    if (!std::filesystem::exists(file)) {
      std::printf("skipped: %s is not there\n", file.c_str());
      continue;
    }
    INFO(name);
    const Scene scene = scene_from_text(R"({
      "width": 32, "height": 24, "max_depth": 8,
      "renderer": {"type": "sppm", "photon_sample": 100000, "radius": 0.3},
      "camera": {"position": [0, 2, 6], "target": [0, 0.8, 0], "fov": 40},
      "objects": [
        {"type": "disk", "radius": 4, "material": {"type": "diffuse", "color": [0.6, 0.6, 0.6]},
         "transform": [{"type": "rotate", "axis": "x", "degree": -90}]},
        {"type": "sphere", "radius": 0.8,
         "material": {"type": "conductor", "eta": [0.18, 0.42, 1.37], "k": [3.42, 2.35, 1.77], "roughness": 0.45},
         "transform": [{"type": "shift", "x": -1, "y": 0.9, "z": 0}]},
        {"type": "sphere", "radius": 0.7, "material": {"type": "plastic", "color": [0.7, 0.1, 0.1], "roughness": 0.3},
         "transform": [{"type": "shift", "x": 1, "y": 0.701, "z": 0}]}],
      "lights": [{"type": "environment", "path": ")" +
                                        file + R"("}]})");
    const auto sppm = render_with(scene, Integrator::sppm, 48);
    const auto pt = render_with(scene, Integrator::pt, 512);
    CHECK(pt.statistics.diagnostics.non_finite == 0);
    CHECK(sppm.statistics.diagnostics.non_finite == 0);
    CHECK(mean_luminance(sppm.picture) == Approx(mean_luminance(pt.picture)).epsilon(0.01));
    CHECK(relative_mse(box_filtered(sppm.picture, 4), box_filtered(pt.picture, 4)) < 2e-3);
  }
}
