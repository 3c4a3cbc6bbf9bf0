// The nearest of several infinite planes: for one ray against shape_closest() of each, and for many rays at
// once.
#include <array>
#include <cmath>
#include <cstring>

#include "shape_fixture.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "traversal/planes.cl"
// hits[3 i ..] of ray i: by shape_closest(), by planes_closest(), by planes_closest_all().
kernel void meet(global const Shape *planes, uint plane_count, global const float4 *rays, global float4 *hits, uint count,
                 global uint *occluded) {
  uint first = get_global_id(0) * STREAM_CAPACITY, last = min(first + STREAM_CAPACITY, count);
  float origin[3][STREAM_CAPACITY], direction[3][STREAM_CAPACITY];
  float t[STREAM_CAPACITY], u[STREAM_CAPACITY], v[STREAM_CAPACITY];
  uint primitive[STREAM_CAPACITY];
  for (uint i = first; i < last; ++i) {
    float4 o = rays[2 * i], d = rays[2 * i + 1];
    Ray ray = {o.xyz, d.xyz};
    Hit by_shape = hit_none(o.w), one = hit_none(o.w);
    for (uint plane = 0; plane < plane_count; ++plane) shape_closest(planes + plane, plane, 0, ray, &by_shape);
    planes_closest(planes, plane_count, ray, &one);
    hits[3 * i] = (float4)(by_shape.t, by_shape.u, by_shape.v, as_float(by_shape.primitive));
    hits[3 * i + 1] = (float4)(one.t, one.u, one.v, as_float(one.primitive));
    occluded[i] = planes_occluded(planes, plane_count, ray, o.w) ? 1 : 0;
    uint k = i - first;
    origin[0][k] = o.x, origin[1][k] = o.y, origin[2][k] = o.z;
    direction[0][k] = d.x, direction[1][k] = d.y, direction[2][k] = d.z;
    t[k] = o.w, u[k] = v[k] = 0, primitive[k] = HIT_NONE;
  }
  if (first >= count) return;
  RayArrays arrays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  planes_closest_all(planes, plane_count, last - first, &arrays);
  for (uint i = first; i < last; ++i)
    hits[3 * i + 2] = (float4)(t[i - first], u[i - first], v[i - first], as_float(primitive[i - first]));
}
)";

Transform random_affine(RandomInputs& random) {
  return Transform::scale({random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3)})
      .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
      .followed_by(Transform::rotate(2, random.uniform(0, 6.28)))
      .followed_by(Transform::shift(random_direction(random) * random.uniform(0, 10)));
}

}  // namespace

TEST_CASE("planes: many rays at once meet what each meets alone, to the bit") {
  auto& device = test_device();
  RandomInputs random(202);
  cl::Program program = build_test_program(source, EFFECT_PLANES | EFFECT_SPHERES);
  for (const std::size_t plane_count : {1, 2, 7}) {
    std::vector<Shape> planes;
    for (std::size_t i = 0; i < plane_count; ++i)
      planes.push_back(make_shape(SHAPE_PLANE, random_affine(random)));
    const std::size_t count = 100003;  // the last batch is not full
    std::vector<float4> rays;
    for (std::size_t i = 0; i < count; ++i) {
      float4 origin = to_float4(random_direction(random) * random.uniform(0, 20));
      origin.w = i % 3 == 0 ? static_cast<float>(random.uniform(0, 20)) : INFINITY;
      rays.push_back(origin);
      // Along axes as well: some planes are parallel to these.
      rays.push_back(i % 50 == 0 ? float4{0, 0, 1, 0} : to_float4(random_direction(random)));
    }
    const auto plane_buffer = device.upload(planes, "planes"), ray_buffer = device.upload(rays, "rays"),
               hits = device.buffer(3 * count * sizeof(float4), "hits"),
               occluded = device.buffer(count * sizeof(uint), "occluded");
    run_kernel(program, "meet", count, plane_buffer, static_cast<cl_uint>(plane_count), ray_buffer, hits,
               static_cast<cl_uint>(count), occluded);
    const auto found = device.download<std::array<float4, 3>>(hits, count);
    const auto shadows = device.download<uint>(occluded, count);
    std::size_t met = 0, other = 0, wrong_shadow = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [by_shape, one, all] = found[i];
      other += std::memcmp(&by_shape, &one, sizeof(float4)) != 0 ||
               std::memcmp(&by_shape, &all, sizeof(float4)) != 0;
      const bool meets = by_shape.x < rays[2 * i].w;
      met += meets;
      wrong_shadow += (shadows[i] != 0) != meets;
    }
    INFO(plane_count << " planes");
    CHECK(met > count / 5);
    CHECK(met < count);
    CHECK(other == 0);
    CHECK(wrong_shadow == 0);
  }
}
