// Sun and sky on infinite planes: both integrators agree.
#include "catch2.hpp"

#include "render_fixture.hpp"

using namespace causticl;

namespace {

Scene outdoors(const std::string& planes, const std::string& lights) {
  return scene_from_text(R"({"width": 32, "height": 24,
    "camera": {"position": [0, 1, 4], "target": [0, 0.6, 0], "fov": 45},
    "renderer": {"type": "sppm", "photon_sample": 40000, "radius": 0.15},
    "materials": {"grey": {"type": "diffuse", "color": [0.6, 0.6, 0.6]}, "red": {"type": "diffuse", "color": [0.8, 0.3, 0.2]}},
    "objects": [)" + planes +
                         R"(
      {"type": "box", "size": [0.6, 1, 0.6], "material": "grey", "transform": [{"type": "shift", "x": -0.6, "y": 0.5, "z": 0}]},
      {"type": "sphere", "radius": 0.4, "material": "red", "transform": [{"type": "shift", "x": 0.6, "y": 0.4, "z": 0}]}],
    "lights": [)" + lights +
                         "]}");
}

const std::string ground =
    R"({"type": "plane", "material": "grey", "transform": [{"type": "rotate", "axis": "x", "degree": -90}]},)";
const std::string wall =
    R"({"type": "plane", "material": "red", "transform": [{"type": "shift", "x": 0, "y": 0, "z": -2}]},)";
const std::string sun =
    R"({"type": "directional", "direction": [-0.5, -0.6, -0.4], "irradiance": [3, 3, 3]})";
const std::string sky = R"({"type": "environment", "radiance": [0.5, 0.6, 0.8]})";

void check_means(Scene scene, double tolerance) {
  const double traced = mean_luminance(render_with(scene, Integrator::pt, 1024).picture);
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 32).picture) ==
        Approx(traced).epsilon(tolerance));
  scene.renderer.direct_light = DirectLight::photons;
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 32).picture) ==
        Approx(traced).epsilon(2 * tolerance));
}

}  // namespace

TEST_CASE("sun on a ground plane, both integrators") { check_means(outdoors(ground, sun), 0.005); }

TEST_CASE("sun and sky on a ground plane, both integrators") {
  check_means(outdoors(ground, sun + "," + sky), 0.005);
}

TEST_CASE("sun and sky between a ground plane and a wall plane, both integrators") {
  check_means(outdoors(ground + wall, sun + "," + sky), 0.01);
}

TEST_CASE("a sun is light where nothing is bounded") {
  Scene scene = outdoors(ground, sun);
  scene.objects.resize(1);
  CHECK(mean_luminance(render_with(scene, Integrator::sppm, 2).picture) ==
        Approx(mean_luminance(render_with(scene, Integrator::pt, 8).picture)).epsilon(0.005));
}
