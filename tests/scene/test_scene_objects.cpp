// What the keys of objects, materials and textures mean, and their defaults.
#include <cmath>
#include <numbers>

#include "scene_folder.hpp"

namespace causticl {

TEST_CASE("transforms apply in listed order, right-handed, quarter turns exact") {
  const SceneFolder folder;
  const auto image = [&](const std::string& steps, Vec3 point) {
    return folder.transform(steps).point(point);
  };
  CHECK(image("[]", {1, 2, 3}) == Vec3{1, 2, 3});
  CHECK(image(R"([{"type": "shift", "x": 1, "y": 0, "z": 0}, {"type": "scale", "x": 2, "y": 3, "z": 4}])",
              {1, 1, 1}) == Vec3{4, 3, 4});
  CHECK(image(R"([{"type": "scale", "x": 2, "y": 3, "z": 4}, {"type": "shift", "x": 1, "y": 0, "z": 0}])",
              {1, 1, 1}) == Vec3{3, 3, 4});
  CHECK(image(R"([{"type": "rotate", "axis": "x", "degree": 90}])", {0, 1, 0}) == Vec3{0, 0, 1});
  CHECK(image(R"([{"type": "rotate", "axis": "y", "degree": 90}])", {0, 0, 1}) == Vec3{1, 0, 0});
  CHECK(image(R"([{"type": "rotate", "axis": "z", "degree": -270}])", {1, 0, 0}) == Vec3{0, 1, 0});
  check_near(image(R"([{"type": "rotateradian", "axis": "z", "radian": 0.5}])", {1, 0, 0}),
             {std::cos(0.5), std::sin(0.5), 0});
  check_near(image(R"([{"type": "rotate", "axis": "z", "degree": 30}])", {1, 0, 0}),
             {std::cos(std::numbers::pi / 6), 0.5, 0});
}

TEST_CASE("objects") {
  const SceneFolder folder;
  const std::string mirror = R"(, "material": {"type": "mirror"}})";
  const auto object = [&](const std::string& text) { return folder.objects(text + mirror).objects[0]; };
  CHECK(object(R"({"type": "sphere", "radius": 3)").shape == Object::Shape::sphere);
  CHECK(object(R"({"type": "sphere", "radius": 3)").radius == 3);
  CHECK(object(R"({"type": "sphere", "radius": 3, "transform": [{"type": "scale", "x": -2, "y": 2, "z": 2},
                   {"type": "rotate", "axis": "x", "degree": 33}])")
            .transform.determinant() == Approx(-8));
  CHECK(object(R"({"type": "plane")").shape == Object::Shape::plane);
  CHECK(object(R"({"type": "rectangle")").shape == Object::Shape::rectangle);
  CHECK(object(R"({"type": "disk")").shape == Object::Shape::disk);
  CHECK(object(R"({"type": "disk")").radius == 1);
  CHECK(object(R"({"type": "box", "size": [1, 2, 3])").size == Vec3{1, 2, 3});
  CHECK(object(R"({"type": "box")").size == Vec3{1, 1, 1});
  const Object curve = object(R"({"type": "bezier_rotate", "point": [[0, 0], [12.5, 0], [-1, 3], [4, 5]])");
  CHECK(curve.shape == Object::Shape::bezier);
  REQUIRE(curve.points.size() == 4);
  CHECK(curve.points[1] == std::array<double, 2>{12.5, 0});
  CHECK(object(R"({"type": "mesh", "path": "smooth.obj")").smooth);
  CHECK(!object(R"({"type": "mesh", "path": "flat.obj")").smooth);
  CHECK(object(R"({"type": "mesh", "path": "flat.obj", "smooth": true)").smooth);
  CHECK(!object(R"({"type": "mesh", "path": "smooth.obj", "smooth": false)").smooth);
  CHECK(folder.objects(lamp + ", " + lamp).objects[1].pointer == "/objects/1");
}

