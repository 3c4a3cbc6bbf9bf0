// Other ways to write what a scene says: greys, aliases, free axes, matrices.
#include <cmath>
#include <numbers>

#include "format/load_scene.hpp"
#include "scene_folder.hpp"

namespace causticl {

TEST_CASE("a number is a grey for every colour") {
  const SceneFolder folder;
  const Vec3 grey{0.25, 0.25, 0.25};
  const auto diffuse = folder.material(R"("material": {"type": "diffuse", "color": 0.25, "emission": 3})");
  CHECK(diffuse.color == grey);
  CHECK(diffuse.emission == Vec3{3, 3, 3});
  const auto glass = folder.material(R"("material": {"type": "glass", "color": 0.25, "absorption": 2})");
  CHECK(glass.color == grey);
  CHECK(glass.absorption == Vec3{2, 2, 2});
  const auto metal = folder.material(R"("material": {"type": "conductor", "eta": 0.25, "k": 3})");
  CHECK(metal.eta == grey);
  CHECK(metal.k == Vec3{3, 3, 3});
  const auto raw =
      folder.material(R"("texture": {"type": "raw", "color": 0.25, "emission": 5, "material": "diffuse"})");
  CHECK(raw.color == grey);
  CHECK(raw.emission == Vec3{5, 5, 5});
  const Scene checker = folder.objects(
      R"({"type": "box", "material": {"type": "diffuse", "color": {"type": "checker", "a": 0.25, "b": 1, "scale": 4}}})");
  CHECK(checker.textures[0].a == grey);
  CHECK(checker.textures[0].b == Vec3{1, 1, 1});
  CHECK(checker.textures[0].scale == std::array<double, 2>{4, 4});

  const Scene lights =
      folder.objects(lamp, R"(, "medium": {"absorption": 0.5, "scattering": 0.25}, "lights": [
      {"type": "point", "position": [0, 5, 0], "intensity": 10},
      {"type": "spot", "position": [0, 5, 0], "target": [0, 0, 0], "angle": 30, "intensity": 20},
      {"type": "disk", "position": [0, 9, 0], "normal": [0, -1, 0], "radius": 1, "radiance": 7}])");
  CHECK(lights.lights[0].intensity == Vec3{10, 10, 10});
  CHECK(lights.lights[1].intensity == Vec3{20, 20, 20});
  CHECK(lights.materials.back().emission == Vec3{7, 7, 7});
  CHECK(lights.medium.absorption == Vec3{0.5, 0.5, 0.5});
  CHECK(lights.medium.scattering == grey);
  const Scene distant = folder.objects(lamp, R"(, "lights": [
      {"type": "directional", "direction": [0, -1, 0], "irradiance": 2}, {"type": "environment", "radiance": 0.25}])");
  CHECK(distant.lights[0].intensity == Vec3{2, 2, 2});
  CHECK(distant.lights[1].map.rgba[0] == 0.25f);
  const Scene disc = folder.objects(
      lamp, R"(, "renderer": {"type": "sppm", "light_pos": [0, 5, 0], "light_r": 1, "light_radiance": 4})");
  CHECK(disc.materials.back().emission == Vec3{4, 4, 4});
}

TEST_CASE("a grey has the range of its key, and places are no colours") {
  const SceneFolder folder;
  const auto fault = [&](const std::string& object) {
    return user_error_of([&] { folder.objects(object); });
  };
  CHECK_THAT(fault(R"({"type": "box", "material": {"type": "diffuse", "color": 2}})"),
             Catch::Contains("/color: expected a number from 0 to 1, got 2"));
  CHECK_THAT(fault(R"({"type": "box", "material": {"type": "diffuse", "color": "red"}})"),
             Catch::Contains("/color: expected a colour, got \"red\"; write [r, g, b]"));
  CHECK_THAT(user_error_of([&] { folder.camera(R"({"position": 3, "target": [0, 0, 0], "fov": 40})"); }),
             Catch::Contains("/camera/position: expected a vector, got 3"));
}

