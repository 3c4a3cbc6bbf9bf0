// What the keys of the scene, its renderer and its camera mean, and their defaults.
#include <cmath>

#include "format/load_scene.hpp"
#include "scene_folder.hpp"

namespace causticl {

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
      R"({"type": "sppm", "view_point_sample": 1, "photon_sample": 1e6, "radius": 0.5, "alpha": 0.6, "rounds": 9, "indirect_radius": 3, "guided_photons": true, "aimed_photons": false, "boundary_correction": false,
          "schedule": "geometric", "radius_decay": 0.9, "direct_light": "photons", "sampler": "independent"})");
  CHECK(sppm.integrator == Integrator::sppm);
  CHECK(sppm.visible_points == 1);
  CHECK(sppm.photons == 1000000);
  CHECK(sppm.radius == 0.5);
  CHECK(indirect_radius(sppm) == 3);
  CHECK(sppm.guided_photons);
  CHECK(sppm.aimed_photons == false);
  CHECK(!sppm.boundary_correction);
  CHECK(sppm.alpha == 0.6);
  CHECK(sppm.passes == 9);
  CHECK(sppm.schedule == Schedule::geometric);
  CHECK(sppm.radius_decay == 0.9);
  CHECK(sppm.direct_light == DirectLight::photons);
  CHECK(sppm.sampler == Sampler::independent);
  CHECK(indirect_radius(renderer(R"({"photon_sample": 160000})")) == 1);
  CHECK(renderer("{}").boundary_correction);
  CHECK(renderer("{}").sampler == Sampler::sobol);
  CHECK(!renderer("{}").guided_photons);
  CHECK(!renderer("{}").aimed_photons);
  CHECK(!aims_photons(folder.objects(lamp, "")));
  CHECK(aims_photons(folder.objects(lamp, R"(, "renderer": {"aimed_photons": true})")));
  const std::string sun =
      R"(, "lights": [{"type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1]}])";
  CHECK(aims_photons(folder.objects(lamp, sun)));
  CHECK(
      aims_photons(folder.objects(lamp, R"(, "lights": [{"type": "environment", "radiance": [1, 1, 1]}])")));
  CHECK(!aims_photons(folder.objects(lamp, R"(, "renderer": {"type": "pt"})" + sun)));
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