TEST_CASE("meshes and images are read once, beside the scene file") {
  const SceneFolder folder;
  const std::string mesh =
      R"({"type": "mesh", "path": "smooth.obj", "tree_type": "MyTree", "material": {"type": "diffuse",
                             "color": {"type": "image", "path": "./5x4.png", "color_space": "linear"}}})";
  const std::string base =
      R"({"type": "mesh", "path": "./smooth.obj", "tree_type": "BSPTree", "texture": {"type": "image",
                             "path": "5x4.png", "material": "diffuse", "width_ratio": 1, "height_ratio": 1}})";
  const Scene scene = folder.objects(mesh + ", " + base + ", " + lamp);
  CHECK(scene.meshes.size() == 1);
  CHECK(scene.images.size() == 1);
  CHECK(scene.objects[1].mesh == 0);
  CHECK(notices_of(scene) ==
        "1: /objects/0/tree_type: every mesh is put into the KD-tree; \"tree_type\" is ignored\n");
}

TEST_CASE("materials") {
  const SceneFolder folder;
  using Kind = MaterialSpec::Kind;
  const MaterialSpec diffuse =
      folder.material(R"("material": {"type": "diffuse", "color": [0.1, 0.2, 0.3]})");
  CHECK(diffuse.kind == Kind::diffuse);
  CHECK(diffuse.color == Vec3{0.1, 0.2, 0.3});
  CHECK(diffuse.color_texture == -1);
  CHECK(diffuse.emission == Vec3{0, 0, 0});
  const MaterialSpec glass = folder.material(R"("material": {"type": "glass"})");
  CHECK(glass.kind == Kind::glass);
  CHECK(glass.color == Vec3{1, 1, 1});
  CHECK(glass.ior == 1.5);
  CHECK(folder.material(R"("material": {"type": "glass"})", R"("type": "disk")", ", \"Ng\": 1.7").ior == 1.7);
  CHECK(folder.material(R"("material": {"type": "glass", "ior": 1.33})").ior == 1.33);
  const MaterialSpec mirror =
      folder.material(R"("material": {"type": "mirror", "emission": [1, 2, 3], "two_sided": true})");
  CHECK(mirror.kind == Kind::mirror);
  CHECK(mirror.emission == Vec3{1, 2, 3});
  CHECK(mirror.two_sided);
  CHECK(!folder.material(R"("material": {"type": "mirror", "emission": [1, 2, 3]})").two_sided);

  const Scene named = folder.objects(
      R"({"type": "disk", "material": "b"}, {"type": "box", "material": "a"}, {"type": "box", "material": "b"})",
      R"(, "materials": {"a": {"type": "mirror"}, "b": {"type": "glass"}})");
  CHECK(named.materials.size() == 2);
  CHECK(named.objects[0].material == 1);
  CHECK(named.objects[1].material == 0);
  CHECK(named.objects[2].material == 1);
}

