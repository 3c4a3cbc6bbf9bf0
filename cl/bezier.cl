// Ray and a Bezier curve revolved about the local y axis.
//
// A ray's height and its distance rho from the axis make the path (rho(t), y(t)), one branch of a hyperbola, in
// the half plane of the profile: the hits are where the path crosses the profile. Both are cut into convex arcs
// whose position and direction are monotone (the profile by the host, the path at its closest approach to the
// axis), so that their ends and end tangents bound them. Pairs of arcs are halved until they are apart, or until
// no direction of the one is a direction of the other: then they cross at most once, and Newton's iteration
// finds where. No root can be skipped, nothing is divided by a component of the ray's direction that may
// vanish, and horizontal rays, rays along the axis and tangent rays are no special cases. (Fat lines and
// subdivision as in Sederberg & Nishita, "Curve intersection using Bezier clipping", CAD 22(9), 1990.)
//
// Layout at curves[shape->curve], in unit space, where the profile is scaled into x in [0, 1], y in [-1, 1]:
//   0 number of spans; 1 scale; 2 centre: local (x, y) = scale (x, y) of unit space + (0, centre);
//   3 orientation of the normal
//   8 for each group of eight spans: y_low[8], y_high[8], x_low^2[8], x_high^2[8], padded
//   then for each span: (x, y) coefficients of w^0 ... w^5, w in [-1, 1]; unit tangents at w = -1 and 1; the
//   curve parameters at w = -1 and 1; for w = -1 and 1 whether the surface goes on smoothly there; padding to 24
#include "effects.h"
#include "ray.cl"
#include "types.h"

#define CURVE_HEADER 8u
#define CURVE_GROUP 32u
#define CURVE_SPAN 24u

// In unit space, whose coordinates are of order 1. The spans' coefficients are floats in every build, so that two
// spans meet only up to their rounding: these bounds stay the same in double, but for how far Newton's iteration goes.
#define BEZIER_APART ((real)2.4e-7)       // arcs farther apart than this do not touch: rounding of a coordinate
#define BEZIER_COINCIDENT ((real)4.8e-7)  // arcs nowhere farther apart than this do
#define BEZIER_ERROR ((real)1.9e-6)       // offset of spawned rays, above both
#define BEZIER_OVERLAP ((real)2e-6)       // arcs reach beyond their ends by at least this, so that joints do not leak
#define BEZIER_STRAIGHT ((real)2e-5)      // transversal arcs as short as this are their chords
#define BEZIER_CONVERGED (sizeof(real) > sizeof(float) ? (real)4e-9 : (real)1e-4)  // its square is under rounding
#define BEZIER_LEVELS 15u                 // halvings of a span
#define BEZIER_STEPS 1000u                // pairs of arcs looked at for one span

INLINE real cross2(real2 a, real2 b) { return a.x * b.y - a.y * b.x; }

INLINE global const float *bezier_spans(global const float *curve) {
  uint groups = ((uint)curve[0] + 7u) / 8u;
  return curve + CURVE_HEADER + groups * CURVE_GROUP;
}

// Profile point (xy) and its derivative by w (zw).
INLINE real4 bezier_evaluate(global const float *span, real w) {
  real2 p = (real2)(span[10], span[11]), d = (real2)(0);
  for (int k = 4; k >= 0; --k) {
    d = fma(d, (real2)(w), p);
    p = fma(p, (real2)(w), (real2)(span[2 * k], span[2 * k + 1]));
  }
  return (real4)(p, d);
}

// The direction of the profile at w, not normalised; the stored one where the curve stands still (cusps).
INLINE real2 bezier_tangent(global const float *span, real w, real2 derivative) {
  if (fabs(w) < 1) return derivative;
  return w < 0 ? (real2)(span[12], span[13]) : (real2)(span[14], span[15]);
}

// Path point (xy) and its derivative by t (zw) of a ray in unit space.
INLINE real4 bezier_path(Ray ray, real t) {
  real2 q = fma((real2)(t), ray.direction.xz, ray.origin.xz);
  real rho = sqrt(dot(q, q));
  real slope = rho > 0 ? dot(q, ray.direction.xz) / rho : length(ray.direction.xz);
  return (real4)(rho, fma(t, ray.direction.y, ray.origin.y), slope, ray.direction.y);
}

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

