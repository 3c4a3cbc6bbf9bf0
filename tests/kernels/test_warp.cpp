#include "chi_square_check.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "sampling/warp.cl"
#define COSINE 0
#define SPHERE 1
#define CONE 2
#define DISC 3
#define TRIANGLE 4
kernel void warp(global const float4 *uniform, global float4 *out, uint count, uint which, float4 axis) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real2 u = uniform[i].xy;
  real3 v = (real3)(0, 0, 0);
  if (which == COSINE) v = hemisphere_cosine(u, axis.xyz);
  if (which == SPHERE) v = sphere_uniform(u);
  if (which == CONE) v = cone_uniform(u, axis.xyz, axis.w);
  if (which == DISC) v.xy = disc_uniform(u);
  if (which == TRIANGLE) v.xy = triangle_uniform(u);
  out[i] = (float4)(v, 0);
}
kernel void turns(global const float *u, global float2 *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = cos_sin_turn(u[i]);
}
kernel void basis(global const float4 *normals, global float4 *tangents, global float4 *bitangents, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real3 t, b;
  orthonormal_basis(normals[i].xyz, &t, &b);
  tangents[i] = (float4)(t, 0);
  bitangents[i] = (float4)(b, 0);
}
)";

enum Warp : cl_uint { cosine, sphere, cone, disc, triangle };
constexpr std::size_t sample_count = 1 << 20;
constexpr int histograms = 16;  // in this file, for Sidak's correction

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

std::vector<Vec3> warp(const std::vector<float4>& uniform, Warp which, float4 axis = {}) {
  auto in = test_device().upload(uniform, "uniform");
  auto out = test_device().buffer(uniform.size() * sizeof(float4), "out");
  run_kernel(program(), "warp", uniform.size(), in, out, cl_uint(uniform.size()), cl_uint(which), axis);
  std::vector<Vec3> result;
  for (const auto& v : test_device().download<float4>(out, uniform.size())) result.push_back(to_vec3(v));
  return result;
}

/// The corners of the unit square that the kernels' random numbers can reach.
std::vector<float4> corner_numbers() {
  const float last = 1 - std::ldexp(1.0f, -24), step = std::ldexp(1.0f, -24);
  std::vector<float4> result;
  for (float x : {0.0f, step, 0.25f, 0.5f, 0.75f, last})
    for (float y : {0.0f, step, 0.25f, 0.5f, 0.75f, last}) result.push_back({x, y, 0, 0});
  return result;
}

std::vector<Vec3> axes(RandomInputs& random) {
  return {{0, 0, 1}, {0, 0, -1}, normalize({1e-4, -2e-4, -1}), random_direction(random)};
}

Histogram flat(const SquareBins& bins) {
  Histogram histogram(bins.count());
  histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
  return histogram;
}

}  // namespace

TEST_CASE("the chi-square p-value agrees with tables and finds a wrong density") {
  CHECK(chi_square_p_value(3.841458820694124, 1) == Approx(0.05).epsilon(1e-9));
  CHECK(chi_square_p_value(18.307038053275146, 10) == Approx(0.05).epsilon(1e-9));
  CHECK(chi_square_p_value(0.5, 4) == Approx(1.25 * std::exp(-0.25)).epsilon(1e-12));
  CHECK(chi_square_p_value(1106.969, 1000) == Approx(0.01).epsilon(1e-3));
  RandomInputs random(1);
  for (const double bias : {0.0, 0.01}) {
    Histogram histogram = flat({64, 1});
    for (std::size_t i = 0; i < sample_count; ++i)
      histogram.add(static_cast<std::size_t>(64 * std::pow(random.uniform(), 1 + bias)));
    if (bias == 0)
      CHECK(chi_square_p_value(histogram) > 0.01);
    else
      CHECK(chi_square_p_value(histogram) < 1e-6);
  }
}

