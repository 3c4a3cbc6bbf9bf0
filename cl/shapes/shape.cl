// Every primitive that is not a triangle, behind one interface: the rows of SHAPE_TABLE.
//
// The file of a shape, shapes/primitives/NAME.cl, has
//   real NAME_intersect(shape, curves, ray, t_max, &parameters)
//     the t in (0, t_max) where the ray meets the shape first, or INFINITY. `parameters` are zero before: what
//     NAME_surface is to know of the hit; parameters.x < 0 marks a hit that stands for what was not told apart.
//   void NAME_surface(shape, curves, ray, hit, &surface)
//     all of Surface but the material, at a hit of the same ray.
// and, with OWN_POINTS,
//   real3 NAME_draw_point(shape, curves, u, v, &normal, &pdf)
//     a point on it that the uniform numbers u and v draw, its outward unit normal, and its density by area.
//   real NAME_unevenness(shape, curves, hit, surface)
//     that density at a hit, times Shape.area.
#include "shared/effects.h"
#include "shapes/primitives/*.cl"

// Meets the ray with one shape. If it is met at 0 < t < hit->t, sets hit->t, hit->primitive to
// HIT_SHAPE | index and hit->u, hit->v to what shape_surface needs, and returns true; else leaves hit as it is.
INLINE bool shape_closest(global const Shape *shape, uint index, global const float *curves, Ray ray, Hit *hit) {
  uint type = shape->type;
  real t = INFINITY;
  real2 parameters = (real2)(0);
#define SHAPE_INTERSECT(x, NAME, number, name, key, effect, points) \
  if (HAS(effect) && type == SHAPE_##NAME) t = name##_intersect(shape, curves, ray, hit->t, &parameters);
  SHAPE_TABLE(SHAPE_INTERSECT, )
#undef SHAPE_INTERSECT
  if (!(t < hit->t)) return false;
  hit->t = t;
  hit->primitive = HIT_SHAPE | index;
  hit->u = parameters.x;
  hit->v = parameters.y;
  if (parameters.x < 0) hit->diagnostics |= DIAGNOSTIC_UNRESOLVED;
  return true;
}

// Whether the ray meets the shape at 0 < t < t_max. Adds to *diagnostics.
INLINE bool shape_occluded(global const Shape *shape, global const float *curves, Ray ray, real t_max, uint *diagnostics) {
  Hit hit = hit_none(t_max);
  bool occluded = shape_closest(shape, 0, curves, ray, &hit);
  *diagnostics |= hit.diagnostics;
  return occluded;
}

// Whether the scene has shapes of that effect alone: their type need not be read.
#define HAS_ALONE(effect) ((EFFECTS & EFFECTS_OF_SHAPES) == (effect))

// Position, normals, uv and material at a hit that shape_closest found on the same ray.
INLINE void shape_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
#define SHAPE_SURFACE(x, NAME, number, name, key, effect, points) \
  if (HAS(effect) && (HAS_ALONE(effect) || shape->type == SHAPE_##NAME)) name##_surface(shape, curves, ray, hit, surface);
  SHAPE_TABLE(SHAPE_SURFACE, )
#undef SHAPE_SURFACE
  surface->material = shape->material;
}

// The effects of plain shapes, whose surface is found without loops or arithmetic of whole vectors.
enum { PLAIN_SHAPES = EFFECTS_OF_SHAPES & ~EFFECTS_NOT_BATCHED(SCALAR_EVENTS) };

INLINE bool is_plain(global const Shape *shape) {
  if ((EFFECTS & EFFECTS_OF_SHAPES & ~(uint)PLAIN_SHAPES) == 0u) return true;
  uint type = shape->type;
#define IS_PLAIN(x, NAME, number, name, key, effect, points) \
  || (HAS(effect) && ((effect) & (uint)PLAIN_SHAPES) != 0u && type == SHAPE_##NAME)
  return false SHAPE_TABLE(IS_PLAIN, );
#undef IS_PLAIN
}

// shape_surface() of plain shapes, for loops that are to be vectorised: computes what the shape would be as each of them, and
// chooses.
INLINE void shape_surface_soa(global const Shape *shape, global const float *curves, Ray ray, Hit hit, SurfaceParts *parts) {
  uint type = shape->type;
#define CHOOSE_SURFACE(x, NAME, number, name, key, effect, points)       \
  if (HAS((effect) & (uint)PLAIN_SHAPES)) {                               \
    Surface surface;                                                      \
    SurfaceParts own;                                                     \
    name##_surface(shape, curves, ray, hit, &surface);                    \
    surface_unpack(&surface, &own);                                       \
    surface_choose(HAS_ALONE(effect) || type == SHAPE_##NAME, &own, parts); \
  }
  SHAPE_TABLE(CHOOSE_SURFACE, )
#undef CHOOSE_SURFACE
  parts->material = shape->material;
}

// The effects of shapes whose points their own files draw, where no table may be named: within one.
enum { OWN_POINT_EFFECTS = EFFECTS_OF_OWN_POINTS };

// These shapes, as cases of one of them.
#define NO_POINTS_CASE(...)
#define EMITTER_POINTS_CASE(...)
#define OWN_POINTS_CASE(NAME, effect, statement) \
  if (HAS(effect) && ((EFFECTS & OWN_POINT_EFFECTS) == (effect) || shape->type == SHAPE_##NAME)) statement;

// A point on an emitter of EMITTER_SHAPE, which u and v draw; *pdf is its density by area, zero where it is none to use.
INLINE real3 shape_draw_point(global const Shape *shape, global const float *curves, real u, real v, real3 *normal,
                              real *pdf) {
  real3 point = (real3)(0, 0, 0);
#define DRAW_POINT(x, NAME, number, name, key, effect, points) \
  points##_CASE(NAME, effect, point = name##_draw_point(shape, curves, u, v, normal, pdf))
  SHAPE_TABLE(DRAW_POINT, )
#undef DRAW_POINT
  return point;
}

// The density with which shape_draw_point() draws the place of a hit, times Shape.area; 1 on other shapes, whose points are
// drawn evenly.
INLINE real shape_unevenness(global const Shape *shape, global const float *curves, Hit hit, const Surface *surface) {
#define UNEVENNESS(x, NAME, number, name, key, effect, points) \
  points##_CASE(NAME, effect, if (shape->type == SHAPE_##NAME) return name##_unevenness(shape, curves, hit, surface))
  SHAPE_TABLE(UNEVENNESS, )
#undef UNEVENNESS
  return 1;
}
