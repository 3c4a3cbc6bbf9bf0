// Metropolis photons: mutated random numbers and cells of the visibility grid on the device, and what whole
// passes bring.
#include <array>
#include <cmath>
#include "catch2.hpp"

#include "base/error.hpp"
#include "device_fixture.hpp"
#include "device_scene/space_grid.hpp"
#include "render/render_fixture.hpp"
#include "shared/effects.h"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "sampling/rng.cl"
#include "photons/visibility_grid.cl"
kernel void draw(global uint4 *path, global uint4 *copies, uint count, uint seed, uint dimension, uint fresh) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, 3, i / 8, 0, 0}, copy = {seed, 3, i / 8, 1 + i % 8, fresh};
  path[i] = convert_uint4(random4(stream, dimension) * 16777216.0f);
  copies[i] = convert_uint4(random4(copy, dimension) * 16777216.0f);
}
kernel void mark(global const float4 *points, global const float4 *normals, volatile global uint *visibility, Grid cells,
                 float reach, uint count) {
  uint i = get_global_id(0);
  if (i < count) mark_visible_cells(visibility, cells, normals[i].xyz, points[i].xyz, reach);
}
kernel void look_up(global const float4 *points, global const float4 *normals, global const uint *visibility, Grid cells,
                    global uint *visible, uint count) {
  uint i = get_global_id(0);
  if (i < count) visible[i] = is_visible(visibility, cells, normal_unpack(normal_pack(normals[i].xyz)), points[i].xyz);
}
)";

using Words = std::array<cl_uint, 4>;
using Vector = std::array<float, 4>;

struct Draws {
  std::vector<Words> path, copies;
};

Draws draw(cl::Program& program, std::size_t count, uint dimension, uint fresh) {
  auto path = test_device().buffer(count * sizeof(Words), "path"),
       copies = test_device().buffer(count * sizeof(Words), "copies");
  run_kernel(program, "draw", count, path, copies, static_cast<cl_uint>(count), cl_uint{17},
             cl_uint{dimension}, cl_uint{fresh});
  return {test_device().download<Words>(path, count), test_device().download<Words>(copies, count)};
}

/// How much larger the copy's number is, modulo 1, in [-1/2, 1/2).
double step(uint from, uint to) {
  const double d = (static_cast<double>(to) - from) / 16777216;
  return d - std::floor(d + 0.5);
}

Vector random_direction(RandomInputs& random) {
  for (;;) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    const double length = std::sqrt(x * x + y * y + z * z);
    if (length < 0.1 || length > 1) continue;
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length),
            0};
  }
}

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

TEST_CASE("a copy's numbers are near those of its path, either way alike, and from `fresh` on its own") {
  auto program = build_test_program(source, EFFECT_GUIDED_PHOTONS);
  const std::size_t count = 1 << 18;
  for (const bool own : {false, true}) {
    const Draws draws = draw(program, count, 20, own ? 20 : 21);
    double sum = 0, squares = 0, largest = 0, numbers = 0;
    std::array<double, 16> bins{};
    for (std::size_t i = 0; i < count; ++i)
      for (int c = 0; c < 4; ++c) {
        const double d = step(draws.path[i][c], draws.copies[i][c]);
        sum += d;
        squares += d * d;
        largest = std::max(largest, std::fabs(d));
        numbers += draws.copies[i][c] / 16777216.0;
        ++bins[draws.copies[i][c] >> 20];
      }
    const double n = 4.0 * count, variance = squares / n;
    INFO("numbers of its own: " << own);
    CHECK(std::fabs(sum / n) < 5 * std::sqrt(variance / n));
    // x^3 has the variance 1/7 for x between -1 and 1; what is uniform over a period has 1/12 of that.
    CHECK(variance == Approx(own ? 1.0 / 12 : 1.0 / (128.0 * 128 * 7)).epsilon(0.02));
    CHECK(largest < (own ? 0.5001 : 1.001 / 128));
    CHECK(largest > (own ? 0.499 : 0.99 / 128));
    for (const double bin : bins) CHECK(bin == Approx(n / 16).epsilon(own ? 0.02 : 0.06));
  }
}

TEST_CASE("a path that is no copy has the numbers of programs without Metropolis photons") {
  auto with = build_test_program(source, EFFECT_GUIDED_PHOTONS), without = build_test_program(source);
  const auto a = draw(with, 4096, 9, 0).path, b = draw(without, 4096, 9, 0).path;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 4; ++c) REQUIRE(a[i][c] == b[i][c]);
}

TEST_CASE(
    "photons that a visible point may gather nearby lie in cells of the visibility grid; those behind a wall "
    "do not") {
  auto program = build_test_program(source, EFFECT_GUIDED_PHOTONS);
  RandomInputs random(20261126);
  const std::size_t count = 20000;
  DeviceScene scene;
  scene.extent = 4;
  const Grid cells = grid_of(scene, 0.25, 1 << 22);
  const auto visibility = test_device().buffer(buckets_of(cells), "marks");
  test_device().clear(visibility, buckets_of(cells));
  const double reach = 0.12;
  std::vector<Vector> points, normals, near, near_normals, behind, behind_normals;
  for (std::size_t i = 0; i < count; ++i) {
    // Visible points lie in the half with x < 0, below a ceiling at y = 1 that is seen from below alone.
    const Vector p{static_cast<float>(random.uniform(-3, -0.5)), static_cast<float>(random.uniform(-3, 1)),
                   static_cast<float>(random.uniform(-3, 3)), 0};
    const bool ceiling = i % 2 == 0;
    const Vector n = ceiling ? Vector{0, -1, 0, 0} : random_direction(random);
    if (ceiling || n[1] < -0.9f) {
      points.push_back(p);
      normals.push_back(n);
      Vector q = p, m;
      for (int axis = 0; axis < 3; ++axis) q[axis] += static_cast<float>(random.uniform(-reach, reach));
      do {
        m = random_direction(random);
      } while (m[0] * n[0] + m[1] * n[1] + m[2] * n[2] <= 0.51f);
      near.push_back(q);
      near_normals.push_back(m);
      behind.push_back(p);
      behind_normals.push_back({0, 1, 0, 0});
    }
  }
  const auto n = static_cast<cl_uint>(points.size());
  run_kernel(program, "mark", n, test_device().upload(points, "points"),
             test_device().upload(normals, "normals"), visibility, cells, static_cast<float>(reach), n);
  const auto visible = [&](const std::vector<Vector>& at, const std::vector<Vector>& facing) {
    const auto result = test_device().buffer(at.size() * sizeof(cl_uint), "marked");
    run_kernel(program, "look_up", at.size(), test_device().upload(at, "points"),
               test_device().upload(facing, "normals"), visibility, cells, result,
               static_cast<cl_uint>(at.size()));
    const auto values = test_device().download<cl_uint>(result, at.size());
    return static_cast<std::size_t>(std::count(values.begin(), values.end(), 1u));
  };
  CHECK(visible(near, near_normals) == near.size());
  CHECK(visible(behind, behind_normals) == 0);
  std::vector<Vector> beside = points;
  for (auto& p : beside) p[0] += 3.4f;
  CHECK(visible(beside, normals) == 0);
}

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
    CHECK(result.statistics.seeds->share > 0.001);
    CHECK(result.statistics.seeds->share < 0.06);
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
