// A ray that leaves a surface where another one has met it, for checks that it neither meets the surface
// again nor passes through it.
#pragma once

#include "selftest/shape_inputs.hpp"

namespace causticl {

/// What the device says of one.
struct SpawnedRay {
  float t;          // of the primary hit; infinity if there was none
  float again;      // t of the next hit of the spawned ray; infinity if there is none
  float error;      // Surface.error
  float same_face;  // triangles: 1 if both hits are on the same one
  float4 position, normal, direction, origin;  // of the primary hit; of the spawned ray

  bool spawned() const { return std::isfinite(t); }
  /// The cosine between the spawned ray and the normal.
  double side() const { return dot(to_vec3(normal), to_vec3(direction)); }
  double displacement() const { return length(to_vec3(origin) - to_vec3(position)); }
};

/// The cosine of a unit direction and a unit normal has this many roundings' error in single precision (three
/// products, two sums, and the lengths): below it the side that the ray goes to is not known.
constexpr double side_error = 5 * 0x1p-24;

/// Goes before kernels. The direction is `way`, or, where `sine` is not 0, the tangent beside it lifted by
/// that sine off the surface (to its inside where negative).
constexpr const char* spawned_ray_source = R"(
#include "shapes/shape.cl"
typedef struct {
  float t, again, error, same_face;
  float4 position, normal, direction, origin;
} SpawnedRay;

INLINE real3 load3(global const float *p) { return (real3)(p[0], p[1], p[2]); }

// Without a hit.
INLINE SpawnedRay spawned_none(void) {
  SpawnedRay spawned = {INFINITY, INFINITY, 0, 0, (float4)(0), (float4)(0), (float4)(0), (float4)(0)};
  return spawned;
}

// The ray that leaves `surface`, with what is known of it so far in *spawned.
INLINE Ray spawn(Surface surface, real t, real3 way, real sine, SpawnedRay *spawned) {
  real3 n = surface.geometric_normal;
  Ray ray;
  ray.direction = way;
  if (sine != 0) ray.direction = normalize(normalize(cross(n, way)) + n * sine);
  ray.origin = offset_origin(surface.position, surface.error, n, ray.direction);
  spawned->t = t;
  spawned->error = surface.error;
  spawned->position = (float4)(surface.position.x, surface.position.y, surface.position.z, 0);
  spawned->normal = (float4)(n.x, n.y, n.z, 0);
  spawned->direction = (float4)(ray.direction.x, ray.direction.y, ray.direction.z, 0);
  spawned->origin = (float4)(ray.origin.x, ray.origin.y, ray.origin.z, 0);
  return ray;
}

INLINE SpawnedRay spawn_from_shape(global const Shape *shape, global const float *curves, Ray ray, real3 way,
                                   real sine) {
  SpawnedRay spawned = spawned_none();
  Hit hit = {INFINITY, HIT_NONE, 0, 0, 0}, again = hit;
  if (!shape_closest(shape, 0, curves, ray, &hit)) return spawned;
  Surface surface;
  shape_surface(shape, curves, ray, hit, &surface);
  Ray next = spawn(surface, hit.t, way, sine, &spawned);
  if (shape_closest(shape, 0, curves, next, &again)) spawned.again = again.t;
  return spawned;
}
)";

/// The error of a ray spawned on a sphere: 0, or 1 where it meets the sphere again from outside, passes
/// through it from inside or meets it there where it starts, or starts farther away than rounding asks for.
inline double sphere_spawn_error(const SpawnedRay& ray, double radius) {
  const double side = ray.side(), size = max_component({std::fabs(ray.position.x), std::fabs(ray.position.y),
                                                        std::fabs(ray.position.z)}) +
                                         radius;
  if (!(ray.displacement() <= 3e-6 * size)) return 1;
  if (std::fabs(side) < side_error) return 0;
  if (side > 0) return std::isfinite(ray.again) ? 1 : 0;
  // From inside the chord is at least 2 R |cos|, whose cosine rounding may halve.
  return std::isfinite(ray.again) && ray.again >= radius * -side ? 0 : 1;
}

}  // namespace causticl