// Looks for a crossing of one span with the path over [t_first, t_last], which lies on one side (-1 before, 1
// after) of the closest approach to the axis. On success lowers t_best and sets w_best. Where the arcs cannot be
// told apart or are not resolved in BEZIER_STEPS, a hit is reported (light must not leak) and, in the second
// case, `unresolved` is set.
INLINE void bezier_span_intersect(global const float *span, Ray ray, real t_first, real t_last, real side,
                                  real *t_best, real *w_best, bool *unresolved) {
  uint level = 0, cell_t = 0, cell_w = 0;
  for (uint step = 0;; ++step) {
    real part = 1 / (real)(1u << level);
    real t0 = fma(t_last - t_first, (real)cell_t * part, t_first);
    real t1 = fma(t_last - t_first, (real)(cell_t + 1u) * part, t_first);
    real w0 = fma((real)(2u * cell_w), part, (real)-1), w1 = fma((real)(2u * cell_w + 2u), part, (real)-1);
    bool descend = false;

    if (t0 < *t_best) {
      real4 curve0 = bezier_evaluate(span, w0), curve1 = bezier_evaluate(span, w1);
      real4 path0 = bezier_path(ray, t0), path1 = bezier_path(ray, t1);
      real2 low = fmin(curve0.xy, curve1.xy) - fmax(path0.xy, path1.xy);
      real2 high = fmin(path0.xy, path1.xy) - fmax(curve0.xy, curve1.xy);
      if (max(max(low.x, low.y), max(high.x, high.y)) <= BEZIER_APART) {
        // Directions: all of an arc's are between its end tangents, so four cross products of one sign mean
        // that the arcs are transversal everywhere.
        real2 tangent0 = bezier_tangent(span, w0, curve0.zw), tangent1 = bezier_tangent(span, w1, curve1.zw);
        real2 way0 = (real2)(side * fabs(path0.z), path0.w), way1 = (real2)(side * fabs(path1.z), path1.w);
        real size0 = 1 / (fabs(tangent0.x) + fabs(tangent0.y)), size1 = 1 / (fabs(tangent1.x) + fabs(tangent1.y));
        real4 crosses = (real4)(cross2(tangent0, way0) * size0, cross2(tangent0, way1) * size0,
                                cross2(tangent1, way0) * size1, cross2(tangent1, way1) * size1);
        real2 least = fmin(crosses.xy, crosses.zw), most = fmax(crosses.xy, crosses.zw);
        real cross_low = min(least.x, least.y), cross_high = max(most.x, most.y);
        bool transversal = cross_low > (real)1e-3 || cross_high < (real)-1e-3;
        // So steady that the arcs, made longer by half, stay transversal.
        bool steady = 2 * min(fabs(cross_low), fabs(cross_high)) > max(fabs(cross_low), fabs(cross_high));
        descend = true;
        if (transversal) {
          // Newton's iteration for both parameters from the crossing of the chords. A limit inside is the only
          // crossing there is; a limit outside says that there is none only where that stays true outside.
          real2 chord = curve1.xy - curve0.xy, leg = path1.xy - path0.xy, gap = path0.xy - curve0.xy;
          real determinant = cross2(chord, leg);
          real fraction_w = cross2(gap, leg) / determinant, fraction_t = cross2(gap, chord) / determinant;
          real w = w0 + (w1 - w0) * clamp(fraction_w, (real)0, (real)1);
          real t = t0 + (t1 - t0) * clamp(fraction_t, (real)0, (real)1);
          real reach_w = w1 - w0, reach_t = t1 - t0 + (real)1e-3;
          real length = fabs(chord.x) + fabs(chord.y);
          // How far along either arc the rounding of positions may move the crossing; an edge stays sharp.
          real overlap = BEZIER_APART / min(fabs(cross_low), fabs(cross_high)) + BEZIER_OVERLAP;
          // Arcs shorter than that would be found coincident, so their own length is enough.
          real overlap_w = min(overlap, length);
          real overlap_low = fma(overlap_w, w0 > -1 ? (real)1 : (real)span[18], BEZIER_OVERLAP);
          real overlap_high = fma(overlap_w, w1 < 1 ? (real)1 : (real)span[19], BEZIER_OVERLAP);
          real leg_length = fabs(leg.x) + fabs(leg.y);
          if (length + leg_length < BEZIER_STRAIGHT) {
            descend = false;
            if (fraction_w * length > -overlap_low && (fraction_w - 1) * length < overlap_high &&
                fabs(fraction_t - (real)0.5) * leg_length < (real)0.5 * leg_length + overlap && t > 0 &&
                t < *t_best) {
              *t_best = t;
              *w_best = w;
              *unresolved = false;
            }
          }
          // Where the profile slows down and turns back, at a cusp, the iteration creeps or leaves: halve.
          real least_advance = (real)0.02 * dot(chord, chord) / reach_w;
          for (int i = 0; i < 8 && descend; ++i) {
            real4 c = bezier_evaluate(span, w), p = bezier_path(ray, t);
            real2 rest = p.xy - c.xy;
            real scale = 1 / cross2(c.zw, p.zw);
            real dw = cross2(rest, p.zw) * scale, dt = cross2(rest, c.zw) * scale;
            w += dw;
            t += dt;
            if (!(w > w0 - reach_w && w < w1 + reach_w && t > t0 - reach_t && t < t1 + reach_t)) break;
            if (dot(c.zw, chord) < least_advance) break;
            real speed = fabs(c.z) + fabs(c.w);
            if (fabs(dw) * speed + fabs(dt) < BEZIER_CONVERGED) {
              bool within = w >= w0 && w <= w1 && t >= t0 && t <= t1;
              if ((w0 - w) * speed <= overlap_low && (w - w1) * speed <= overlap_high && t >= t0 - overlap && t <= t1 + overlap &&
                  t > 0 && t < *t_best) {
                *t_best = t;
                *w_best = clamp(w, (real)-1, (real)1);
                *unresolved = false;
              }
              descend = !(within || steady);
              break;
            }
          }
        }
        if (descend) {
          // Fat lines: signed distances from the chord's line, of the profile's bulge and of the path.
          real2 chord = curve1.xy - curve0.xy;
          real inverse_length = rsqrt(max(dot(chord, chord), (real)1e-30));
          real2 along = chord * inverse_length, normal = (real2)(-along.y, along.x);
          real s0 = cross2(along, tangent0), s1 = -cross2(along, tangent1);
          real k0 = dot(along, tangent0), k1 = dot(along, tangent1);
          real slopes = fabs(s0) * k1 + fabs(s1) * k0;
          real bulge = slopes > 0 ? dot(chord, along) * s0 * fabs(s1) / slopes : (real)0;
          real d0 = dot(normal, path0.xy - curve0.xy), d1 = dot(normal, path1.xy - curve0.xy);
          real sag = -normal.x * fabs(way1.x - way0.x) * (t1 - t0) * (real)0.25;  // rho(t) is convex
          real path_low = min(d0, d1) + min(sag, (real)0), path_high = max(d0, d1) + max(sag, (real)0);
          real curve_low = min(bulge, (real)0), curve_high = max(bulge, (real)0);
          bool apart = path_low > curve_high + BEZIER_APART || path_high < curve_low - BEZIER_APART;
          bool coincident = max(path_high, curve_high) - min(path_low, curve_low) < BEZIER_COINCIDENT;
          real t = (t0 + t1) * (real)0.5;
          // An arc of the profile no longer than rounding has no direction: a point beside a straight path.
          if (dot(chord, along) < BEZIER_COINCIDENT && fabs(sag) < BEZIER_COINCIDENT) {
            real2 leg = path1.xy - path0.xy, gap = curve0.xy - path0.xy;
            real leg_length2 = max(dot(leg, leg), (real)1e-30);
            coincident = fabs(cross2(leg, gap)) < BEZIER_COINCIDENT * sqrt(leg_length2);
            apart = !coincident;
            t = fma(t1 - t0, clamp(dot(leg, gap) / leg_length2, (real)0, (real)1), t0);
          }
          bool exhausted = level == BEZIER_LEVELS || step >= BEZIER_STEPS;
          descend = !(apart || coincident || exhausted);
          if (!apart && !descend && t > 0 && t < *t_best) {
            *t_best = t;
            *w_best = (w0 + w1) * (real)0.5;
            *unresolved = !coincident;
          }
        }
      }
    }

    // The next pair, in order of t: the first child, else the next cell in Z order.
    if (descend) {
      ++level;
      cell_t *= 2u;
      cell_w *= 2u;
    } else {
      while (level > 0 && (cell_t & cell_w & 1u)) {
        --level;
        cell_t >>= 1;
        cell_w >>= 1;
      }
      if (level == 0) return;
      if (cell_w & 1u) cell_t |= 1u;
      cell_w ^= 1u;
    }
  }
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
  real t_best = t_end, w_best = 0;
  uint span_best = 0;
  bool found_unresolved = false;
  for (uint first = 0; first < count; first += 8u, group += CURVE_GROUP) {
    real8 ya = (convert_real8(vload8(0, group)) - ray.origin.y) * inverse_dy;
    real8 yb = (convert_real8(vload8(1, group)) - ray.origin.y) * inverse_dy;
    real8 inner = sqrt(fmax(convert_real8(vload8(2, group)) - rho2, (real)0)) * slower;
    real8 outer2 = convert_real8(vload8(3, group)) - rho2;
    real8 outer = sqrt(fmax(outer2, (real)0)) * slower;
    real8 from = fmax(fmax(fmin(ya, yb), t_near - outer), (real)0);
    real8 to = fmin(fmin(fmax(ya, yb), t_near + outer), t_best);
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
      if (!(t_first <= t_last && t_first < t_best)) continue;
      real t_before = t_best;
      bool unresolved = false;
      bezier_span_intersect(spans + (first + lane) * CURVE_SPAN, ray, t_first, t_last, side, &t_best, &w_best,
                            &unresolved);
      if (t_best < t_before) {
        span_best = first + lane;
        found_unresolved = unresolved;
      }
    }
  }
  if (!(t_best < t_end)) return INFINITY;
  *parameters = (real2)(found_unresolved ? -(real)1 - (real)span_best : (real)span_best, w_best);
  return (t_best + map.y) / map.x;
}

