// Whole pictures whose camera paths end in a batch (cl/photons/first_diffuse_vertices.cl), and those of
// programs that finish each path alone, as they do for any effect that keeps the loops from being vectorised:
// the same to the bit, with the same counts.
#include "catch2.hpp"

#include "device_fixture.hpp"
#include "effects/effects.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

/// A floor and a wall with a ball, a lamp of each kind that has an area, glass and a mirror.
Scene lamps_and_glass(int width, int height) {
  Scene scene = scene_from_text(R"({
    "width": 8, "height": 8, "max_depth": 9,
    "renderer": {"type": "sppm", "photon_sample": 20000, "radius": 0.3},
    "camera": {"position": [0, 1, 4.5], "target": [0, 1, 0], "up": [0, 1, 0], "fov": 50},
    "materials": {
      "white": {"type": "diffuse", "color": [0.8, 0.7, 0.6]},
      "lamp": {"type": "diffuse", "color": [0.2, 0.2, 0.2], "emission": [9, 8, 7], "two_sided": true},
      "bulb": {"type": "diffuse", "color": [0, 0, 0], "emission": [30, 40, 50]},
      "glass": {"type": "glass", "ior": 1.5},
      "mirror": {"type": "mirror", "color": [0.9, 0.9, 0.9]}
    },
    "objects": [
      {"type": "rectangle", "material": "white", "transform": [{"type": "scale", "x": 4, "y": 4, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]},
      {"type": "rectangle", "material": "white", "transform": [{"type": "scale", "x": 4, "y": 4, "z": 1}, {"type": "shift", "x": 0, "y": 2, "z": -2}]},
      {"type": "rectangle", "material": "lamp", "transform": [{"type": "rotate", "axis": "x", "degree": 70}, {"type": "shift", "x": 0.9, "y": 1.9, "z": 0}]},
      {"type": "sphere", "material": "bulb", "radius": 0.1, "transform": [{"type": "shift", "x": -0.8, "y": 1.7, "z": 0.3}]},
      {"type": "sphere", "material": "white", "radius": 0.4, "transform": [{"type": "shift", "x": 0.1, "y": 0.4, "z": -1}]},
      {"type": "sphere", "material": "glass", "radius": 0.5, "transform": [{"type": "shift", "x": -0.7, "y": 0.5, "z": 0.6}]},
      {"type": "sphere", "material": "mirror", "radius": 0.5, "transform": [{"type": "shift", "x": 0.9, "y": 0.5, "z": 0.2}]}
    ]
  })");
  scene.width = width;
  scene.height = height;
  return scene;
}

std::string called_effects(const Scene& scene) {
  std::string keys;
  for (const auto& effect : find_effects(scene))
    if (!effect.reason.empty()) keys += effect.key + ",";
  return keys;
}

/// The effects that the scene calls for and one with which not even Lambert vertices are a batch; where there
/// is no medium it changes nothing else.
std::string with_medium(const Scene& scene) { return called_effects(scene) + "medium"; }

void check_same(Scene scene, PhotonRays rays = PhotonRays::automatic,
                CameraRays camera_rays = CameraRays::automatic) {
  scene.renderer.integrator = Integrator::sppm;
  scene.renderer.passes = 3;
  scene.renderer.photons = 5000;
  RenderOptions options;
  options.photon_rays = rays;
  options.camera_rays = camera_rays;
  const auto batched = render_scene(scene, test_device(), options);
  options.effects = with_medium(scene);
  const auto alone = render_scene(scene, test_device(), options);
  INFO(scene.file << ", " << scene.renderer.visible_points << " visible points, " << scene.width << " x "
                  << scene.height << ", at most " << scene.max_depth << " hits");
  check_same_render(batched, alone);
}

}  // namespace

TEST_CASE("camera paths that end side by side give the picture of those that end alone") {
  if (!test_device().has_serial_work_items()) {
    WARN("skipped: on this device every path ends alone, and programs differ by roundings");
    return;
  }
  Scene scene = lamps_and_glass(37, 29);
  for (const int visible_points : {1, 2, 3, 5}) {
    scene.renderer.visible_points = visible_points;
    for (const PhotonRays rays : {PhotonRays::tree, PhotonRays::brute_force}) check_same(scene, rays);
    check_same(scene, PhotonRays::automatic, CameraRays::single);
  }
  for (const int max_depth : {0, 1, 2}) {
    scene.max_depth = max_depth;
    check_same(scene);
  }
  scene.max_depth = 9;
  scene.renderer.direct_light = DirectLight::photons;
  check_same(scene);
  scene.renderer.direct_light = DirectLight::shadow_rays;
  scene.renderer.sampler = Sampler::independent;
  check_same(scene);
  scene.renderer.boundary_correction = false;
  check_same(scene);
}

TEST_CASE("batches that are compiled for textures need none") {
  if (!test_device().has_serial_work_items()) {
    WARN("skipped: on this device there are no batches, and programs differ by roundings");
    return;
  }
  Scene scene = lamps_and_glass(19, 23);
  scene.renderer.integrator = Integrator::sppm;
  scene.renderer.passes = 2;
  scene.renderer.photons = 5000;
  RenderOptions options;
  const auto without = render_scene(scene, test_device(), options);
  options.effects = called_effects(scene) + "textures";
  check_same_render(render_scene(scene, test_device(), options), without);
}

TEST_CASE("camera paths that end side by side give the picture of those that end alone: many primitives") {
  if (!test_device().has_serial_work_items()) {
    WARN("skipped: on this device every path ends alone, and programs differ by roundings");
    return;
  }
  check_same(shipped_scene("effects/next_room.json", 40, 30));  // shadow rays through the tree
  check_same(shipped_scene("cornell_box.json", 163, 211));      // launches that end within a row
}

namespace {

void check_same_shipped(std::initializer_list<const char*> scenes) {
  if (!test_device().has_serial_work_items()) {
    WARN("skipped: on this device every path ends alone, and programs differ by roundings");
    return;
  }
  for (const char* scene : scenes) check_same(shipped_scene(std::string(scene) + ".json", 43, 31));
}

}  // namespace

TEST_CASE("Lambert vertices in batches give the picture of those that are met alone: many effects") {
  check_same_shipped({"7_sppm_room", "glass_caustic", "effects/rough_metals"});
}

TEST_CASE("Lambert vertices in batches give the picture of those that are met alone: all effects", "[long]") {
  check_same_shipped({"3_bezier_solids", "effects/coloured_glass", "effects/point_lights",
                      "effects/leaded_window", "effects/picture_lamp", "effects/prism", "effects/tubes",
                      "tumbler", "effects/sun"});
}
