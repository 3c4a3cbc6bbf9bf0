// Metropolis photons on the device: mutated random numbers, and cells of the visibility grid.
#include <array>
#include <cmath>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "device_scene/space_grid.hpp"
#include "shared/effects.h"

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