// The outward normal in the half plane of the profile: to the right of its direction, which for a closed profile
// from bottom to top is away from the axis; the host's orientation turns it where the profile runs the other way
// (the solid of revolution has negative volume).
INLINE real2 bezier_profile_normal(global const float *curve, global const float *span, real w, real2 derivative) {
  real2 chord = (real2)(span[12], span[13]) + (real2)(span[14], span[15]);
  if (dot(derivative, chord) < (real)1e-4) derivative = bezier_tangent(span, w < 0 ? (real)-1 : (real)1, derivative);
  return normalize((real2)(derivative.y, -derivative.x)) * (real)curve[3];
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

  // What a spawned ray may be off by when it comes back to local space, brought to the world. The position is by
  // to_world and the intersection by to_local.
  global const float4 *in = shape->to_local, *out = shape->to_world;
  real3 world = fabs(surface->position);
  real3 local_error = (real3)(dot(fabs(convert_real3(in[0].xyz)), world) + fabs(in[0].w),
                              dot(fabs(convert_real3(in[1].xyz)), world) + fabs(in[1].w),
                              dot(fabs(convert_real3(in[2].xyz)), world) + fabs(in[2].w)) * STORED_GAMMA(8);
  local_error += BEZIER_ERROR * scale + STORED_GAMMA(2) * fabs(curve[2]);
  surface->error = max_component((real3)(dot(fabs(convert_real3(out[0].xyz)), local_error) + STORED_GAMMA(4) * fabs(out[0].w),
                                         dot(fabs(convert_real3(out[1].xyz)), local_error) + STORED_GAMMA(4) * fabs(out[1].w),
                                         dot(fabs(convert_real3(out[2].xyz)), local_error) + STORED_GAMMA(4) * fabs(out[2].w)));

  real2 n = bezier_profile_normal(curve, span, w, profile.zw);
  surface->geometric_normal = surface->shading_normal =
      normalize(transform_normal(shape->to_local, (real3)(n.x * radial.x, n.y, n.x * radial.y)));
  real angle = atan2(radial.y, radial.x) * (INV_PI * (real)0.5);
  angle = angle < 0 ? angle + 1 : angle;
  surface->uv = (real2)(angle < 1 ? angle : (real)0, mix((real)span[16], (real)span[17], (w + 1) * (real)0.5));
}