TEST_CASE("shifts, scales and turns by what is given, matrices row by row") {
  const SceneFolder folder;
  const auto image = [&](const std::string& steps, Vec3 point) {
    return folder.transform(steps).point(point);
  };
  CHECK(image(R"([{"type": "shift", "y": 2}])", {1, 1, 1}) == Vec3{1, 3, 1});
  CHECK(image(R"([{"type": "shift"}])", {1, 1, 1}) == Vec3{1, 1, 1});
  CHECK(image(R"([{"type": "scale", "z": 3}])", {1, 1, 1}) == Vec3{1, 1, 3});
  CHECK(image(R"([{"type": "scale", "factor": 2.5}])", {1, 2, 3}) == Vec3{2.5, 5, 7.5});
  CHECK(image(R"([{"type": "matrix", "values": [1, 2, 3, 4, 0, 1, 5, 6, 0, 0, 2, 7, 0, 0, 0, 1]}])",
              {1, 10, 100}) == Vec3{325, 516, 207});

  // About the axes as vectors it is what it is by name, to the bit; backwards for the opposite vector.
  for (const auto& [name, vector, opposite] : {std::tuple{"x", "[2, 0, 0]", "[-1, 0, 0]"},
                                               {"y", "[0, 3, 0]", "{\"x\": 0, \"y\": -4, \"z\": 0}"},
                                               {"z", "[0, 0, 1e-9]", "[0, 0, -1e-9]"}})
    for (const char* degree : {"90", "37.5", "-180"}) {
      const auto turned = [&](const std::string& axis, const std::string& by) {
        return image(R"([{"type": "rotate", "axis": )" + axis + R"(, "degree": )" + by + "}]", {1, 2, 3});
      };
      CAPTURE(name, degree);
      const Vec3 by_name = turned(std::string("\"") + name + "\"", degree);
      CHECK(turned(vector, degree) == by_name);
      const std::string back = degree[0] == '-' ? degree + 1 : std::string("-") + degree;
      CHECK(turned(opposite, back) == by_name);
    }
  // A third of a turn about the diagonal takes x to y, y to z and z to x.
  check_near(image(R"([{"type": "rotate", "axis": [1, 1, 1], "degree": 120}])", {1, 2, 3}), {3, 1, 2});
  check_near(
      image(R"([{"type": "rotateradian", "axis": [5, 5, 5], "radian": 2.0943951023931953}])", {1, 2, 3}),
      {3, 1, 2});
  // Any other: lengths and the axis stay, and the angle is right-handed.
  const Vec3 axis = normalize({1, -2, 0.5}), point{0.3, 0.4, -1.2};
  const Vec3 turned = image(R"([{"type": "rotate", "axis": [1, -2, 0.5], "degree": 50}])", point);
  const Vec3 before = point - dot(point, axis) * axis, after = turned - dot(turned, axis) * axis;
  CHECK(dot(turned, axis) == Approx(dot(point, axis)));
  CHECK(length(after) == Approx(length(before)));
  CHECK(dot(cross(before, after), axis) / dot(before, before) ==
        Approx(std::sin(50 * std::numbers::pi / 180)));
  CHECK(dot(before, after) / dot(before, before) == Approx(std::cos(50 * std::numbers::pi / 180)));
}

