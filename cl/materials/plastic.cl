// Coated diffuse: a dielectric boundary over a Lambert base.
#include "materials/fresnel.cl"
#include "materials/scattering.cl"

// `own`: diffuse reflectance of the boundary from inside.
INLINE void plastic_read(global const Material *material, Bsdf *bsdf) { bsdf->own = material->eta.w; }

// What the boundary reflects, where `cosine` is of incidence.
INLINE real3 plastic_tint(const Bsdf *bsdf, real cosine, bool refracts) {
  return bsdf->color * (1 - fresnel_transmittance(cosine, bsdf->ior));
}

// How much of the light that arrives at this cosine the boundary lets in to the base, which stores photons.
INLINE real plastic_base_transmittance(const Bsdf *bsdf, real cosine) { return fresnel_transmittance(cosine, bsdf->ior); }

// Makes the material its boundary or its base, chosen by `random`, with the weight divided by the probability. Light goes
// back and forth between the two, so that the base reflects c T(in) T(out) / (pi eta^2 (1 - c inner)), T the boundary's
// transmittance (Ashikhmin & Shirley 2000, with the sum over inner reflections of Kubelka 1942).
INLINE void plastic_choose_lobe(Bsdf *bsdf, real3 wi, real3 n, real random) {
  real transmittance = fresnel_transmittance(-dot3(wi, n), bsdf->ior);
  real3 base = bsdf->color * transmittance / (bsdf->ior * bsdf->ior * (1 - bsdf->color * bsdf->own));
  real reflectance = 1 - transmittance, sum = reflectance + max_component(base);
  real specular_pmf = sum > 0 ? reflectance / sum : 1;
  if (random < specular_pmf) {
    bsdf->color = (real3)(1, 1, 1) / specular_pmf;
  } else {
    bsdf->kind = MATERIAL_DIFFUSE;
    bsdf->coated = true;
    bsdf->color = base / (1 - specular_pmf);
  }
}
