// Rough diffuse: V-shaped facets that are Lambert surfaces (Oren & Nayar, "Generalization of Lambert's Reflectance Model",
// SIGGRAPH 1994), in the energy-preserving form EON of Portsmouth, Kutz & Hill, "EON: A Practical Energy-Preserving Rough
// Diffuse BRDF", JCGT 14 (1), 2025: Fujii's single scattering, and between facets as much as a white surface would lose.
#include "materials/scattering.cl"

INLINE void oren_nayar_read(global const Material *material, Bsdf *bsdf) { bsdf->own = material->eta.w; }

// A white surface of roughness r reflects (1 + r kept) / (1 + r OREN_NAYAR_LOST) at the first facet: the paper's G / pi.
INLINE real oren_nayar_kept(real cosine) {
  real sine = sqrt(fmax(1 - cosine * cosine, (real)0));
  // (sine / cosine) (1 - sine^3) without cancellation at grazing cosines.
  real slope = sine * cosine * (1 + sine + sine * sine) / (1 + sine);
  real angle = atan2(sine, cosine);
  return (sine * (angle - sine * cosine) + (real)(2.0 / 3) * (slope - sine)) * INV_PI;
}
#define OREN_NAYAR_LOST ((real)0.28779340921)  // 1/2 - 2 / (3 pi), what is kept at grazing cosines: there nothing is lost
#define OREN_NAYAR_MEAN ((real)0.07248821246)  // 2/3 - 28 / (15 pi), what is kept of even light

// `own` is the roughness.
INLINE real3 oren_nayar_over_lambert(const Bsdf *bsdf, real3 wi, real3 wo, real3 n) {
  real r = bsdf->own, in = clamp(-dot3(wi, n), (real)0, (real)1), out = clamp(dot3(wo, n), (real)0, (real)1);
  real scale = 1 / (1 + OREN_NAYAR_LOST * r);
  // Facets that face both directions, or neither.
  real aligned = -dot3(wi, wo) - in * out;
  real single = 1 + r * (aligned > 0 ? aligned / fmax(fmax(in, out), GRAZING_COSINE) : aligned);
  real mean = scale * (1 + OREN_NAYAR_MEAN * r);
  real several = r * (OREN_NAYAR_LOST - oren_nayar_kept(in)) * (OREN_NAYAR_LOST - oren_nayar_kept(out)) /
                 (OREN_NAYAR_LOST - OREN_NAYAR_MEAN);
  return scale * (single + several * mean * bsdf->color / (1 - bsdf->color * (1 - mean)));
}
