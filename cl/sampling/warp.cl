// Maps from uniform numbers to directions and points.
#include "core/vector.cl"

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
  real x = (quadrant & 1u) ? -p.y : p.x, y = (quadrant & 1u) ? p.x : p.y;
  return (real2)((quadrant & 2u) ? -x : x, (quadrant & 2u) ? -y : y);
}

// A point of the unit disc with uniform density, by the concentric map (Shirley & Chiu 1997): neighbouring
// numbers give neighbouring points.
INLINE real2 disc_uniform(real2 u) {
  real x = 2 * u.x - 1, y = 2 * u.y - 1;
  bool wide = fabs(x) > fabs(y);
  real radius = wide ? x : y, other = wide ? y : x;
  real2 p = cos_sin_eighth(radius == 0 ? 0 : other / radius);
  real larger = radius * p.x, smaller = radius * p.y;
  return (real2)(wide ? larger : smaller, wide ? smaller : larger);
}

// A unit direction about n with density cos / pi (Malley's method). Never below the horizon.
INLINE real3 hemisphere_cosine_by(real u, real v, real3 n) {
  real2 d = disc_uniform((real2)(u, v));
  real z = sqrt(max((real)0, 1 - d.x * d.x - d.y * d.y));
  real3 tangent, bitangent;
  orthonormal_basis(n, &tangent, &bitangent);
  return unit3(add3(add3(scaled3(d.x, tangent), scaled3(d.y, bitangent)), scaled3(max(z, (real)1e-6f), n)));
}
INLINE real3 hemisphere_cosine(real2 u, real3 n) { return hemisphere_cosine_by(u.x, u.y, n); }

// A unit vector with uniform density over the sphere.
INLINE real3 sphere_uniform(real2 u) {
  real z = 1 - 2 * u.x;
  real r = sqrt(max((real)0, 1 - z * z));
  real2 around = cos_sin_turn(u.y);
  return (real3)(r * around.x, r * around.y, z);
}

// A unit direction within the cone about `axis` whose opening has 1 - cos = one_minus_cos, with uniform
// density 1 / (2 pi one_minus_cos). Taking 1 - cos rather than cos keeps narrow cones exact.
INLINE real3 cone_uniform_by(real u, real v, real3 axis, real one_minus_cos) {
  real drop = u * one_minus_cos;
  real s = sqrt(max((real)0, drop * (2 - drop)));
  real2 around = cos_sin_turn(v);
  real3 tangent, bitangent;
  orthonormal_basis(axis, &tangent, &bitangent);
  return unit3(add3(add3(scaled3(s * around.x, tangent), scaled3(s * around.y, bitangent)), scaled3(1 - drop, axis)));
}
INLINE real3 cone_uniform(real2 u, real3 axis, real one_minus_cos) {
  return cone_uniform_by(u.x, u.y, axis, one_minus_cos);
}

// A uniform point of a triangle as barycentric weights of vertices 1 and 2.
INLINE real2 triangle_uniform(real2 u) {
  real root = sqrt(u.x);
  return (real2)(root * (1 - u.y), root * u.y);
}
