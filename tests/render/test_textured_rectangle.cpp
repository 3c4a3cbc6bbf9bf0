// A rectangle with an image of 4 x 4 texels gives the light of 16 rectangles of constant radiance.
#include <algorithm>

#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "image/image_formats.hpp"
#include "render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

constexpr int side = 4;
constexpr double width = 2, height = 1.2;

Picture colours() {
  Picture picture{side, side, {}};
  for (int i = 0; i < side * side; ++i)
    for (int c = 0; c < 3; ++c)
      picture.rgb.push_back(i % 5 == 3 ? 0 : static_cast<float>((7 * i + 5 * c) % 11));
  return picture;
}

// A lamp that faces down and a little forward over a floor, with a rough metal ball under it.
std::string scene_of(const std::string& objects, const std::string& lights) {
  return R"({"width": 32, "height": 24, "max_depth": 4,
    "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 60000, "radius": 0.15},
    "camera": {"position": [0, 2.5, 5.5], "target": [0, 0.9, 0], "fov": 42},
    "materials": {"floor": {"type": "diffuse", "color": [0.6, 0.6, 0.6]}, "black": {"type": "diffuse", "color": 0},
      "metal": {"type": "conductor", "eta": 0.2, "k": 3, "roughness": 0.5}},
    "objects": [{"type": "rectangle", "material": "floor", "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1},
      {"type": "rotate", "axis": "x", "degree": -90}]},
      {"type": "sphere", "radius": 0.5, "material": "metal", "transform": [{"type": "shift", "x": 0.6, "y": 0.5001, "z": 0}]})" +
         objects + R"(], "lights": [)" + lights + "]}";
}

// From the plane z = 0 to where the lamp hangs.
constexpr const char* placing =
    R"({"type": "rotate", "axis": "x", "degree": 60}, {"type": "shift", "x": 0, "y": 2, "z": -0.4})";

std::string sixteen_rectangles(const Picture& picture) {
  std::string text;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const float* rgb = &picture.rgb[static_cast<std::size_t>(3 * (row * side + column))];
      const auto number = [](double value) { return std::to_string(value); };
      text += R"(, {"type": "rectangle", "material": {"type": "diffuse", "color": 0, "emission": [)" +
              number(rgb[0]) + "," + number(rgb[1]) + "," + number(rgb[2]) +
              R"(]}, "transform": [{"type": "scale", "x": )" + number(width / side) + R"(, "y": )" +
              number(height / side) + R"(, "z": 1}, {"type": "shift", "x": )" +
              number(((column + 0.5) / side - 0.5) * width) + R"(, "y": )" +
              number((0.5 - (row + 0.5) / side) * height) + R"(, "z": 0}, )" + placing + "]}";
    }
  return text;
}

struct Pair {
  TemporaryFolder folder;
  Scene image, parts;
  Pair() {
    const Picture picture = colours();
    folder.write("image.pfm", encode_pfm(picture));
    // z turned about x by 60 degrees is (0, -sin 60, cos 60), and y is (0, cos 60, sin 60).
    image =
        load_scene(folder.write("image.json", scene_of("", R"({"type": "rectangle", "position": [0, 2, -0.4],
          "normal": [0, -0.8660254038, 0.5], "up": [0, 0.5, 0.8660254038], "size": [2, 1.2],
          "radiance": {"type": "image", "path": "image.pfm"}})")));
    parts = load_scene(folder.write("parts.json", scene_of(sixteen_rectangles(picture), "")));
  }
};

void check_same_means(const Scene& image, const Scene& parts, Integrator integrator, int passes) {
  const Vec3 a = mean_color(render_with(image, integrator, passes).picture),
             b = mean_color(render_with(parts, integrator, passes).picture);
  CAPTURE(a.x, b.x, a.y, b.y, a.z, b.z);
  for (int c = 0; c < 3; ++c) CHECK(a[c] == Approx(b[c]).epsilon(0.005));
}

}  // namespace

TEST_CASE("a rectangle with an image gives the light of rectangles of constant radiance") {
  const Pair scenes;
  check_same_means(scenes.image, scenes.parts, Integrator::pt, 512);
  check_same_means(scenes.image, scenes.parts, Integrator::sppm, 64);
  Scene image = scenes.image, parts = scenes.parts;
  image.renderer.direct_light = parts.renderer.direct_light = DirectLight::photons;
  check_same_means(image, parts, Integrator::sppm, 64);
}

TEST_CASE("a rectangle with an image looks and lights as rectangles of constant radiance, place by place") {
  Pair scenes;
  for (Scene* scene : {&scenes.image, &scenes.parts}) scene->max_depth = 1;
  const auto at = [](Scene scene, Vec3 origin, Vec3 toward, double extent) {
    scene.width = scene.height = 4;
    scene.camera.origin = origin;
    scene.camera.axis = normalize(toward - origin);
    scene.camera.right = extent * normalize(cross(scene.camera.axis, Vec3{0, 0.6, 0.8}));
    scene.camera.up = extent * normalize(cross(scene.camera.right, scene.camera.axis));
    return scene;
  };
  const auto pictures = [&](Vec3 origin, Vec3 toward, double extent, int samples) {
    return std::pair{
        render_with(at(scenes.image, origin, toward, extent), Integrator::pt, samples).picture.rgb,
        render_with(at(scenes.parts, origin, toward, extent), Integrator::pt, samples).picture.rgb};
  };
  const Vec3 lamp{0, 2, -0.4}, front{0, -0.8660254038, 0.5};
  const auto [seen, seen_parts] = pictures(lamp + front, lamp, 0.4, 64);
  CHECK(seen == seen_parts);
  CHECK(*std::max_element(seen.begin(), seen.end()) == 9);
  for (const Vec3 place : {Vec3{-0.9, 0, 0}, Vec3{0, 0, 0.4}, Vec3{-0.3, 0, 1.5}, Vec3{-2, 0, -1}}) {
    CAPTURE(place.x, place.z);
    const auto [lit, lit_parts] = pictures(place + Vec3{0, 0.05, 0.02}, place, 1e-3, 16384);
    for (std::size_t c = 0; c < 3; ++c) {
      double a = 0, b = 0;
      for (std::size_t i = c; i < lit.size(); i += 3) a += lit[i], b += lit_parts[i];
      CHECK(a == Approx(b).epsilon(0.005));
    }
  }
}
