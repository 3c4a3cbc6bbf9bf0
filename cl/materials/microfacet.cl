// Microfacets: GGX with the height-correlated Smith shadowing, sampled by visible normals. All directions are in
// the local frame, z the normal on the side that the path arrives from; v goes back to where it came from.
#include "sampling/warp.cl"

// A lobe that is narrower than this, in radians, is treated as perfectly specular: a pixel is wider, while half
// vectors of float directions no longer resolve it.
#define SPECULAR_WIDTH ((real)1e-4)

// The alpha that a boundary scatters with, 0 for a perfectly specular one. Refraction bends a microfacet's tilt by
// |eta - 1|, so that between nearly equal indices a wide distribution makes a narrow lobe: `ior` inside over
// outside, 0 where nothing is refracted.
INLINE real lobe_alpha(real alpha, real ior) {
  real bend = ior > 0 ? fabs(ior - 1) / fmax(ior, (real)1) : 1;
  return alpha * bend >= SPECULAR_WIDTH ? alpha : 0;
}

// Length of v in the space where the surface has alpha = 1: Smith's Lambda is (stretch / z - 1) / 2.
INLINE real ggx_stretch(real3 v, real alpha) {
  return sqrt(alpha * alpha * (v.x * v.x + v.y * v.y) + v.z * v.z);
}

// Density of the unit normals h per projected area (Walter et al. 2007, equation 33). The tangent of h enters by
// its own components: cos^2 (alpha^2 - 1) + 1 cancels all digits of a narrow lobe.
INLINE real ggx_distribution(real3 h, real alpha) {
  real3 s = (real3)(h.x / alpha, h.y / alpha, h.z);
  real square = dot(s, s);
  return INV_PI / (alpha * alpha * square * square);
}

// Density of the normals h that are visible from v (Heitz, "Sampling the GGX Distribution of Visible Normals",
// JCGT 2018, equation 3), divided by v.h: G1 / v.z in a form that stays finite at grazing incidence.
INLINE real ggx_visible_density(real3 v, real3 h, real alpha) {
  return 2 * ggx_distribution(h, alpha) / (v.z + ggx_stretch(v, alpha));
}

// A normal with that density: a uniform point of a spherical cap plus v, where alpha = 1 (Dupuy & Benyoub,
// "Sampling Visible GGX Normals with Spherical Caps", 2023). Never below the horizon.
INLINE real3 ggx_visible_normal(real3 v, real alpha, real2 u) {
  real3 s = normalize((real3)(alpha * v.x, alpha * v.y, v.z));
  // The cap's height below the pole, rather than its z, keeps narrow caps exact.
  real drop = u.y * (1 + s.z);
  real r = sqrt(max((real)0, drop * (2 - drop)));
  real3 h = (real3)(s.xy + r * cos_sin_turn(u.x), (1 - u.y) * (1 + s.z));
  return normalize((real3)(alpha * h.x, alpha * h.y, h.z));
}

// Masking and shadowing given that v sees the microfacet, G2 / G1 (Heitz 2014, equation 99): what a path keeps
// that was sampled by visible normals. In [0, 1].
INLINE real ggx_shadowing(real3 v, real3 wo, real alpha) {
  real z = fabs(wo.z), stretch = ggx_stretch(v, alpha);
  real sum = z * stretch + v.z * ggx_stretch(wo, alpha);
  return sum > 0 ? z * (v.z + stretch) / sum : 0;
}

// Solid angle of microfacet normals over that of the directions they refract to (Walter et al. 2007, equation 17),
// times cosine = v.h; cosine_t that of refraction, eta the index beyond over the one before. Snell's law turns the
// square of cosine - eta cosine_t, a difference of nearly equal numbers for eta near 1, into a quotient.
INLINE real refraction_jacobian(real cosine, real cosine_t, real eta) {
  real inverse = (cosine + eta * cosine_t) / ((eta - 1) * (eta + 1));
  return eta * eta * cosine * cosine_t * inverse * inverse;
}

// The microfacet normal that turns v into `wo`, which lies below z = 0 where it is refracted; toward +z.
INLINE real3 microfacet_normal(real3 v, real3 wo, real eta) {
  real3 h = wo.z > 0 ? v + wo : v + eta * wo;
  real square = dot(h, h);
  if (!(square > 0)) return (real3)(0, 0, 1);
  return h * ((h.z < 0 ? -1 : 1) / sqrt(square));
}