TEST_CASE("cosine and sine of a turn are within two roundings") {
  RandomInputs random(34);
  std::vector<float> u{0, 0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.75f, 0.875f, 1, -1, -0.25f};
  while (u.size() < sample_count) u.push_back(static_cast<float>(random.uniform(-1, 1)));
  const cl::Buffer in = test_device().upload(u, "u"),
                   out = test_device().buffer(u.size() * sizeof(cl_float2), "cosines and sines");
  run_kernel(program(), "turns", u.size(), in, out, cl_uint(u.size()));
  const auto found = test_device().download<cl_float2>(out, u.size());
  double worst = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double angle = 2 * std::numbers::pi * u[i];
    worst = std::max(
        {worst, std::fabs(found[i].s[0] - std::cos(angle)), std::fabs(found[i].s[1] - std::sin(angle))});
  }
  CHECK(worst < 1.2e-7);
}

TEST_CASE("hemisphere_cosine has density cos / pi about any normal and stays above the horizon") {
  RandomInputs random(11);
  const auto uniform = uniform_tuples(random, sample_count);
  for (const Vec3 exact : axes(random)) {
    const float4 axis = to_float4(exact);
    const Frame frame(normalize(to_vec3(axis)));
    const SquareBins bins{16, 16};     // few, so that a density wrong by 1% shows
    Histogram histogram = flat(bins);  // cos^2 and the turn are both uniform
    std::size_t wrong = 0;
    for (const Vec3 v : warp(uniform, cosine, axis)) {
      const Vec3 local = frame.to_local(v);
      wrong += !(local.z > 0) || std::fabs(length(v) - 1) > 3e-7;
      histogram.add(bins.bin(local.z * local.z, turn(local.y, local.x)));
    }
    CHECK(wrong == 0);
    check_chi_square(histogram, histograms, "hemisphere_cosine");
    for (const Vec3 v : warp(corner_numbers(), cosine, axis)) {
      CHECK(dot(v, to_vec3(axis)) > 0);
      CHECK(std::fabs(length(v) - 1) < 3e-7);
    }
  }
}

TEST_CASE("sphere_uniform is uniform over the sphere") {
  RandomInputs random(12);
  const SquareBins bins{16, 16};  // few, so that a density wrong by 1% shows
  Histogram histogram = flat(bins);
  std::size_t wrong = 0;
  for (const Vec3 v : warp(uniform_tuples(random, sample_count), sphere)) {
    wrong += std::fabs(length(v) - 1) > 5e-7;
    histogram.add(bins.bin((v.z + 1) / 2, turn(v.y, v.x)));
  }
  CHECK(wrong == 0);
  check_chi_square(histogram, histograms, "sphere_uniform");
  for (const Vec3 v : warp(corner_numbers(), sphere)) CHECK(std::fabs(length(v) - 1) < 5e-7);
}

TEST_CASE("cone_uniform is uniform within its cone, narrow or wide") {
  RandomInputs random(13);
  const auto uniform = uniform_tuples(random, sample_count);
  // 1 - cos of the opening: half a degree of a sun seen from afar up to more than a hemisphere.
  for (const double opening : {1e-6, 1e-3, 0.3, 1.0, 1.9}) {
    const float4 axis = to_float4(random_direction(random), opening);
    const Vec3 exact_axis = normalize(to_vec3(axis));
    const Frame frame(exact_axis);
    const SquareBins bins{16, 32};
    Histogram histogram = flat(bins);
    std::size_t wrong = 0;
    for (const Vec3 v : warp(uniform, cone, axis)) {
      wrong += std::fabs(length(v) - 1) > 4e-7;  // OpenCL grants normalize() 5 ulp
      // 1 - cos = |v - axis|^2 / 2 without cancellation.
      const Vec3 chord = normalize(v) - exact_axis, local = frame.to_local(v);
      const double drop = dot(chord, chord) / 2;
      // Rounding of v by 2^-24 is a fraction of 4e-5 of the narrowest cone's opening angle.
      histogram.add(bins.bin(drop / static_cast<double>(axis.w), turn(local.y, local.x), 4e-4));
    }
    CHECK(wrong == 0);
    check_chi_square(histogram, histograms, "cone_uniform, 1 - cos = " + std::to_string(opening));
  }
}

