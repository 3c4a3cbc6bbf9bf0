// Maps from uniform numbers to directions and points.
#include "prelude.cl"

// Two unit vectors that make a right-handed orthonormal frame with the unit vector n (Duff et al., "Building
// an Orthonormal Basis, Revisited", JCGT 2017); no branch, exact at n.z = -1.
INLINE void orthonormal_basis(real3 n, real3 *tangent, real3 *bitangent) {
  real sign = copysign((real)1, n.z);
  real a = -1 / (sign + n.z);
  real b = n.x * n.y * a;
  *tangent = (real3)(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  *bitangent = (real3)(b, sign + n.y * n.y * a, -n.y);
}

// Cosine and sine of x quarters of pi, -1 <= x <= 1. In float by the first terms of their series, which leave out less
// than 2e-9: what remains are two roundings.
INLINE real2 cos_sin_eighth(real x) {
#ifdef CAUSTICL_DOUBLE
  real c, s = sincos((PI / 4) * x, &c);
  return (real2)(c, s);
#else
  real x2 = x * x;
  real c = 3.59086045e-6f + x2 * -2.46113684e-8f, s = -3.65762042e-5f + x2 * 3.13361689e-7f;
  c = 1 + x2 * (-0.308425138f + x2 * (0.0158543442f + x2 * (-3.25991887e-4f + x2 * c)));
  s = x * (0.785398163f + x2 * (-0.0807455122f + x2 * (0.00249039457f + x2 * s)));
  return (real2)(c, s);
#endif
}

// Cosine and sine of the angle that is u turns, |u| <= 1.
INLINE real2 cos_sin_turn(real u) {
  real quarter = rint(4 * u);
  real2 p = cos_sin_eighth(8 * u - 2 * quarter);  // exact
  uint quadrant = (uint)(int)quarter & 3u;
  if (quadrant & 1u) p = (real2)(-p.y, p.x);
  return (quadrant & 2u) ? -p : p;
}

// A point of the unit disc with uniform density, by the concentric map (Shirley & Chiu 1997): neighbouring
// numbers give neighbouring points.
INLINE real2 disc_uniform(real2 u) {
  real2 p = 2 * u - 1;
  if (p.x == 0 && p.y == 0) return (real2)(0, 0);
  bool wide = fabs(p.x) > fabs(p.y);
  real radius = wide ? p.x : p.y;
  real2 point = radius * cos_sin_eighth(wide ? p.y / p.x : p.x / p.y);
  return wide ? point : point.yx;
}

// A unit direction about n with density cos / pi (Malley's method). Never below the horizon.
INLINE real3 hemisphere_cosine(real2 u, real3 n) {
  real2 d = disc_uniform(u);
  real z = sqrt(max((real)0, 1 - d.x * d.x - d.y * d.y));
  real3 tangent, bitangent;
  orthonormal_basis(n, &tangent, &bitangent);
  return normalize(d.x * tangent + d.y * bitangent + max(z, (real)1e-6f) * n);
}

// A unit vector with uniform density over the sphere.
INLINE real3 sphere_uniform(real2 u) {
  real z = 1 - 2 * u.x;
  real r = sqrt(max((real)0, 1 - z * z));
  return (real3)(r * cos_sin_turn(u.y), z);
}

// A unit direction within the cone about `axis` whose opening has 1 - cos = one_minus_cos, with uniform
// density 1 / (2 pi one_minus_cos). Taking 1 - cos rather than cos keeps narrow cones exact.
INLINE real3 cone_uniform(real2 u, real3 axis, real one_minus_cos) {
  real drop = u.x * one_minus_cos;
  real s = sqrt(max((real)0, drop * (2 - drop)));
  real2 around = s * cos_sin_turn(u.y);
  real3 tangent, bitangent;
  orthonormal_basis(axis, &tangent, &bitangent);
  return normalize(around.x * tangent + around.y * bitangent + (1 - drop) * axis);
}

// A uniform point of a triangle as barycentric weights of vertices 1 and 2.
INLINE real2 triangle_uniform(real2 u) {
  real root = sqrt(u.x);
  return (real2)(root * (1 - u.y), root * u.y);
}
