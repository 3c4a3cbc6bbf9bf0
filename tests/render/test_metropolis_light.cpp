// Whole passes with Metropolis photons: the same light as without, with less noise.
#include <cmath>

#include "base/error.hpp"
#include "catch2.hpp"
#include "device_fixture.hpp"
#include "render/render_fixture.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

/// A closed room beside a lit hall, joined by a gap: one photon in fifty finds it.
Scene next_room(bool guided) {
  Scene scene = scene_from_text(R"({
    "width": 18, "height": 12, "max_depth": 8,
    "renderer": {"type": "sppm", "view_point_sample": 2, "photon_sample": 4000, "radius": 0.4, "schedule": "global"},
    "camera": {"position": [3.6, 1.5, 3.6], "target": [1.2, 1, 1], "fov": 60},
    "materials": {"white": {"type": "diffuse", "color": [0.7, 0.7, 0.7]},
                  "lamp": {"type": "diffuse", "color": [0, 0, 0], "emission": [60, 50, 40]}},
    "objects": [
      {"type": "box", "size": [16, 3, 4], "material": "white", "transform": [{"type": "shift", "x": 8, "y": 1.5, "z": 2}]},
      {"type": "box", "size": [0.6, 3, 1.2], "material": "white",
       "transform": [{"type": "shift", "x": 4.3, "y": 1.5, "z": 0.6}]},
      {"type": "box", "size": [0.6, 3, 2.3], "material": "white",
       "transform": [{"type": "shift", "x": 4.3, "y": 1.5, "z": 2.85}]},
      {"type": "sphere", "radius": 0.3, "material": "lamp", "transform": [{"type": "shift", "x": 12, "y": 2, "z": 1}]}]
  })");
  scene.renderer.guided_photons = guided;
  return scene;
}

/// Means and variances over seeds of the picture in boxes of pixels.
struct Spread {
  std::vector<double> mean, variance;
};

constexpr int seeds = 8;

Spread spread_of(bool guided) {
  Spread spread;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Picture picture =
        box_filtered(render_with(next_room(guided), Integrator::sppm, 24, seed).picture, 2);
    spread.mean.resize(picture.rgb.size());
    spread.variance.resize(picture.rgb.size());
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
      spread.mean[i] += static_cast<double>(picture.rgb[i]);
      spread.variance[i] += std::pow(static_cast<double>(picture.rgb[i]), 2);
    }
  }
  for (std::size_t i = 0; i < spread.mean.size(); ++i) {
    spread.mean[i] /= seeds;
    spread.variance[i] = (spread.variance[i] / seeds - std::pow(spread.mean[i], 2)) * seeds / (seeds - 1);
  }
  return spread;
}

}  // namespace

TEST_CASE("Metropolis photons bring the same light as others, with less noise") {
  const Spread plain = spread_of(false), guided = spread_of(true);
  double plain_variance = 0, guided_variance = 0, chi2 = 0;
  for (std::size_t i = 0; i < plain.mean.size(); ++i) {
    plain_variance += plain.variance[i];
    guided_variance += guided.variance[i];
    const double t =
        (plain.mean[i] - guided.mean[i]) / std::sqrt((plain.variance[i] + guided.variance[i]) / seeds);
    INFO("box " << i << ": " << plain.mean[i] << " and " << guided.mean[i]);
    CHECK(std::fabs(t) < 5);
    chi2 += t * t;
  }
  INFO("variance " << guided_variance << " against " << plain_variance);
  CHECK(guided_variance < 0.8 * plain_variance);  // 0.6 to 0.7 of it, by seeds
  // Each t has 14 degrees of freedom, and thus a mean square of 14 / 12.
  CHECK(chi2 / static_cast<double>(plain.mean.size()) < 2.5);
}

namespace {

/// Mean luminance of the picture and, where options ask for them, of its layers, for each of the seeds.
std::vector<std::vector<double>> means_of(Scene scene, bool guided, RenderOptions options) {
  scene.renderer.integrator = Integrator::sppm;
  scene.renderer.passes = 16;
  scene.renderer.guided_photons = guided;
  const TemporaryFolder folder;
  if (options.layers) options.outputs = {folder.path("layers.exr")};  // no layers without
  std::vector<std::vector<double>> means;
  int copied = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    options.seed = static_cast<std::uint32_t>(seed);
    const RenderResult result = render_scene(scene, test_device(), options);
    means.push_back({mean_luminance(result.picture)});
    if (options.layers)
      for (const char* layer : {"direct", "caustic", "indirect"})
        means.back().push_back(mean_luminance(layer_of(result.picture, layer)));
    if (guided) REQUIRE(result.statistics.seeds);
    copied += guided && result.statistics.seeds->copies > 0;
  }
  if (guided) CHECK(copied >= 2);  // where things move, not in every last pass
  return means;
}

