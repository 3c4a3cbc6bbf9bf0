// The same bits for the same seed, whatever the order of execution.
#include "catch2.hpp"

#include "device_fixture.hpp"
#include "render_fixture.hpp"

using namespace causticl;

namespace {

// Everything that could depend on order: photons through glass and by a mirror, several emitters, a texture.
const char* const busy_scene = R"({
  "width": 40, "height": 30, "max_depth": 8,
  "renderer": {"type": "sppm", "view_point_sample": 4, "photon_sample": 20000, "radius": 0.4},
  "camera": {"position": [0, 1.5, 6], "target": [0, 1, 0], "fov": 45, "aperture": 0.05},
  "materials": {
    "floor": {"type": "diffuse", "color": {"type": "checker", "a": [0.8, 0.8, 0.8], "b": [0.2, 0.3, 0.4], "scale": [4, 4]}},
    "glass": {"type": "glass", "ior": 1.5}, "mirror": {"type": "mirror", "color": [0.9, 0.9, 0.9]},
    "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [12, 10, 8]}},
  "objects": [
    {"type": "rectangle", "material": "floor",
     "transform": [{"type": "scale", "x": 8, "y": 8, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]},
    {"type": "sphere", "radius": 0.8, "material": "glass", "transform": [{"type": "shift", "x": -1, "y": 0.9, "z": 0}]},
    {"type": "box", "size": [1, 1.6, 1], "material": "mirror", "transform": [{"type": "shift", "x": 1.2, "y": 0.8, "z": -1}]},
    {"type": "sphere", "radius": 0.3, "material": "lamp", "transform": [{"type": "shift", "x": 1, "y": 3, "z": 1}]},
    {"type": "disk", "radius": 0.4, "material": "lamp",
     "transform": [{"type": "rotate", "axis": "x", "degree": 90}, {"type": "shift", "x": -2, "y": 3, "z": 0}]}]
})";

std::vector<float> pixels(Device& device, Integrator integrator, unsigned seed,
                          PhotonRays photon_rays = PhotonRays::automatic) {
  Scene scene = scene_from_text(busy_scene);
  scene.renderer.integrator = integrator;
  scene.renderer.passes = scene.renderer.samples = 5;
  RenderOptions options;
  options.seed = seed;
  options.photon_rays = photon_rays;
  return render_scene(scene, device, options).picture.rgb;
}

}  // namespace

TEST_CASE("images have the same bits for any work-group size, number of threads and run") {
  const DeviceInfo info = test_device().info();
  for (const Integrator integrator : {Integrator::sppm, Integrator::pt}) {
    Device reference(info);
    const auto expected = pixels(reference, integrator, 7);
    CHECK(pixels(reference, integrator, 7) == expected);
    for (const std::size_t local : {1, 32, 256}) {
      Device device(info);
      device.set_local_size(local);
      INFO("work-group size " << local);
      CHECK(pixels(device, integrator, 7) == expected);
      if (integrator == Integrator::sppm) CHECK(pixels(device, integrator, 7, PhotonRays::tree) == expected);
    }
    Device one_thread(info, 1);
    CHECK(pixels(one_thread, integrator, 7) == expected);
    CHECK(pixels(reference, integrator, 8) != expected);
  }
}
