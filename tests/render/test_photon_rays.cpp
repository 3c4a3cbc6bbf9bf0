// Whole pictures with photons through the tree and by brute force: the same to the bit, with the same counts.
#include <filesystem>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "format/load_scene.hpp"
#include "render_fixture.hpp"
#include "world/flat_scene.hpp"

using namespace causticl;

namespace {

const std::string by_brute_force = "sixteen at a time, each meets every primitive";

std::string through_tree() {
  return test_device().has_serial_work_items() ? "in streams through the tree" : "one at a time";
}

Scene few_photons(const std::string& file, int width, int height) {
  Scene scene = shipped_scene(file, width, height);
  scene.renderer.integrator = Integrator::sppm;
  scene.renderer.passes = 3;
  scene.renderer.photons = 20000;
  return scene;
}

RenderResult render_by(PhotonRays photon_rays, const Scene& scene, RenderOptions options = {}) {
  options.photon_rays = photon_rays;
  return render_scene(scene, test_device(), options);
}

void check_same(const Scene& scene) {
  const auto tree = render_by(PhotonRays::tree, scene),
             brute_force = render_by(PhotonRays::brute_force, scene);
  INFO(scene.file);
  CHECK(tree.statistics.photon_rays == through_tree());
  CHECK(brute_force.statistics.photon_rays ==
        (test_device().has_serial_work_items() ? by_brute_force : through_tree()));
  check_same_render(tree, brute_force);
  CHECK(tree.statistics.stored_photons == brute_force.statistics.stored_photons);
}

}  // namespace

TEST_CASE("the primitives of a scene are those of its tree") {
  for (const char* folder : {"", "effects/", "stress/"})
    for (const auto& file :
         std::filesystem::directory_iterator(CAUSTICL_SOURCE_DIR "/scenes/" + std::string(folder))) {
      if (file.path().extension() != ".json") continue;
      const Scene scene = load_scene(file.path());
      const FlatScene world = flatten_scene(scene);
      INFO(file.path());
      CHECK(bounded_primitives(scene) == world.tree.triangles.size() + world.tree.shapes.size());
    }
}

TEST_CASE("photons by brute force give the picture of those through the tree") {
  check_same(few_photons("7_sppm_room.json", 32, 24));           // planes and a disk beside spheres
  check_same(few_photons("effects/moving_balls.json", 32, 24));  // a tree anew in every pass
  Scene scene = few_photons("cornell_box.json", 32, 32);
  scene.renderer.guided_photons = true;
  check_same(scene);
  scene.renderer.photons = 77;  // fewer than a work-group traces
  check_same(scene);
}

TEST_CASE(
    "photons go through the tree in double, by the precomputed test, among many primitives and curves") {
  const Scene box = few_photons("cornell_box.json", 16, 12);
  RenderOptions options;
  options.triangle_test = TriangleTest::precomputed;
  CHECK(render_by(PhotonRays::brute_force, box, options).statistics.photon_rays == "one at a time");
  const Scene spheres = few_photons("7_sppm_room.json", 16, 12);  // without triangles there is no such test
  CHECK(render_by(PhotonRays::tree, spheres, options).statistics.photon_rays == through_tree());
  options.triangle_test = TriangleTest::watertight;
  if (test_device().info().fp64) {
    options.precision = Precision::float64;
    CHECK(render_by(PhotonRays::brute_force, box, options).statistics.photon_rays == "one at a time");
    options.precision = Precision::float32;
  }
  for (const char* file : {"2_glass_knot.json", "3_bezier_solids.json", "effects/next_room.json"}) {
    const auto statistics = render_by(PhotonRays::brute_force, few_photons(file, 16, 12)).statistics;
    INFO(file);
    CHECK(statistics.photon_rays == through_tree());
  }
  const bool on_cpu = test_device().info().type == "cpu" && test_device().has_serial_work_items();
  CHECK(render_by(PhotonRays::automatic, box).statistics.photon_rays ==
        (on_cpu ? by_brute_force : through_tree()));
}
