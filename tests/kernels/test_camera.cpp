#include "chi_square_check.hpp"
#include "shared/effects.h"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "paths/camera.cl"
kernel void rays(global const float4 *uniform, global float4 *origins, global float4 *directions, uint count,
                 Camera camera, uint width, uint height) {
  uint i = get_global_id(0);
  if (i >= count) return;
  float4 u = uniform[i];
  Ray ray = camera_ray(&camera, width, height, u.x * width, u.y * height, u.z, u.w);
  origins[i] = (float4)(ray.origin, 0);
  directions[i] = (float4)(ray.direction, 0);
}
kernel void strata(global const float4 *uniform, global float4 *out, uint count, uint samples) {
  uint i = get_global_id(0);
  if (i < count) out[i] = (float4)(camera_stratum(i % samples, samples, uniform[i].xy), 0, 0);
}
)";

constexpr std::size_t ray_count = 1 << 20;
constexpr uint width = 96, height = 64;

/// A camera of either form of the scene format, in double precision and as the device reads it.
struct TestCamera {
  Vec3 origin, axis, right, up;
  double plane_distance = 0, focal_distance = 1, aperture = 0;
  bool flat_focus = false;

  Camera device() const {
    Camera camera{};
    camera.origin = to_float4(origin, plane_distance);
    camera.axis = to_float4(axis, focal_distance);
    camera.right = to_float4(right, aperture);
    camera.up = to_float4(up, flat_focus ? 1 : 0);
    camera.lens_right = to_float4(normalize(right));
    camera.lens_up = to_float4(normalize(up));
    return camera;
  }
};

/// origin, direct, view_angle_scale: cx = (W/H s, 0, 0), cy = normalize(cx x direct) s.
TestCamera base_camera(Vec3 origin, Vec3 direct, double s, double plane, double focal, double aperture) {
  const Vec3 axis = normalize(direct), right{double(width) / height * s, 0, 0};
  return {origin, axis, right, normalize(cross(right, axis)) * s, plane, focal, aperture, false};
}

/// position, target, up, fov.
TestCamera look_at(Vec3 position, Vec3 target, Vec3 up, double fov_degrees, double focus, double aperture) {
  const Vec3 axis = normalize(target - position), right = normalize(cross(axis, up));
  const double size = 2 * std::tan(fov_degrees / 2 * M_PI / 180);
  return {position, axis, right * (size * width / height), cross(right, axis) * size, 0, focus,
          aperture, true};
}

struct Rays {
  std::vector<float4> origins, directions;
};

Rays trace(cl::Program& program, const std::vector<float4>& uniform, const TestCamera& camera) {
  auto in = test_device().upload(uniform, "uniform");
  auto origins = test_device().buffer(uniform.size() * sizeof(float4), "origins");
  auto directions = test_device().buffer(uniform.size() * sizeof(float4), "directions");
  run_kernel(program, "rays", uniform.size(), in, origins, directions, cl_uint(uniform.size()),
             camera.device(), width, height);
  return {test_device().download<float4>(origins, uniform.size()),
          test_device().download<float4>(directions, uniform.size())};
}

/// D of scene-format.md at the film position of these numbers; v runs from the bottom.
Vec3 film_direction(const TestCamera& camera, float4 uniform) {
  return camera.axis + camera.right * (uniform.x - 0.5) + camera.up * (0.5 - uniform.y);
}

std::vector<TestCamera> cameras(double aperture) {
  return {base_camera({50, 52, 295.6}, {0, -0.042612, -1}, 0.5135, 140, 160, aperture),
          base_camera({0, 0, 0}, {0.3, 0.1, 2}, 1.2, 0, 5, aperture),
          look_at({3, 4, 5}, {0, 1, -2}, {0, 1, 0}, 60, 8, aperture),
          look_at({-1e3, 20, 7}, {-1e3, 21, 7.5}, {0, 0, 1}, 5, 2, aperture)};
}

}  // namespace

