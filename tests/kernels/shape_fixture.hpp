// Runs cl/shapes/shape.cl on rays chosen by a test.
#pragma once

#include "device_fixture.hpp"
#include "selftest/shape_inputs.hpp"

namespace causticl {

struct ShapeRay {
  float4 origin;     // w: t_max
  float4 direction;  // w: index of the shape
};

struct ShapeResult {
  float4 hit;       // t, u, v; w: 1 for a hit
  float4 position;  // w: error
  float4 geometric_normal, shading_normal;
  float4 uv;     // z: material, w: shape_occluded
  float4 again;  // t from the spawned origin along `spawned`, or infinity; yzw: the spawned origin
};

class ShapeScene {
 public:
  std::vector<Shape> shapes;
  std::vector<float> curves;

  /// Every ray against its shape; a hit spawns a second ray against the same shape along `spawned` (of the
  /// same length as rays, or empty).
  std::vector<ShapeResult> trace(const std::vector<ShapeRay>& rays, std::vector<float4> spawned = {}) {
    static cl::Program program = build_test_program(source);
    const std::size_t count = rays.size();
    spawned.resize(count, {0, 0, 1, 0});
    auto& device = test_device();
    auto results = device.buffer(count * sizeof(ShapeResult), "results");
    if (curves.empty()) curves.push_back(0);
    run_kernel(program, "trace", count, device.upload(shapes, "shapes"), device.upload(curves, "curves"),
               device.upload(rays, "rays"), device.upload(spawned, "spawned"), results, cl_uint(count));
    return device.download<ShapeResult>(results, count);
  }

 private:
  static constexpr const char* source = R"(
#include "shapes/shape.cl"
kernel void trace(global const Shape *shapes, global const float *curves, global const float4 *rays,
                  global const float4 *spawned, global float4 *results, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global float4 *result = results + 6 * i;
  uint index = (uint)rays[2 * i + 1].w;
  global const Shape *shape = shapes + index;
  Ray ray = {rays[2 * i].xyz, rays[2 * i + 1].xyz};
  Hit hit = hit_none(rays[2 * i].w);
  bool found = shape_closest(shape, index, curves, ray, &hit);
  bool named = found == (hit.primitive == (HIT_SHAPE | index));
  uint diagnostics = 0;
  bool occluded = shape_occluded(shape, curves, ray, rays[2 * i].w, &diagnostics);
  result[0] = (float4)(hit.t, hit.u, hit.v, found && named);
  result[4] = (float4)(0, 0, 0, occluded);
  result[5] = (float4)(INFINITY, 0, 0, 0);
  if (!found) return;
  Surface surface;
  shape_surface(shape, curves, ray, hit, &surface);
  result[1] = (float4)(surface.position, surface.error);
  result[2] = (float4)(surface.geometric_normal, 0);
  result[3] = (float4)(surface.shading_normal, 0);
  result[4] = (float4)(surface.uv, surface.material, occluded);
  Ray next;
  next.direction = spawned[i].xyz;
  next.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, next.direction);
  Hit again = hit_none(INFINITY);
  shape_closest(shape, index, curves, next, &again);
  result[5] = (float4)(again.t, next.origin);
}
)";
};

/// A direction uniform on the sphere, rounded to single precision.
inline Vec3 random_direction(RandomInputs& random) {
  const double z = random.uniform(-1, 1), angle = random.uniform(0, 6.283185307179586);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// 10^x for x uniform.
inline double random_scale(RandomInputs& random, double low, double high) {
  return std::pow(10.0, random.uniform(low, high));
}

inline ShapeRay make_ray(Vec3 origin, Vec3 direction, std::size_t shape = 0, double t_max = INFINITY) {
  return {to_float4(origin, t_max), to_float4(normalize(direction), static_cast<double>(shape))};
}

}  // namespace causticl
