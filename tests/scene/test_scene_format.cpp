// What each key of a scene file means, and its default.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scene.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {

const std::string target_camera = R"({"position": [1, 2, 3], "target": [1, 2, -1], "fov": 90})";
const std::string lamp =
    R"({"type": "sphere", "radius": 2, "material": {"type": "diffuse", "emission": [1, 2, 3]}})";

class SceneFolder {
 public:
  SceneFolder() {
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("smooth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
    std::filesystem::copy(std::string(CAUSTICL_SOURCE_DIR) + "/tests/cli/bad/intact.png",
                          folder.path("5x4.png"));
  }
  Scene load(const std::string& text, const SceneOptions& options = {}) const {
    return load_scene(folder.write("scene.json", text), options);
  }
  /// A scene of these objects (and the text of more keys at the top).
  Scene objects(const std::string& list, const std::string& more = "") const {
    return load("{\"camera\": " + target_camera + more + ", \"objects\": [" + list + "]}");
  }
  Scene camera(const std::string& text) const {
    return load("{\"width\": 200, \"height\": 100, \"camera\": " + text + ", \"objects\": [" + lamp + "]}");
  }
  Transform transform(const std::string& steps) const {
    return objects(R"({"type": "rectangle", "material": {"type": "mirror"}, "transform": )" + steps + "}")
        .objects[0]
        .transform;
  }
  /// The material of one object with this shape and this key.
  MaterialSpec material(const std::string& key, const std::string& shape = R"("type": "sphere", "radius": 1)",
                        const std::string& more = "") const {
    const Scene scene = objects("{" + shape + ", " + key + "}", more);
    return scene.materials[static_cast<std::size_t>(scene.objects[0].material)];
  }

  TemporaryFolder folder;
};

void check_near(Vec3 a, Vec3 b) {
  CHECK(a.x == Approx(b.x).margin(1e-12));
  CHECK(a.y == Approx(b.y).margin(1e-12));
  CHECK(a.z == Approx(b.z).margin(1e-12));
}

std::string notices_of(const Scene& scene) {
  std::string result;
  for (const std::string& notice : scene.notices)
    result += notice.substr(notice.find("scene.json") + 11) + "\n";
  return result;
}

}  // namespace

TEST_CASE("keys at the top and their defaults") {
  const SceneFolder folder;
  const Scene plain = folder.objects(lamp);
  CHECK(plain.output.empty());
  CHECK(plain.width == 640);
  CHECK(plain.height == 480);
  CHECK(plain.max_depth == 16);
  CHECK(plain.outside_ior == 1);
  CHECK(plain.renderer.integrator == Integrator::sppm);
  CHECK(plain.renderer.samples == 64);
  CHECK(plain.renderer.visible_points == 4);
  CHECK(plain.renderer.photons == 250000);
  CHECK(plain.renderer.passes == 64);
  CHECK(!plain.renderer.radius);
  CHECK(plain.renderer.alpha == 0.7);
  CHECK(plain.renderer.schedule == Schedule::pixel);
  CHECK(plain.notices.empty());

  const Scene given = folder.objects(
      lamp, R"(, "path": "a.png", "width": 32, "height": 16, "max_depth": 5, "Na": 1.1, "Ng": 1.7,
               "thread_num": 0, "stack_size": 267386880)");
  CHECK(given.output == "a.png");
  CHECK(given.width == 32);
  CHECK(given.height == 16);
  CHECK(given.max_depth == 5);
  CHECK(given.outside_ior == 1.1);
  CHECK(notices_of(given) ==
        "2: /thread_num: \"thread_num\" and \"stack_size\" are ignored: the device schedules itself\n");
}

TEST_CASE("renderers") {
  const SceneFolder folder;
  const auto renderer = [&](const std::string& text) {
    return folder.objects(lamp, ", \"renderer\": " + text).renderer;
  };
  CHECK(renderer(R"({"type": "pt", "sample": 25000})").integrator == Integrator::pt);
  CHECK(renderer(R"({"type": "pt", "sample": 25000})").samples == 25000);
  const RendererSpec sppm = renderer(
      R"({"type": "sppm", "view_point_sample": 1, "photon_sample": 1e6, "radius": 0.5, "alpha": 0.6, "rounds": 9,
          "schedule": "geometric", "radius_decay": 0.9, "direct_light": "photons"})");
  CHECK(sppm.integrator == Integrator::sppm);
  CHECK(sppm.visible_points == 1);
  CHECK(sppm.photons == 1000000);
  CHECK(sppm.radius == 0.5);
  CHECK(sppm.alpha == 0.6);
  CHECK(sppm.passes == 9);
  CHECK(sppm.schedule == Schedule::geometric);
  CHECK(sppm.radius_decay == 0.9);
  CHECK(sppm.direct_light == DirectLight::photons);
  CHECK(renderer(R"({"schedule": "global", "direct_light": "shadow_rays"})").schedule == Schedule::global);
  CHECK(renderer(R"({"direct_light": "shadow_rays"})").direct_light == DirectLight::shadow_rays);

  const Scene decay = folder.objects(lamp, R"(, "renderer": {"type": "sppm", "radius_decay": 0.95})");
  CHECK(decay.renderer.schedule == Schedule::pixel);
  CHECK(notices_of(decay) ==
        "1: /renderer/radius_decay: ignored, since a geometric decay does not converge: alpha rules the "
        "radius; "
        "\"schedule\": \"geometric\" brings it back\n");

  const Scene first_format = folder.objects(lamp, ", \"sample\": 200");
  CHECK(first_format.renderer.integrator == Integrator::pt);
  CHECK(first_format.renderer.samples == 200);
}

