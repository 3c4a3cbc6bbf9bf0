// Ray and the plane z = 0 of a shape's local space; disks share it.
#include "shared/effects.h"
#include "shapes/ray.cl"
#include "shared/types.h"

// The image of the local origin. Points are taken relative to it before anything is multiplied: far from the origin of
// the world these differences are all but exact, where to_local's products would cancel.
INLINE real3 plane_centre(global const Shape *shape) { return affine_origin(shape->to_world); }

// The normal, not of unit length, by which the plane is met.
INLINE real3 plane_row(global const Shape *shape) { return affine_row(shape->to_local, 2); }

// The t > 0 where the ray meets the plane, below t_max, or INFINITY. A ray in the plane does not meet it.
INLINE real plane_intersect(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                            real2 *parameters) {
  real3 row = plane_row(shape);
  real t = dot3(row, sub3(plane_centre(shape), ray.origin)) / dot3(row, ray.direction);
  return t > 0 && t < t_max ? t : (real)INFINITY;
}

// Position, error and normals at a hit: the point on the ray, projected onto the plane that plane_intersect
// uses (the row of to_local, not to_world, which is its inverse only up to rounding).
INLINE void plane_position(global const Shape *shape, Ray ray, Hit hit, Surface *surface) {
  real3 row = plane_row(shape);
  row = scaled3(unit_scale(max_component(abs3(row))), row);
  real row_length = sqrt(dot3(row, row));
  real3 n = quotient3(row, row_length);
  real3 p = ray_at(ray.origin, hit.t, ray.direction);
  real3 from_centre = sub3(p, plane_centre(shape));
  p = sub3(p, scaled3(dot3(row, from_centre) / row_length, n));
  surface->position = p;
  // Rounding of <row, p - centre> (four differences, products and sums), once in the projection and once in the
  // next intersection of a ray spawned here, and of p itself.
  surface->error =
      GAMMA(8) * dot3(abs3(row), abs3(from_centre)) / row_length + GAMMA(2) * max_component(abs3(p));
  surface->geometric_normal = surface->shading_normal = n;
}

// uv: the distances from the image of the local origin along the world directions of local x and y.
INLINE void plane_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  plane_position(shape, ray, hit, surface);
  global const float *rows = (global const float *)shape->to_world;
  real3 x_axis = unit3_of_any((real3)(rows[0], rows[4], rows[8]));
  real3 y_axis = unit3_of_any((real3)(rows[1], rows[5], rows[9]));
  real3 from_origin = sub3(surface->position, plane_centre(shape));
  surface->uv = (real2)(dot3(x_axis, from_origin), dot3(y_axis, from_origin));
}
