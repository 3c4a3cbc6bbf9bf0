// Ray and sphere, in world space.
#include "shared/effects.h"
#include "shapes/ray.cl"
#include "shared/types.h"

// The least t in (0, t_max) where the ray meets the sphere of Shape.sphere (centre, radius), or INFINITY.
// The discriminant is taken from the distance between the centre and the ray, and the roots from the form that
// does not cancel: Haines, Gunther, Akenine-Moller, "Precision Improvements for Ray/Sphere Intersection", Ray
// Tracing Gems ch. 7 (2019). No miss at a centre 1e5 radii away with a closest approach up to 0.95 radii.
INLINE real sphere_intersect(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                             real2 *parameters) {
  real radius = shape->sphere.w;
  real3 f = ray.origin - convert_real3(shape->sphere.xyz);
  real b = -dot3(f, ray.direction);  // t of the closest approach
  real3 approach = fma((real3)(b), ray.direction, f);
  // What rounding of b, and a direction not quite of unit length, leave of the way there.
  real rest = dot3(approach, ray.direction);
  b -= rest;
  approach = fma((real3)(-rest), ray.direction, approach);
  real discriminant = radius * radius - dot3(approach, approach);
  if (!(discriminant >= 0)) return INFINITY;

  // Of the two roots q is the larger in magnitude; near a tangent at the origin c / q is noise over noise. Seen from
  // afar b loses nothing, and c / q would carry the rounding of c, q and the division.
  real root = copysign(sqrt(discriminant), b), q = b + root;
  real c = dot3(f, f) - radius * radius;
  real other = c > 3 * radius * radius ? b - root : clamp(c / q, -fabs(q), fabs(q));
  real near = min(q, other), far = max(q, other);
  real t = near > 0 ? near : far;
  return t > 0 && t < t_max ? t : (real)INFINITY;
}

// The surface at a hit; uv is the image mapping of the scene format: q = normalize(to_local p), (q.xy + 1) / 2.
INLINE void sphere_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  global const float *sphere = (global const float *)&shape->sphere;
  real3 centre = (real3)(sphere[0], sphere[1], sphere[2]);
  real radius = sphere[3];
  real3 n = unit3(ray_at(sub3(ray.origin, centre), hit.t, ray.direction));
  surface->position = ray_at(centre, radius, n);  // back onto the surface, whatever t lost
  // Rounding of the last sum, of n and its product; and of |f|^2 - radius^2 in sphere_intersect, whose sign
  // must be right for a ray that is spawned here.
  surface->error = GAMMA(1) * max_component(abs3(surface->position)) + GAMMA(12) * radius;
  surface->geometric_normal = surface->shading_normal = n;
  real3 q = unit3_of_any(transform_vector(shape->to_local, n));
  surface->uv = (real2)(q.x * (real)0.5 + (real)0.5, q.y * (real)0.5 + (real)0.5);
}
