// Ray and a Bezier curve revolved about the local y axis.
//
// A ray's height and its distance rho from the axis make the path (rho(t), y(t)), one branch of a hyperbola, in
// the half plane of the profile: the hits are where the path crosses the profile. The profile is cut by the host
// into spans, the path at its closest approach to the axis; what is then monotone is met by subdivision (see
// bezier_span.cl). No root can be skipped, nothing is divided by a component of the ray's direction that may
// vanish, and horizontal rays, rays along the axis and tangent rays are no special cases.
#include "shared/effects.h"
#include "shapes/affine_error.cl"
#include "shapes/bezier_span.cl"
#include "shapes/ray.cl"

// The ray in unit space with a direction of unit length, its origin moved forward to near the curve. With
// returned (stretch, shift): t of the world = (t of the result + shift) / stretch.
INLINE real2 bezier_unit_ray(global const Shape *shape, global const float *curve, Ray *ray) {
  real to_unit = 1 / curve[1];
  real3 o = (transform_point(shape->to_local, ray->origin) - (real3)(0, curve[2], 0)) * to_unit;
  real3 d = transform_vector(shape->to_local, ray->direction) * to_unit;
  real stretch = length(d);
  ray->direction = d / stretch;
  // Unit space is within a sphere of radius sqrt(2).
  real shift = max(-dot(o, ray->direction) - (real)1.5, (real)0);
  ray->origin = fma((real3)(shift), ray->direction, o);
  return (real2)(stretch, shift);
}

// One bit for each true lane of a comparison.
INLINE uint bezier_lane_bits(mask8 lanes) {
  int8 bits = mask_lanes(lanes) & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  int4 four = bits.lo | bits.hi;
  int2 two = four.lo | four.hi;
  return (uint)(two.x | two.y);
}

// The least t in (0, t_max) where the ray meets the surface, or INFINITY. `parameters` then hold the span
// (minus one minus the span for a hit that stands for unresolved arcs) and w in it.
INLINE real bezier_intersect(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                             real2 *parameters) {
  global const float *curve = curves + shape->curve;
  real2 map = bezier_unit_ray(shape, curve, &ray);
  real t_end = min(t_max * map.x - map.y, (real)1.5 - dot(ray.origin, ray.direction));
  if (!(t_end > 0)) return INFINITY;

  // The closest approach to the axis, by which the ray is within radius r for |t - t_near| <
  // sqrt(r^2 - rho_near^2) / across. For a ray nearly along the axis t_near is far away, but what its rounding
  // changes in t is the same rounding in rho.
  real2 flat = ray.direction.xz;
  real across2 = max(dot(flat, flat), (real)1e-30);
  real t_near = -dot(ray.origin.xz, flat) / across2;
  real2 near = fma((real2)(t_near), flat, ray.origin.xz);
  real rho2 = dot(near, near);
  real slower = rsqrt(across2);
  real dy = fabs(ray.direction.y) > (real)1e-20 ? ray.direction.y : (real)1e-20;
  real inverse_dy = 1 / dy;

  uint count = (uint)curve[0];
  global const float *group = curve + CURVE_HEADER, *spans = bezier_spans(curve);
  BezierHit best = {t_end, 0, false};
  uint span_best = 0;
  for (uint first = 0; first < count; first += 8u, group += CURVE_GROUP) {
    real8 ya = (convert_real8(vload8(0, group)) - ray.origin.y) * inverse_dy;
    real8 yb = (convert_real8(vload8(1, group)) - ray.origin.y) * inverse_dy;
    real8 inner = sqrt(fmax(convert_real8(vload8(2, group)) - rho2, (real)0)) * slower;
    real8 outer2 = convert_real8(vload8(3, group)) - rho2;
    real8 outer = sqrt(fmax(outer2, (real)0)) * slower;
    real8 from = fmax(fmax(fmin(ya, yb), t_near - outer), (real)0);
    real8 to = fmin(fmin(fmax(ya, yb), t_near + outer), best.t);
    uint before = bezier_lane_bits((outer2 >= 0) & (from <= fmin(to, t_near - inner)));
    uint after = bezier_lane_bits((outer2 >= 0) & (fmax(from, t_near + inner) <= to));
    uint arcs = before | (after << 8u);
    while (arcs) {
      uint bit = 31u - clz(arcs & -arcs);
      arcs &= arcs - 1u;
      uint lane = bit & 7u;
      real side = bit < 8u ? -1 : 1;
      real lane_ya = (group[lane] - ray.origin.y) * inverse_dy;
      real lane_yb = (group[lane + 8u] - ray.origin.y) * inverse_dy;
      real lane_inner = sqrt(max(group[lane + 16u] - rho2, (real)0)) * slower;
      real lane_outer = sqrt(max(group[lane + 24u] - rho2, (real)0)) * slower;
      real t_first = max(max(min(lane_ya, lane_yb), t_near - lane_outer), (real)0);
      real t_last = min(min(max(lane_ya, lane_yb), t_near + lane_outer), t_end);
      if (side < 0)
        t_last = min(t_last, t_near - lane_inner);
      else
        t_first = max(t_first, t_near + lane_inner);
      if (!(t_first <= t_last && t_first < best.t)) continue;
      real t_before = best.t;
      bezier_span_intersect(spans + (first + lane) * CURVE_SPAN, ray, t_first, t_last, side, &best);
      if (best.t < t_before) span_best = first + lane;
    }
  }
  if (!(best.t < t_end)) return INFINITY;
  *parameters = (real2)(best.unresolved ? -(real)1 - (real)span_best : (real)span_best, best.w);
  return (best.t + map.y) / map.x;
}

