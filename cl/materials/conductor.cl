// A conductor: a mirror that reflects by Fresnel's equations for a complex index.
#include "materials/fresnel.cl"
#include "materials/scattering.cl"

INLINE void conductor_read(global const Material *material, Bsdf *bsdf) {
  bsdf->eta = convert_real3(material->eta.xyz);
  bsdf->k = convert_real3(material->k.xyz);
}

// What reflection is multiplied by, where `cosine` is of incidence.
INLINE real3 conductor_tint(const Bsdf *bsdf, real cosine, bool refracts) {
  return (real3)(fresnel_conductor(cosine, bsdf->eta.x, bsdf->k.x), fresnel_conductor(cosine, bsdf->eta.y, bsdf->k.y),
                 fresnel_conductor(cosine, bsdf->eta.z, bsdf->k.z));
}
