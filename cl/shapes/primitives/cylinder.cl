// Ray and a cylinder about the local y axis. On the device it is the unit cylinder, of radius 1 and from y = -1 to 1.
//
// A convex body is met where the ray has entered and not left all of the sets whose intersection it is (Kay, Kajiya, "Ray
// Tracing Complex Scenes", SIGGRAPH 1986): the infinite cylinder and the slab between the two planes. So no ray slips
// through between wall and cap, and rays along the axis or across it are no special cases.
#include "shared/effects.h"
#include "shapes/affine_error.cl"
#include "shapes/ray.cl"
#include "sampling/warp.cl"

// What Shape.own holds.
#define CYLINDER_CAPPED 0         // 1 with the two discs at its ends, 0 without
#define CYLINDER_WALL_FRACTION 1  // of its area, what its wall has

// Local error of where a ray meets it: rounding of |o|^2 - 1 and of 1 - o.y, whose signs must be right for a ray that is
// spawned there.
#define CYLINDER_ERROR GAMMA(12)

// Where a ray, of unit length and both in local space, enters and leaves a set; nowhere if the first is larger.
#define CYLINDER_EVERYWHERE ((real2)(-INFINITY, INFINITY))
#define CYLINDER_NOWHERE ((real2)(INFINITY, -INFINITY))

// The infinite cylinder: sphere_intersect() in the plane across the axis.
INLINE real2 cylinder_tube(real3 o, real3 d) {
  real2 from = o.xz, along = d.xz;
  real c = dot(from, from) - 1, speed = length(along);
  if (!(speed > 0)) return c < 0 ? CYLINDER_EVERYWHERE : CYLINDER_NOWHERE;
  along /= speed;
  real b = -dot(from, along);  // the closest approach to the axis
  real2 approach = fma((real2)(b), along, from);
  real rest = dot(approach, along);
  b -= rest;
  approach = fma((real2)(-rest), along, approach);
  real discriminant = 1 - dot(approach, approach);
  if (!(discriminant >= 0)) return CYLINDER_NOWHERE;
  real root = copysign(sqrt(discriminant), b), q = b + root;
  real other = c > 3 ? b - root : clamp(c / q, -fabs(q), fabs(q));
  return (real2)(min(q, other), max(q, other)) / speed;
}

// The slab between the planes of the caps.
INLINE real2 cylinder_slab(real3 o, real3 d) {
  if (!(fabs(d.y) > 0)) return fabs(o.y) <= 1 ? CYLINDER_EVERYWHERE : CYLINDER_NOWHERE;
  real low = (-1 - o.y) / d.y, high = (1 - o.y) / d.y;
  return (real2)(min(low, high), max(low, high));
}

// parameters.x: 0 on the wall, 1 on a cap.
INLINE real cylinder_intersect(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                               real2 *parameters) {
  real3 o = transform_point(shape->to_local, ray.origin), d = transform_vector(shape->to_local, ray.direction);
  real stretch = length(d), t;
  d /= stretch;
  real2 tube = cylinder_tube(o, d), slab = cylinder_slab(o, d);
  if (shape->own[CYLINDER_CAPPED] != 0) {
    real enter = max(tube.x, slab.x), leave = min(tube.y, slab.y);
    if (!(enter <= leave)) return INFINITY;
    t = enter > 0 ? enter : leave;
    parameters->x = (enter > 0 ? tube.x >= slab.x : tube.y <= slab.y) ? 0 : 1;
  } else {
    bool near = tube.x > 0 && slab.x <= tube.x && tube.x <= slab.y;
    t = near ? tube.x : tube.y;
    if (!(slab.x <= t && t <= slab.y)) return INFINITY;
  }
  t /= stretch;
  return t > 0 && t < t_max ? t : (real)INFINITY;
}

// |dP/du x dP/dy| of the wall at u of a turn: its area in the world for a unit of u and of local y.
INLINE real cylinder_area_element(global const Shape *shape, real2 around) {
  real3 by_u = (real3)(-around.y, 0, around.x) * (2 * PI);
  return length(cross(transform_vector(shape->to_world, by_u), transform_vector(shape->to_world, (real3)(0, 1, 0))));
}

// The surface at a hit. uv: on the wall the angle from x towards z, over 2 pi, and the height from 0 to 1; on a cap 0 to 1
// across its bounding square.
INLINE void cylinder_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  real3 p = transform_point(shape->to_local, fma((real3)(hit.t), ray.direction, ray.origin)), n;
  real rho = length(p.xz);
  real2 radial = rho > 0 ? p.xz / rho : (real2)(1, 0);
  if (hit.u == 0) {
    p = (real3)(radial.x, clamp(p.y, (real)-1, (real)1), radial.y);
    n = (real3)(radial.x, 0, radial.y);
    real angle = atan2(radial.y, radial.x) * (INV_PI * (real)0.5);
    angle = angle < 0 ? angle + 1 : angle;
    surface->uv = (real2)(angle < 1 ? angle : (real)0, p.y * (real)0.5 + (real)0.5);
  } else {
    real2 on_cap = rho > 1 ? radial : p.xz;
    p = (real3)(on_cap.x, p.y < 0 ? -1 : 1, on_cap.y);
    n = (real3)(0, p.y, 0);
    surface->uv = on_cap * (real)0.5 + (real)0.5;
  }
  surface->position = transform_point(shape->to_world, p);
  surface->error = affine_error(shape, surface->position, CYLINDER_ERROR);
  surface->geometric_normal = surface->shading_normal = normalize(transform_normal(shape->to_local, n));
}

// Wall or cap by area, then evenly in angle and height, or on the disc.
INLINE real3 cylinder_draw_point(global const Shape *shape, global const float *curves, real u, real v, real3 *normal,
                                 real *pdf) {
  real fraction = shape->own[CYLINDER_WALL_FRACTION];
  real3 p, n;
  if (u < fraction) {
    real2 around = cos_sin_turn(u / fraction);
    p = (real3)(around.x, 2 * v - 1, around.y);
    n = (real3)(around.x, 0, around.y);
    real element = 2 * cylinder_area_element(shape, around);
    *pdf = element > 0 ? fraction / element : 0;
  } else {
    real which = 2 * clamp((u - fraction) / (1 - fraction), (real)0, (real)0.99999994);
    real2 place = disc_uniform((real2)(which < 1 ? which : which - 1, v));
    p = (real3)(place.x, which < 1 ? -1 : 1, place.y);
    n = (real3)(0, p.y, 0);
    real3 x = transform_vector(shape->to_world, (real3)(1, 0, 0)), z = transform_vector(shape->to_world, (real3)(0, 0, 1));
    real area = PI * length(cross(x, z));
    *pdf = area > 0 ? (1 - fraction) / (2 * area) : 0;
  }
  *normal = normalize(transform_normal(shape->to_local, n));
  return transform_point(shape->to_world, p);
}

// Caps are drawn evenly. The wall is where all axes are scaled alike.
INLINE real cylinder_unevenness(global const Shape *shape, global const float *curves, Hit hit, const Surface *surface) {
  if (hit.u != 0) return 1;
  real element = 2 * cylinder_area_element(shape, cos_sin_turn(surface->uv.x));
  return element > 0 ? shape->own[CYLINDER_WALL_FRACTION] * shape->area / element : 0;
}