TEST_CASE("textures of materials") {
  const SceneFolder folder;
  const auto texture = [&](const std::string& color) {
    const Scene scene =
        folder.objects(R"({"type": "disk", "material": {"type": "diffuse", "color": )" + color + "}}");
    const MaterialSpec& material = scene.materials[0];
    CHECK(!material.alpha_diffuse);
    return scene.textures.at(static_cast<std::size_t>(material.color_texture));
  };
  const TextureSpec checker =
      texture(R"({"type": "checker", "a": [0, 0, 0], "b": [1, 0.5, 1], "scale": [4, 8]})");
  CHECK(checker.kind == TextureSpec::Kind::checker);
  CHECK(checker.b == Vec3{1, 0.5, 1});
  CHECK(checker.scale == std::array<double, 2>{4, 8});
  const TextureSpec image = texture(R"({"type": "image", "path": "5x4.png"})");
  CHECK(image.kind == TextureSpec::Kind::image);
  CHECK(image.image == 0);
  CHECK(!image.bilinear);
  CHECK(image.scale == std::array<double, 2>{1, 1});
  CHECK(texture(R"({"type": "image", "path": "5x4.png", "filter": "bilinear"})").bilinear);

  // sRGB is the default here, linear in the base format's textures.
  const std::string sphere = R"({"type": "sphere", "radius": 1, )";
  const Scene spaces = folder.objects(
      sphere + R"("material": {"type": "diffuse", "color": {"type": "image", "path": "5x4.png"}}}, )" +
      sphere +
      R"("material": {"type": "diffuse", "color": {"type": "image", "path": "5x4.png", "color_space": "srgb"}}}, )" +
      sphere +
      R"("texture": {"type": "image", "path": "5x4.png", "material": "diffuse", "color_space": "srgb"}}, )" +
      sphere + R"("texture": {"type": "image", "path": "5x4.png", "material": "diffuse"}})");
  CHECK(spaces.images.size() == 2);
  CHECK(spaces.textures[0].image == spaces.textures[1].image);
  CHECK(spaces.textures[0].image == spaces.textures[2].image);
  CHECK(spaces.textures[0].image != spaces.textures[3].image);
}

TEST_CASE("textures of the base format") {
  const SceneFolder folder;
  using Kind = MaterialSpec::Kind;
  const std::string raw = R"("texture": {"type": "raw", "emission": {"x": 12, "y": 12, "z": 0},
                             "color": {"x": 0.5, "y": 0, "z": 1}, "material": "refractive"})";
  const MaterialSpec material = folder.material(raw, R"("type": "sphere", "radius": 1)", ", \"Ng\": 1.6");
  CHECK(material.kind == Kind::glass);
  CHECK(material.ior == 1.6);
  CHECK(material.emission == Vec3{12, 12, 0});
  CHECK(material.color == Vec3{0.5, 0, 1});
  CHECK(material.two_sided);
  CHECK(!material.alpha_diffuse);
  CHECK(folder.material(R"("texture": {"type": "raw", "color": [1, 1, 1], "material": "specular"})").kind ==
        Kind::mirror);

  const std::string image = R"("texture": {"type": "image", "path": "5x4.png", "material": "specular",
                               "width_ratio": 0.1, "height_ratio": 0.5})";
  const auto scene_of = [&](const std::string& shape) {
    return folder.objects("{" + shape + ", " + image + "}");
  };
  const Scene plane = scene_of(R"("type": "plane")");
  // One image, 5 x 4 texels, is 0.5 x 2 units large.
  CHECK(plane.textures[0].scale[0] == Approx(2));
  CHECK(plane.textures[0].scale[1] == Approx(0.5));
  CHECK(!plane.textures[0].bilinear);
  CHECK(!plane.materials[0].alpha_diffuse);
  CHECK(plane.materials[0].kind == Kind::mirror);
  const Scene sphere = scene_of(R"("type": "sphere", "radius": 1)");
  CHECK(sphere.textures[0].scale == std::array<double, 2>{1, 1});
  CHECK(sphere.materials[0].alpha_diffuse);
  CHECK(scene_of(R"("type": "bezier_rotate", "point": [[1, 0], [1, 1]])").materials[0].alpha_diffuse);
  const Scene mesh = scene_of(R"("type": "mesh", "path": "flat.obj")");
  CHECK(!mesh.materials[0].alpha_diffuse);
  CHECK(notices_of(mesh) ==
        "1: /objects/0: the mesh has no (u, v): its texture shows the one texel at (0, 0)\n"
        "1: /: no light: the image will be black\n");

  const Scene bright = folder.objects(
      R"({"type": "disk", "texture": {"type": "raw", "color": [1.5, 0.5, 1], "material": "diffuse"}}, )" +
      lamp);
  CHECK(bright.materials[0].color == Vec3{1, 0.5, 1});
  CHECK(notices_of(bright) == "1: /objects/0/texture/color: reflectance above 1 is taken as 1\n");
}

}  // namespace causticl