TEST_CASE("transforms that cannot be meant are refused") {
  const SceneFolder folder;
  const auto fault = [&](const std::string& step) {
    return user_error_of([&] { folder.transform("[" + step + "]"); });
  };
  const std::pair<const char*, const char*> cases[] = {
      {R"({"type": "rotate", "axis": [0, 0, 0], "degree": 5})",
       "/axis: expected an axis, got a vector of length 0"},
      {R"({"type": "rotate", "axis": "w", "degree": 5})", "/axis: expected \"x\", \"y\" or \"z\", got \"w\""},
      {R"({"type": "rotate", "axis": 5, "degree": 5})",
       "/axis: expected \"x\", \"y\" or \"z\", or a vector, got 5"},
      {R"({"type": "scale", "factor": 0})", "/factor: expected a factor other than 0, got 0"},
      {R"({"type": "scale", "factor": 2, "x": 3})",
       "/x: expected \"factor\", or \"x\", \"y\" and \"z\", got"},
      {R"({"type": "scale", "x": 0})", "/x: expected a factor other than 0, got 0"},
      {R"({"type": "matrix"})", "/values: expected a list of 16 numbers"},
      {R"({"type": "matrix", "values": [1, 0, 0, 0]})",
       "/values: expected a list of 16 numbers, the rows of a 4x4 matrix"},
      {R"({"type": "matrix", "values": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]})",
       "/values/12: expected 0, got 5; the last row of a matrix without perspective is 0, 0, 0, 1"},
      {R"({"type": "matrix", "values": [1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1]})",
       "/values: expected a matrix that has an inverse"},
      {R"({"type": "shift", "w": 1})", "unknown key \"w\""}};
  for (const auto& [step, message] : cases) CHECK_THAT(fault(step), Catch::Contains(message));
}

TEST_CASE("the renderer takes the words of the command line") {
  const SceneFolder folder;
  const auto renderer = [&](const std::string& text, const std::vector<Override>& overrides = {}) {
    SceneOptions options;
    options.overrides = overrides;
    return folder
        .load("{\"camera\": " + target_camera + ", \"renderer\": " + text + ", \"objects\": [" + lamp + "]}",
              options)
        .renderer;
  };
  const auto named =
      renderer(R"({"type": "Photon", "passes": 7, "photons": 800, "samples": 9, "visible_points": 3})");
  CHECK(named.integrator == Integrator::sppm);
  CHECK(named.passes == 7);
  CHECK(named.photons == 800);
  CHECK(named.samples == 9);
  CHECK(named.visible_points == 3);
  CHECK(renderer(R"({"type": "PT"})").integrator == Integrator::pt);
  CHECK(renderer(R"({"type": "path"})").integrator == Integrator::pt);
  // What a -D says replaces the key that the file has, by whichever name.
  CHECK(renderer(R"({"rounds": 100})", {{"renderer.passes", "3"}}).passes == 3);
  CHECK(renderer(R"({"passes": 100})", {{"renderer.rounds", "3"}}).passes == 3);
  CHECK(renderer(R"({"passes": 100})", {{"renderer.rounds", "3"}, {"renderer.passes", "4"}}).passes == 4);
  CHECK_THAT(
      user_error_of([&] { renderer(R"({"passes": 100, "rounds": 100})"); }),
      Catch::Contains("/renderer/passes: expected \"rounds\" or \"passes\", which are the same, got both"));
  CHECK_THAT(user_error_of([&] { renderer(R"({"photons": 0})"); }),
             Catch::Contains("/renderer/photons: expected an integer from 1"));
  CHECK_THAT(user_error_of([&] { renderer(R"({"type": "pathh"})"); }),
             Catch::Contains("\"pt\", got \"pathh\""));
}

TEST_CASE("a fraction written as a percentage is told how it is written") {
  const SceneFolder folder;
  const auto fault = [&](const std::string& renderer) {
    return user_error_of([&] { folder.objects(lamp, ", \"renderer\": " + renderer); });
  };
  CHECK_THAT(
      fault(R"({"alpha": 70})"),
      Catch::Contains("/renderer/alpha: expected a number between 0 and 1, both excluded, got 70; 70% is "
                      "written 0.7"));
  CHECK_THAT(fault(R"({"alpha": "70%"})"), Catch::Contains("got \"70%\"; 70% is written 0.7"));
  CHECK_THAT(fault(R"({"alpha": 700})"), Catch::Contains("got 700") && !Catch::Contains("written"));
  CHECK_THAT(user_error_of([&] {
               folder.objects(lamp,
                              R"(, "lights": [{"type": "spot", "position": [0, 5, 0], "target": [0, 0, 0],
                                        "angle": 30, "blend": 20, "intensity": 1}])");
             }),
             Catch::Contains("/blend: expected a number from 0 to 1, got 20; 20% is written 0.2"));
}

}  // namespace causticl