TEST_CASE("pinhole rays of both camera forms follow the formulas of the scene format") {
  RandomInputs random(31);
  auto uniform = uniform_tuples(random, ray_count);
  for (const float x : {0.0f, 0.5f, 1.0f})
    for (const float y : {0.0f, 0.5f, 1.0f}) uniform.push_back({x, y, 0.5f, 0.5f});
  // Without the lens compiled in, and with one of radius zero.
  for (const unsigned effects : {EFFECT_ALL & ~EFFECT_LENS, EFFECT_ALL}) {
    auto program = build_test_program(source, effects);
    for (const TestCamera& camera : cameras(0)) {
      const Rays rays = trace(program, uniform, camera);
      double direction_error = 0, origin_error = 0;
      for (std::size_t i = 0; i < uniform.size(); ++i) {
        const Vec3 d = film_direction(camera, uniform[i]), origin = camera.origin + d * camera.plane_distance;
        direction_error = std::max(direction_error, length(to_vec3(rays.directions[i]) - normalize(d)));
        const double size = length(camera.origin) + length(d) * camera.plane_distance + 1;
        origin_error = std::max(origin_error, length(to_vec3(rays.origins[i]) - origin) / size);
      }
      CHECK(direction_error < 4e-7);
      CHECK(origin_error < 3e-7);
    }
  }
}

TEST_CASE("every lens ray of a pixel meets the focus, and starts uniformly on the lens") {
  RandomInputs random(32);
  const auto uniform = uniform_tuples(random, ray_count);
  auto program = build_test_program(source);
  for (const TestCamera& camera : cameras(0.75)) {
    const Rays rays = trace(program, uniform, camera);
    const SquareBins bins{16, 32};
    Histogram histogram(bins.count());
    histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
    double miss = 0, off_plane = 0, backward = 0;
    for (std::size_t i = 0; i < uniform.size(); ++i) {
      const Vec3 d = film_direction(camera, uniform[i]), start = camera.origin + d * camera.plane_distance;
      const Vec3 origin = to_vec3(rays.origins[i]), direction = to_vec3(rays.directions[i]);
      // The sphere |focus| = focal_distance of the base form, the plane <focus, axis> = focal_distance of the
      // other.
      const Vec3 focus = start + (camera.flat_focus ? d : normalize(d)) * camera.focal_distance;
      const double size = length(start) + camera.focal_distance;
      miss = std::max(miss, length(cross(focus - origin, normalize(direction))) / size);
      backward += dot(focus - origin, direction) < 0;
      const Vec3 r = origin - start;
      const double x = dot(r, normalize(camera.right)), y = dot(r, normalize(camera.up));
      off_plane =
          std::max(off_plane, length(r - x * normalize(camera.right) - y * normalize(camera.up)) / size);
      // Origins far from 0 are rounded to a visible part of the lens: 6e-5 at 1e3.
      histogram.add(bins.bin((x * x + y * y) / (0.75 * 0.75), turn(y, x), 5e-4));
    }
    CHECK(miss < 1e-6);
    CHECK(off_plane < 3e-7);
    CHECK(backward == 0);
    check_chi_square(histogram, 8, "lens");
  }
}

TEST_CASE("a square number of samples is stratified, any other is not") {
  RandomInputs random(33);
  auto program = build_test_program(source);
  const auto uniform = uniform_tuples(random, ray_count);
  auto in = test_device().upload(uniform, "uniform");
  auto out = test_device().buffer(uniform.size() * sizeof(float4), "out");
  for (const uint samples : {1u, 2u, 4u, 9u, 5u, 64u}) {
    CAPTURE(samples);
    run_kernel(program, "strata", ray_count, in, out, cl_uint(ray_count), samples);
    const auto points = test_device().download<float4>(out, ray_count);
    auto side = static_cast<uint>(std::lround(std::sqrt(samples)));
    if (side * side != samples) side = 1;
    std::size_t outside = 0;
    std::vector<std::size_t> taken(side * side);
    Histogram histogram(64);
    histogram.probabilities.assign(64, 1.0 / 64);
    for (std::size_t i = 0; i < ray_count; ++i) {
      const uint stratum = static_cast<uint>(i % samples) % (side * side);
      const double x = points[i].x * static_cast<double>(side) - stratum % side;
      const double y = points[i].y * static_cast<double>(side) - stratum / side;
      // 1 itself may come of rounding up the last of the 2^24 numbers.
      outside += !(x >= -1e-6 && x <= 1 + 1e-6 && y >= -1e-6 && y <= 1 + 1e-6);
      histogram.add(SquareBins{8, 8}.bin(x, y));
      ++taken[stratum];
    }
    CHECK(outside == 0);
    for (const std::size_t n : taken)
      CHECK(std::fabs(double(n) - double(ray_count) / (side * side)) < samples + 1);
    check_chi_square(histogram, 8, "within a stratum");
  }
}
