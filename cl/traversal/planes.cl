// The infinite planes, which are in no tree: a ray meets one after the other. Where there are many rays, each plane meets all
// of them, by loops over them that become vector code.
#include "shapes/ray_components.cl"
#include "shapes/shape.cl"
#include "core/vector.cl"

// Takes the nearest hit with a plane at 0 < t < hit->t into `hit`. False, and `hit` as it was, if there is none. The first
// `count` shapes are the planes.
INLINE bool planes_closest(global const Shape *planes, uint count, Ray ray, Hit *hit) {
  if (!HAS(EFFECT_PLANES)) return false;
  bool found = false;
  real2 parameters;
  for (uint i = 0; i < count; ++i) {
    real t = plane_intersect(planes + i, 0, ray, hit->t, &parameters);
    if (!(t < hit->t)) continue;
    hit->t = t, hit->u = 0, hit->v = 0, hit->primitive = HIT_SHAPE | i;
    found = true;
  }
  return found;
}

// Whether a plane is met for 0 < t < t_max.
INLINE bool planes_occluded(global const Shape *planes, uint count, Ray ray, real t_max) {
  if (!HAS(EFFECT_PLANES)) return false;
  real2 parameters;
  for (uint i = 0; i < count; ++i)
    if (plane_intersect(planes + i, 0, ray, t_max, &parameters) < t_max) return true;
  return false;
}

// planes_closest() of `ray_count` rays.
OUTLINE void planes_closest_all(global const Shape *planes, uint count, uint ray_count, const RayArrays *arrays) {
  const RayArrays rays = *arrays;
  for (uint plane = 0; plane < count; ++plane) {
    const real3 row = plane_row(planes + plane), centre = plane_centre(planes + plane);
#if VECTORISED(0u)
#pragma clang loop vectorize(assume_safety)
#endif
    for (uint i = 0; i < ray_count; ++i) {
      real3 origin = (real3)(rays.origin[0][i], rays.origin[1][i], rays.origin[2][i]);
      real3 direction = (real3)(rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]);
      real t = dot3(row, sub3(centre, origin)) / dot3(row, direction);
      bool nearer = t > 0 && t < rays.t[i];
      rays.t[i] = nearer ? t : rays.t[i];
      rays.u[i] = nearer ? 0 : rays.u[i];
      rays.v[i] = nearer ? 0 : rays.v[i];
      rays.primitive[i] = nearer ? HIT_SHAPE | plane : rays.primitive[i];
    }
  }
}