void check_same_light(const char* name, const Scene& scene, const RenderOptions& options = {}) {
  const auto plain = means_of(scene, false, options), guided = means_of(scene, true, options);
  double whole = 0;
  for (const auto& one : plain) whole += one[0] / seeds;
  for (std::size_t k = 0; k < plain[0].size(); ++k) {
    // Pairs of the same seed, whose passes have the same times.
    double difference = 0, squares = 0, mean = 0;
    for (std::size_t i = 0; i < seeds; ++i) {
      difference += (guided[i][k] - plain[i][k]) / seeds;
      mean += plain[i][k] / seeds;
    }
    for (std::size_t i = 0; i < seeds; ++i) squares += std::pow(guided[i][k] - plain[i][k] - difference, 2);
    const double deviation = std::sqrt(squares / (seeds - 1) / seeds);
    INFO(name << ", mean " << k << ": " << difference << " apart, +- " << deviation << ", of " << mean);
    CHECK(std::fabs(difference) <= 5 * deviation);
    CHECK(deviation <= 0.05 * whole);  // so that the comparison tells something
  }
}

}  // namespace

TEST_CASE(
    "Metropolis photons bring the same light: through a medium, dispersion and absorption, layer by layer") {
  Scene scene = next_room(true);
  scene.medium = {{0.01, 0.01, 0.01}, {0.02, 0.02, 0.02}, 0.3};
  MaterialSpec glass;
  glass.kind = MaterialSpec::Kind::glass;
  glass.absorption = {0.2, 0.5, 1};
  glass.dispersion = 0.01;
  scene.materials.push_back(glass);
  Object ball;
  ball.radius = 0.5;
  ball.material = static_cast<int>(scene.materials.size()) - 1;
  ball.transform = Transform::shift({1.2, 0.5, 1});
  scene.objects.push_back(ball);
  RenderOptions options;
  options.layers = true;
  check_same_light("all effects", scene, options);
}

TEST_CASE("Metropolis photons bring the same light: more of them than there was room for") {
  Scene scene = next_room(true);
  scene.max_depth = 40;
  for (auto& material : scene.materials)
    if (max_component(material.emission) == 0) material.color = {0.97, 0.97, 0.97};
  // A gap of a fifth, so that few find it all the same.
  scene.objects[1].size[2] = 1.6;
  scene.objects[1].transform.translation[2] = 0.8;
  // In the first half of the shutter's time a black box moves by around the lamp.
  MaterialSpec black;
  black.color = {0, 0, 0};
  scene.materials.push_back(black);
  Object box;
  box.shape = Object::Shape::box;
  box.size = {1, 20, 1};
  box.material = static_cast<int>(scene.materials.size()) - 1;
  box.transform = Transform::shift({12, 2, 1});
  box.motion = {0, -20, 0};
  scene.objects.push_back(box);
  // There is room for two a photon at first. A seed that begins in the dark finds it too little where it
  // guides.
  scene.renderer.integrator = Integrator::sppm;
  const auto room = 2 * static_cast<std::uint64_t>(scene.renderer.photons);
  int late = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    RenderOptions options;
    options.seed = static_cast<std::uint32_t>(seed);
    scene.renderer.passes = 1;
    if (render_scene(scene, test_device(), options).statistics.stored_photons > room) continue;
    for (scene.renderer.passes = 2; scene.renderer.passes <= 8; ++scene.renderer.passes)
      if (render_scene(scene, test_device(), options).statistics.stored_photons > room) break;
    late += scene.renderer.passes <= 8;
  }
  REQUIRE(late >= 2);
  check_same_light("white walls", scene);
}

TEST_CASE("Metropolis photons bring the same light: in double precision") {
  if (!test_device().info().fp64) return;
  RenderOptions options;
  options.precision = Precision::float64;
  check_same_light("double", next_room(true), options);
}

TEST_CASE("Metropolis photons give the same bits in any order of execution, and are for one device alone") {
  const DeviceInfo info = test_device().info();
  const auto pixels = [&](Device& device) {
    Scene scene = next_room(true);
    scene.renderer.passes = 6;
    const RenderResult result = render_scene(scene, device, {});
    REQUIRE(result.statistics.seeds);
    CHECK(result.statistics.seeds->fraction > 0.001);
    CHECK(result.statistics.seeds->fraction < 0.06);
    CHECK(result.statistics.seeds->copies > 3);
    return result.picture.rgb;
  };
  Device one(info), other(info), single(info, 1);
  other.set_local_size(32);
  const auto expected = pixels(one);
  CHECK(pixels(other) == expected);
  CHECK(pixels(single) == expected);
  CHECK_THROWS_AS(render_scene(next_room(true), {&one, &other}, {}), UserError);
}
