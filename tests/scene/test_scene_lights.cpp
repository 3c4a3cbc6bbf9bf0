// The key `lights`.
#include <cmath>
#include <limits>

#include "effects/effects.hpp"
#include "image/image_formats.hpp"
#include "scene_folder.hpp"
#include "shared/effects.h"
#include "world/flat_scene.hpp"

namespace causticl {
namespace {

const std::string floor_object = R"({"type": "rectangle", "material": {"type": "diffuse"}})";

Scene with_lights(const SceneFolder& folder, const std::string& lights) {
  return folder.objects(floor_object, ", \"lights\": [" + lights + "]");
}

}  // namespace

TEST_CASE("point, spot and directional lights") {
  const SceneFolder folder;
  const Scene scene = with_lights(folder, R"(
    {"type": "point", "position": [1, 2, 3], "intensity": [4, 5, 6]},
    {"type": "spot", "position": [0, 4, 0], "target": [0, 1, 0], "angle": 40, "blend": 0.25, "intensity": [1, 1, 1]},
    {"type": "directional", "direction": [0, 0, -2], "irradiance": [7, 8, 9]},
    {"type": "spot", "position": [0, 4, 0], "target": [4, 4, 0], "angle": 10, "intensity": [0, 0, 0]})");
  REQUIRE(scene.lights.size() == 4);
  CHECK(scene.lights[0].kind == LightSpec::Kind::point);
  CHECK(scene.lights[0].pointer == "/lights/0");
  CHECK(scene.lights[0].position == Vec3{1, 2, 3});
  CHECK(scene.lights[0].intensity == Vec3{4, 5, 6});
  CHECK(scene.lights[1].kind == LightSpec::Kind::spot);
  CHECK(scene.lights[1].direction == Vec3{0, -1, 0});
  CHECK(scene.lights[1].angle == 40);
  CHECK(scene.lights[1].blend == 0.25);
  CHECK(scene.lights[2].kind == LightSpec::Kind::directional);
  CHECK(scene.lights[2].direction == Vec3{0, 0, -1});
  CHECK(scene.lights[2].intensity == Vec3{7, 8, 9});
  CHECK(scene.lights[3].blend == 0);
  CHECK(is_lit(scene.lights[0]));
  CHECK(!is_lit(scene.lights[3]));
  CHECK(notices_of(scene) == "");
  CHECK(notices_of(
            with_lights(folder, R"({"type": "point", "position": [1, 2, 3], "intensity": [0, 0, 0]})")) ==
        "1: /: no light: the image will be black\n");
}

TEST_CASE("surfaces that should emit light, but without an area give none, are named") {
  const SceneFolder folder;
  folder.folder.write("flat_lamp.obj", "v -1 3 -1\nv 1 3 -1\nv 1 3 1\nf 1 1 1\nf 1 2 2\n");
  folder.folder.write("line.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
  folder.folder.write("tiny.obj", "v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n");
  folder.folder.write("half.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\n");
  const auto emitter = [](const std::string& file, const std::string& emission = "[5, 5, 5]") {
    return R"({"type": "mesh", "path": ")" + file + R"(", "material": {"type": "diffuse", "emission": )" +
           emission + "}}";
  };
  const std::string dark = "no light: the image will be black";
  for (const std::string file : {"flat_lamp.obj", "line.obj", "tiny.obj"}) {
    CAPTURE(file);
    const Scene scene = folder.objects(floor_object + ", " + emitter(file));
    CHECK(notices_of(scene) ==
          "1: /: " + dark + "; /objects/1 should emit light, but without an area gives none\n");
    CHECK(!has_light(scene));
    CHECK(flatten_scene(scene).emitters.empty());
    const Scene lit = folder.objects(emitter(file) + ", " + emitter(file) + ", " + lamp);
    CHECK(notices_of(lit) ==
          "1: /: /objects/0 and others should emit light, but without an area gives none\n");
    CHECK(has_light(lit));
    CHECK(flatten_scene(lit).emitters.size() == 1);
  }
  CHECK(notices_of(folder.objects(emitter("half.obj"))) == "");
  CHECK(notices_of(folder.objects(emitter("half.obj", "[1e-60, 0, 0]"))) == "1: /: " + dark + "\n");
}

TEST_CASE("a disk among the lights is an object that emits on the side of its normal") {
  const SceneFolder folder;
  for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-2, 3, 0.5}}) {
    const std::string text = "[" + std::to_string(normal.x) + ", " + std::to_string(normal.y) + ", " +
                             std::to_string(normal.z) + "]";
    const Scene scene =
        with_lights(folder, R"({"type": "disk", "position": [1, 2, 3], "radius": 0.5, "normal": )" + text +
                                R"(, "radiance": [4, 5, 6]})");
    REQUIRE(scene.objects.size() == 2);
    const Object& light = scene.objects[1];
    CHECK(light.shape == Object::Shape::disk);
    CHECK(light.pointer == "/lights/0");
    CHECK(light.radius == 0.5);
    check_near(light.transform.point({0, 0, 0}), {1, 2, 3});
    check_near(light.transform.vector({0, 0, 1}), normalize(normal));
    CHECK(light.transform.determinant() == Approx(1));
    const MaterialSpec& material = scene.materials[static_cast<std::size_t>(light.material)];
    CHECK(material.emission == Vec3{4, 5, 6});
    CHECK(!material.two_sided);
  }
}