TEST_CASE("the disc light of the renderer is an object that emits downward") {
  const SceneFolder folder;
  const Scene scene = folder.objects(
      R"({"type": "plane", "material": {"type": "mirror"}})",
      R"(, "renderer": {"type": "pt", "light_pos": {"x": 50, "y": 81, "z": 7}, "light_r": 15})");
  REQUIRE(scene.objects.size() == 2);
  const Object& light = scene.objects[1];
  CHECK(light.is_disc_light);
  CHECK(light.shape == Object::Shape::disk);
  CHECK(light.pointer == "/renderer");
  CHECK(light.radius == 15);
  CHECK(light.transform.point({0, 0, 0}) == Vec3{50, 81, 7});
  CHECK(light.transform.vector({0, 0, 1}) == Vec3{0, -1, 0});
  CHECK(light.transform.determinant() == 1);
  const MaterialSpec& material = scene.materials[static_cast<std::size_t>(light.material)];
  CHECK(material.emission == Vec3{10, 10, 10});
  CHECK(material.color == Vec3{0, 0, 0});
  CHECK(!material.two_sided);
  CHECK(notices_of(scene) == "");
}

TEST_CASE("the camera of origin and direct") {
  const SceneFolder folder;
  const CameraSpec camera =
      folder
          .camera(R"({"origin": {"x": 50, "y": 52, "z": 295.6}, "direct": {"x": 0, "y": -3, "z": -4},
                        "view_angle_scale": 0.5, "plane_distance": 130, "focal_distance": 70, "aperture": 0.9})")
          .camera;
  CHECK(camera.origin == Vec3{50, 52, 295.6});
  check_near(camera.axis, {0, -0.6, -0.8});
  check_near(camera.right, {2 * 0.5, 0, 0});
  check_near(camera.up, {0, 0.4, -0.3});
  CHECK(camera.plane_distance == 130);
  CHECK(camera.focal_distance == 70);
  CHECK(camera.aperture == 0.9);
  CHECK(!camera.flat_focus);
  // A pinhole may have a focus at distance 0: nothing depends on it.
  const CameraSpec pinhole =
      folder
          .camera(R"({"origin": [0, 0, 0], "direct": [0, 0, -1], "view_angle_scale": 0.5,
                                             "plane_distance": 130, "focal_distance": 0, "aperture": 0})")
          .camera;
  CHECK(pinhole.focal_distance == 1);
}

TEST_CASE("the camera of position and target") {
  const SceneFolder folder;
  const CameraSpec camera = folder.camera(target_camera).camera;
  CHECK(camera.origin == Vec3{1, 2, 3});
  check_near(camera.axis, {0, 0, -1});
  check_near(camera.right, {4, 0, 0});
  check_near(camera.up, {0, 2, 0});
  CHECK(camera.plane_distance == 0);
  CHECK(camera.focal_distance == 4);
  CHECK(camera.aperture == 0);
  CHECK(camera.flat_focus);
  const CameraSpec tilted =
      folder
          .camera(R"({"position": [0, 0, 0], "target": [0, 3, 4], "up": [5, 1, 0], "fov": 60, "aperture": 0.2,
                        "focus_distance": 9})")
          .camera;
  CHECK(tilted.focal_distance == 9);
  CHECK(tilted.aperture == 0.2);
  CHECK(length(tilted.up) == Approx(2 / std::sqrt(3)));
  CHECK(length(tilted.right) == Approx(4 / std::sqrt(3)));
  CHECK(dot(tilted.up, tilted.axis) == Approx(0).margin(1e-12));
  CHECK(dot(tilted.up, {5, 1, 0}) > 0);
  check_near(cross(normalize(tilted.right), normalize(tilted.up)), -tilted.axis);
}

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

TEST_CASE("an infinite light is for path tracing only, whoever chooses the integrator") {
  const SceneFolder folder;
  const std::string plane = R"({"type": "plane", "material": {"type": "diffuse", "emission": [1, 1, 1]}})";
  const auto text = [&](const std::string& type) {
    return "{\"renderer\": {\"type\": \"" + type + "\"}, \"camera\": " + target_camera + ", \"objects\": [" +
           plane + "]}";
  };
  SceneOptions options;
  CHECK_NOTHROW(folder.load(text("pt")));
  CHECK_THROWS_AS(folder.load(text("sppm")), UserError);
  options.integrator = Integrator::pt;
  CHECK_NOTHROW(folder.load(text("sppm"), options));
  options.integrator = Integrator::sppm;
  CHECK_THROWS_AS(folder.load(text("pt"), options), UserError);
}

TEST_CASE("options replace what the file says") {
  const SceneFolder folder;
  const std::string text =
      "{\"width\": 10, \"height\": 10, \"camera\": " + target_camera + ", \"objects\": [" + lamp + "]}";
  SceneOptions options;
  options.size = {300, 100};
  options.integrator = Integrator::pt;
  options.overrides = {{"renderer.sample", "5"}, {"objects.0.radius", "7"}};
  const Scene scene = folder.load(text, options);
  CHECK(scene.width == 300);
  CHECK(scene.height == 100);
  CHECK(length(scene.camera.right) == Approx(3 * length(scene.camera.up)));
  CHECK(scene.renderer.integrator == Integrator::pt);
  CHECK(scene.renderer.samples == 5);
  CHECK(scene.objects[0].radius == 7);
}

}  // namespace causticl