// World position and outward unit normal at angle 2 pi u and curve parameter v, and |dP/du x dP/dv|: the area of
// the world for a unit of (u, v).
INLINE void bezier_point(global const Shape *shape, global const float *curves, real u, real v, real3 *position,
                         real3 *normal, real *area_element) {
  global const float *curve = curves + shape->curve;
  global const float *span = bezier_spans(curve);
  for (uint left = (uint)curve[0]; left > 1u && v > span[17]; --left) span += CURVE_SPAN;
  real per_v = 2 / ((real)span[17] - (real)span[16]), scale = curve[1];
  real w = clamp((v - span[16]) * per_v - 1, (real)-1, (real)1);
  real4 profile = bezier_evaluate(span, w);
  real c, s = sincos(2 * PI * u, &c);

  real3 p = (real3)(profile.x * scale * c, profile.y * scale + curve[2], profile.x * scale * s);
  *position = transform_point(shape->to_world, p);
  real2 n = bezier_profile_normal(curve, span, w, profile.zw);
  *normal = normalize(transform_normal(shape->to_local, (real3)(n.x * c, n.y, n.x * s)));
  real3 by_u = (real3)(-s, 0, c) * (2 * PI * profile.x * scale);
  real3 by_v = (real3)(profile.z * c, profile.w, profile.z * s) * (per_v * scale);
  *area_element = length(cross(transform_vector(shape->to_world, by_u), transform_vector(shape->to_world, by_v)));
}
