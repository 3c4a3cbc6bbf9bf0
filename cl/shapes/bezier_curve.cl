// A Bezier curve revolved about the local y axis: its profile and points on its surface.
//
// Layout at curves[shape->curve], in unit space, where the profile is scaled into x in [0, 1], y in [-1, 1]:
//   0 number of spans; 1 scale; 2 centre: local (x, y) = scale (x, y) of unit space + (0, centre);
//   3 orientation of the normal
//   8 for each group of eight spans: y_low[8], y_high[8], x_low^2[8], x_high^2[8], padded
//   then for each span: (x, y) coefficients of w^0 ... w^5, w in [-1, 1]; unit tangents at w = -1 and 1; the
//   curve parameters at w = -1 and 1; for w = -1 and 1 whether the surface goes on smoothly there; padding to 24
#include "shared/types.h"
#include "sampling/warp.cl"

#define CURVE_HEADER 8u
#define CURVE_GROUP 32u
#define CURVE_SPAN 24u

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

// The outward normal in the half plane of the profile: to the right of its direction, which for a closed profile
// from bottom to top is away from the axis; the host's orientation turns it where the profile runs the other way
// (the solid of revolution has negative volume).
INLINE real2 bezier_profile_normal(global const float *curve, global const float *span, real w, real2 derivative) {
  real2 chord = (real2)(span[12], span[13]) + (real2)(span[14], span[15]);
  if (dot(derivative, chord) < (real)1e-4) derivative = bezier_tangent(span, w < 0 ? (real)-1 : (real)1, derivative);
  return normalize((real2)(derivative.y, -derivative.x)) * (real)curve[3];
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
  real2 around = cos_sin_turn(u);
  real c = around.x, s = around.y;

  real3 p = (real3)(profile.x * scale * c, profile.y * scale + curve[2], profile.x * scale * s);
  *position = transform_point(shape->to_world, p);
  real2 n = bezier_profile_normal(curve, span, w, profile.zw);
  *normal = normalize(transform_normal(shape->to_local, (real3)(n.x * c, n.y, n.x * s)));
  real3 by_u = (real3)(-s, 0, c) * (2 * PI * profile.x * scale);
  real3 by_v = (real3)(profile.z * c, profile.w, profile.z * s) * (per_v * scale);
  *area_element = length(cross(transform_vector(shape->to_world, by_u), transform_vector(shape->to_world, by_v)));
}
