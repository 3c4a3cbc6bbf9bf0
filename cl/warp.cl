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

// A point of the unit disc with uniform density, by the concentric map (Shirley & Chiu 1997): neighbouring
// numbers give neighbouring points.
INLINE real2 disc_uniform(real2 u) {
  real2 p = 2 * u - 1;
  if (p.x == 0 && p.y == 0) return (real2)(0, 0);
  bool wide = fabs(p.x) > fabs(p.y);
  real radius = wide ? p.x : p.y;
  real angle = wide ? (PI / 4) * (p.y / p.x) : (PI / 2) - (PI / 4) * (p.x / p.y);
  return radius * (real2)(cos(angle), sin(angle));
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
  real angle = 2 * PI * u.y;
  return (real3)(r * cos(angle), r * sin(angle), z);
}

// A unit direction within the cone about `axis` whose opening has 1 - cos = one_minus_cos, with uniform
// density 1 / (2 pi one_minus_cos). Taking 1 - cos rather than cos keeps narrow cones exact.
INLINE real3 cone_uniform(real2 u, real3 axis, real one_minus_cos) {
  real drop = u.x * one_minus_cos;
  real s = sqrt(max((real)0, drop * (2 - drop)));
  real angle = 2 * PI * u.y;
  real3 tangent, bitangent;
  orthonormal_basis(axis, &tangent, &bitangent);
  return normalize(s * cos(angle) * tangent + s * sin(angle) * bitangent + (1 - drop) * axis);
}

// A uniform point of a triangle as barycentric weights of vertices 1 and 2.
INLINE real2 triangle_uniform(real2 u) {
  real root = sqrt(u.x);
  return (real2)(root * (1 - u.y), root * u.y);
}