// The surface at a hit, on the profile itself at the ray's angle; uv = (angle / 2 pi in [0, 1), curve parameter),
// the angle from x towards z.
INLINE void bezier_surface(global const Shape *shape, global const float *curves, Ray ray, Hit hit, Surface *surface) {
  global const float *curve = curves + shape->curve;
  uint index = (uint)(hit.u < 0 ? -(real)1 - hit.u : hit.u);
  global const float *span = bezier_spans(curve) + index * CURVE_SPAN;
  real w = hit.v, scale = curve[1];
  real4 profile = bezier_evaluate(span, w);

  real3 reached = transform_point(shape->to_local, fma((real3)(hit.t), ray.direction, ray.origin));
  real rho = length(reached.xz);
  real2 radial = rho > 0 ? reached.xz / rho : (real2)(1, 0);
  real3 p = (real3)(profile.x * scale * radial.x, profile.y * scale + curve[2], profile.x * scale * radial.y);
  surface->position = transform_point(shape->to_world, p);

  surface->error = affine_error(shape, surface->position, BEZIER_ERROR * scale + STORED_GAMMA(2) * fabs(curve[2]));

  real2 n = bezier_profile_normal(curve, span, w, profile.zw);
  surface->geometric_normal = surface->shading_normal =
      normalize(transform_normal(shape->to_local, (real3)(n.x * radial.x, n.y, n.x * radial.y)));
  real angle = atan2(radial.y, radial.x) * (INV_PI * (real)0.5);
  angle = angle < 0 ? angle + 1 : angle;
  surface->uv = (real2)(angle < 1 ? angle : (real)0, mix((real)span[16], (real)span[17], (w + 1) * (real)0.5));
}

// Area-uniform in the curve's own space: which step of the table of cumulative area, then uniform in t within.
// Returns t and *density, the probability density of t.
INLINE real bezier_parameter(global const float *table, uint steps, real u, real *density) {
  uint low = 0, high = steps - 1;
  while (low < high) {
    uint middle = (low + high) / 2;
    if (u < table[middle])
      high = middle;
    else
      low = middle + 1;
  }
  real before = low == 0 ? (real)0 : (real)table[low - 1];
  real pmf = table[low] - before;
  *density = pmf * steps;
  return (low + (pmf > 0 ? clamp((u - before) / pmf, (real)0, (real)1) : (real)0.5)) / steps;
}

INLINE real bezier_parameter_pdf(global const float *table, uint steps, real t) {
  uint step = min((uint)(t * steps), steps - 1);
  return (table[step] - (step == 0 ? 0 : table[step - 1])) * steps;
}

// Even by area in the curve's own space: v draws the angle, u the curve parameter.
INLINE real3 bezier_draw_point(global const Shape *shape, global const float *curves, real u, real v, real3 *normal,
                               real *pdf) {
  real density, area;
  real t = bezier_parameter(curves + shape->area_table, EMITTER_AREA_STEPS, u, &density);
  real3 point;
  bezier_point(shape, curves, v, t, &point, normal, &area);
  *pdf = area > 0 ? density / area : 0;
  return point;
}

INLINE real bezier_unevenness(global const Shape *shape, global const float *curves, Hit hit, const Surface *surface) {
  real3 point, normal;
  real area, total = shape->area;
  bezier_point(shape, curves, surface->uv.x, surface->uv.y, &point, &normal, &area);
  global const float *table = curves + shape->area_table;
  return area > 0 ? total * bezier_parameter_pdf(table, EMITTER_AREA_STEPS, surface->uv.y) / area : 0;
}