TEST_CASE("environments of one radiance and of an image") {
  const SceneFolder folder;
  const Scene low_discrepancy = with_lights(folder, R"({"type": "environment", "radiance": [1, 2, 3]})");
  REQUIRE(low_discrepancy.lights.size() == 1);
  CHECK(low_discrepancy.lights[0].pointer == "/lights/0");
  CHECK(low_discrepancy.lights[0].rotation == 0);
  for (std::size_t i = 0; i < low_discrepancy.lights[0].map.rgba.size(); i += 4) {
    REQUIRE(low_discrepancy.lights[0].map.rgba[i] == 1);
    REQUIRE(low_discrepancy.lights[0].map.rgba[i + 2] == 3);
  }
  const Scene image = with_lights(folder, R"({"type": "environment", "path": "5x4.png", "rotation": 90})");
  REQUIRE(image.lights.size() == 1);
  CHECK(image.lights[0].map.width == 5);
  CHECK(image.lights[0].map.height == 4);
  CHECK(image.lights[0].rotation == 90);
}

TEST_CASE("radiance of an image is as bright as it is; texels that are no light are counted and black") {
  const SceneFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  // Top row first: the last texels are at the bottom, which comes first in an image.
  const Picture picture{2, 2, {1, nan, 2, 7000, 8000, 9e11f, -1, 0, 0, 1, 2, infinity}};
  folder.folder.write("sky.pfm", encode_pfm(picture));
  folder.folder.write("sky.exr", encode_exr(picture, {}));
  for (const std::string name : {"sky.pfm", "sky.exr"}) {
    const Scene scene = with_lights(folder, R"({"type": "environment", "path": ")" + name + "\"}");
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].map.rgba ==
          std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 7000, 8000, 9e11f, 1});
    CHECK(notices_of(scene) ==
          "1: /lights/0/path: 3 texels that are not from 0 to 1e12, or no number, are taken as black\n");
  }
  folder.folder.write("dark.pfm", encode_pfm({1, 1, {0, nan, 0}}));
  CHECK(notices_of(with_lights(folder, R"({"type": "environment", "path": "dark.pfm"})")) ==
        "1: /lights/0/path: 1 texel that is not from 0 to 1e12, or no number, is taken as black\n"
        "1: /: no light: the image will be black\n");
}

TEST_CASE("light from beyond the scene goes with infinite planes") {
  const SceneFolder folder;
  for (const std::string light :
       {R"({"type": "environment", "radiance": [1, 1, 1]})",
        R"({"type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1]})"}) {
    const std::string text = "{\"camera\": " + target_camera + ", \"lights\": [" + light +
                             R"(], "objects": [{"type": "plane", "material": {"type": "diffuse"}}]})";
    const Scene scene = folder.load(text);
    CHECK((effect_bits(find_effects(scene)) & EFFECT_HORIZON) != 0);
  }
  const Scene scene =
      folder.objects(R"({"type": "plane", "material": {"type": "diffuse"}})",
                     R"(, "lights": [{"type": "point", "position": [0, 1, 0], "intensity": [1, 1, 1]}])");
  CHECK((effect_bits(find_effects(scene)) & EFFECT_HORIZON) == 0);
}

}  // namespace causticl
