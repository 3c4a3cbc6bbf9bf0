// Ray and the unit disc of the local plane z = 0: an ellipse under a general to_world.
#include "shapes/primitives/plane.cl"

// The t > 0 where the ray meets the disc, below t_max, or INFINITY.
INLINE real disk_intersect(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                           real2 *parameters) {
  real t = plane_intersect(shape, curves, ray, t_max, parameters);
  if (!(t < t_max)) return INFINITY;
  // From the centre to the ray's origin first: the difference of near numbers is exact.
  real3 from_centre = fma((real3)(t), ray.direction, ray.origin - plane_centre(shape));
  real3 p = transform_vector(shape->to_local, from_centre);
  return p.x * p.x + p.y * p.y <= 1 ? t : (real)INFINITY;
}

// uv: local x and y, [-1, 1] mapped to [0, 1].
INLINE void disk_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  plane_position(shape, ray, hit, surface);
  real3 p = transform_vector(shape->to_local, sub3(surface->position, plane_centre(shape)));
  surface->uv = (real2)(p.x * (real)0.5 + (real)0.5, p.y * (real)0.5 + (real)0.5);
}
