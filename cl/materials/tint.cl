// What a lobe is multiplied by.
#include "materials/all_materials.cl"

#define TINT_OF_LAMBERT(NAME, name, effect)
#define TINT_OF_SCATTERS(NAME, name, effect)
#define TINT_OF_REFLECTS(NAME, name, effect) \
  if (IS_KIND(bsdf->kind, NAME, effect)) return name##_tint(bsdf, cosine, refracts);
#define TINT_OF_TRANSMITS(NAME, name, effect) TINT_OF_REFLECTS(NAME, name, effect)
#define TINT_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  TINT_OF_##family(NAME, name, effect)

// `cosine` is of incidence; `refracts` tells the lobes of a material that transmits apart.
INLINE real3 lobe_tint(const Bsdf *bsdf, real cosine, bool refracts) {
  MATERIAL_TABLE(TINT_OF_ROW, )
  return bsdf->color;
}
