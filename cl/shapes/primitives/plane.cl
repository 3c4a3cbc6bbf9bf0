// Ray and the plane z = 0 of a shape's local space; disks share it.
#include "shared/effects.h"
#include "shapes/ray.cl"
#include "shared/types.h"

// The image of the local origin. Points are taken relative to it before anything is multiplied: far from the origin of
// the world these differences are all but exact, where to_local's products would cancel.
INLINE real3 plane_centre(global const Shape *shape) {
  return (real3)(shape->to_world[0].w, shape->to_world[1].w, shape->to_world[2].w);
}

// The t > 0 where the ray meets the plane, below t_max, or INFINITY. A ray in the plane does not meet it.
INLINE real plane_intersect(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                            real2 *parameters) {
  real3 row = convert_real3(shape->to_local[2].xyz);
  real t = dot3(row, plane_centre(shape) - ray.origin) / dot3(row, ray.direction);
  return t > 0 && t < t_max ? t : (real)INFINITY;
}

// Position, error and normals at a hit: the point on the ray, projected onto the plane that plane_intersect
// uses (the row of to_local, not to_world, which is its inverse only up to rounding).
INLINE void plane_position(global const Shape *shape, Ray ray, Hit hit, Surface *surface) {
  real3 row = convert_real3(shape->to_local[2].xyz);
  real row_length = length(row);
  real3 n = row / row_length;
  real3 p = fma((real3)(hit.t), ray.direction, ray.origin);
  real3 from_centre = p - plane_centre(shape);
  p -= n * (dot3(row, from_centre) / row_length);
  surface->position = p;
  // Rounding of <row, p - centre> (four differences, products and sums), once in the projection and once in the
  // next intersection of a ray spawned here, and of p itself.
  surface->error =
      GAMMA(8) * dot3(fabs(row), fabs(from_centre)) / row_length + GAMMA(2) * max_component(fabs(p));
  surface->geometric_normal = surface->shading_normal = n;
}

// uv: the distances from the image of the local origin along the world directions of local x and y.
INLINE void plane_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  plane_position(shape, ray, hit, surface);
  global const float4 *rows = shape->to_world;
  real3 x_axis = normalize((real3)(rows[0].x, rows[1].x, rows[2].x));
  real3 y_axis = normalize((real3)(rows[0].y, rows[1].y, rows[2].y));
  real3 from_origin = surface->position - plane_centre(shape);
  surface->uv = (real2)(dot3(x_axis, from_origin), dot3(y_axis, from_origin));
}
