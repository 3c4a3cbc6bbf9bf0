// Diffuse materials by another law than Lambert's: their BSDF over that of a Lambert surface of the same colour. By this
// factor the surface is sampled, lit, and weighs the photons around it.
#include "materials/all_materials.cl"

#define OVER_LAMBERT_OF_LAMBERT(NAME, name, effect)
#define OVER_LAMBERT_OF_REFLECTS(NAME, name, effect)
#define OVER_LAMBERT_OF_TRANSMITS(NAME, name, effect)
#define OVER_LAMBERT_OF_SCATTERS(NAME, name, effect) \
  if (IS_KIND(bsdf->kind, NAME, effect)) return name##_over_lambert(bsdf, wi, wo, n);
#define OVER_LAMBERT_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  OVER_LAMBERT_OF_##family(NAME, name, effect)

// wi arrives and wo leaves on the side of n. Reciprocal: the same for -wo and -wi.
INLINE real3 over_lambert(const Bsdf *bsdf, real3 wi, real3 wo, real3 n) {
  MATERIAL_TABLE(OVER_LAMBERT_OF_ROW, )
  return (real3)(1, 1, 1);
}
