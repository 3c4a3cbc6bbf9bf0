// Every primitive that is not a triangle, behind one interface.
#include "shapes/bezier.cl"
#include "shapes/disk.cl"
#include "shared/effects.h"
#include "shapes/plane.cl"
#include "shapes/sphere.cl"

// Meets the ray with one shape. If it is met at 0 < t < hit->t, sets hit->t, hit->primitive to
// HIT_SHAPE | index and hit->u, hit->v to what shape_surface needs, and returns true; else leaves hit as it is.
INLINE bool shape_closest(global const Shape *shape, uint index, global const float *curves, Ray ray, Hit *hit) {
  uint type = shape->type;
  real t = INFINITY;
  real2 parameters = (real2)(0);
  if (HAS(EFFECT_SPHERES) && type == SHAPE_SPHERE) t = sphere_intersect(shape, ray, hit->t);
  if (HAS(EFFECT_PLANES) && type == SHAPE_PLANE) t = plane_intersect(shape, ray, hit->t);
  if (HAS(EFFECT_DISKS) && type == SHAPE_DISK) t = disk_intersect(shape, ray, hit->t);
  if (HAS(EFFECT_BEZIER) && type == SHAPE_BEZIER)
    t = bezier_intersect(shape, curves, ray, hit->t, &parameters);
  if (!(t < hit->t)) return false;
  hit->t = t;
  hit->primitive = HIT_SHAPE | index;
  hit->u = parameters.x;
  hit->v = parameters.y;
  if (HAS(EFFECT_BEZIER) && type == SHAPE_BEZIER && parameters.x < 0) hit->diagnostics |= DIAGNOSTIC_UNRESOLVED;
  return true;
}

// Whether the ray meets the shape at 0 < t < t_max. Adds to *diagnostics.
INLINE bool shape_occluded(global const Shape *shape, global const float *curves, Ray ray, real t_max, uint *diagnostics) {
  Hit hit = hit_none(t_max);
  bool occluded = shape_closest(shape, 0, curves, ray, &hit);
  *diagnostics |= hit.diagnostics;
  return occluded;
}

// Position, normals, uv and material at a hit that shape_closest found on the same ray.
INLINE void shape_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  uint type = HAS(EFFECTS_OF_SHAPES & ~EFFECT_SPHERES) ? shape->type : SHAPE_SPHERE;
  if (HAS(EFFECT_SPHERES) && type == SHAPE_SPHERE) sphere_surface(shape, ray, hit, surface);
  if (HAS(EFFECT_PLANES) && type == SHAPE_PLANE) plane_surface(shape, ray, hit, surface);
  if (HAS(EFFECT_DISKS) && type == SHAPE_DISK) disk_surface(shape, ray, hit, surface);
  if (HAS(EFFECT_BEZIER) && type == SHAPE_BEZIER) bezier_surface(shape, curves, ray, hit, surface);
  surface->material = shape->material;
}