TEST_CASE("disc_uniform is uniform over the unit disc, and neighbours stay neighbours") {
  RandomInputs random(14);
  const SquareBins bins{16, 16};  // few, so that a density wrong by 1% shows
  Histogram histogram = flat(bins);
  for (const Vec3 v : warp(uniform_tuples(random, sample_count), disc))
    histogram.add(bins.bin(v.x * v.x + v.y * v.y, turn(v.y, v.x)));
  check_chi_square(histogram, histograms, "disc_uniform");
  for (const Vec3 v : warp(corner_numbers(), disc)) CHECK(v.x * v.x + v.y * v.y <= 1 + 2e-7);
  // The map stretches no distance by more than pi (its Jacobian is pi, its radial part stretches by 2).
  auto near = uniform_tuples(random, sample_count);
  const auto before = warp(near, disc);
  for (auto& u : near) u.x = std::min(u.x + 1e-3f, 0.99999f);
  const auto after = warp(near, disc);
  double longest = 0;
  for (std::size_t i = 0; i < near.size(); ++i) longest = std::max(longest, length(after[i] - before[i]));
  CHECK(longest < 3.2e-3);
}

TEST_CASE("triangle_uniform is uniform over the triangle") {
  RandomInputs random(15);
  constexpr std::size_t n = 24;
  const SquareBins bins{n, n};
  Histogram histogram(bins.count());
  // Squares under the diagonal are whole, those on it are halved.
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x + y < n; ++x)
      histogram.probabilities[y * n + x] = (x + y == n - 1 ? 1.0 : 2.0) / (n * n);
  for (const Vec3 v : warp(uniform_tuples(random, sample_count), triangle))
    if (v.x + v.y > 1 + 1e-6)
      histogram.add_outside();
    else
      histogram.add(bins.bin(v.x, v.y));
  check_chi_square(histogram, histograms, "triangle_uniform");
  for (const Vec3 v : warp(corner_numbers(), triangle))
    CHECK((v.x >= 0 && v.y >= 0 && v.x + v.y <= 1 + 2e-7));
}

TEST_CASE("orthonormal_basis is orthonormal and right-handed for every normal") {
  RandomInputs random(16);
  std::vector<float4> normals;
  for (const double sign : {1.0, -1.0}) {
    normals.push_back(to_float4({0, 0, sign}));
    for (const double z : {0.0, -0.0})
      for (const double angle : {0.0, 0.7, 1.5, 3.0})
        normals.push_back(to_float4({std::cos(angle), sign * std::sin(angle), z}));
  }
  // Towards the pole at which older constructions divide by nothing.
  for (double tilt = 1e-9; tilt < 1; tilt *= 1.5)
    for (const double pole : {-1.0, 1.0})
      for (int i = 0; i < 1000; ++i)
        normals.push_back(to_float4(tilted_direction(random, {0, 0, pole}, tilt)));
  while (normals.size() < sample_count + 100000) normals.push_back(to_float4(random_direction(random)));

  auto in = test_device().upload(normals, "normals");
  auto t = test_device().buffer(normals.size() * sizeof(float4), "tangents");
  auto b = test_device().buffer(normals.size() * sizeof(float4), "bitangents");
  run_kernel(program(), "basis", normals.size(), in, t, b, cl_uint(normals.size()));
  const auto tangents = test_device().download<float4>(t, normals.size());
  const auto bitangents = test_device().download<float4>(b, normals.size());
  double dots = 0, lengths = 0, handed = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 n = to_vec3(normals[i]), x = to_vec3(tangents[i]), y = to_vec3(bitangents[i]);
    dots = std::max({dots, std::fabs(dot(n, x)), std::fabs(dot(n, y)), std::fabs(dot(x, y))});
    lengths = std::max({lengths, std::fabs(length(x) - 1), std::fabs(length(y) - 1)});
    handed = std::max(handed, length(cross(x, y) - n));
  }
  CHECK(dots <= 5e-7);
  CHECK(lengths <= 5e-7);
  CHECK(handed <= 1e-6);
}
