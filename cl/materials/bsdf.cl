// How a surface scatters: calls the functions of its material, by MATERIAL_TABLE.
//
// Two forms of sampling: bsdf_sample() branches to the one function of the material; bsdf_sample_smooth() computes all and
// selects, for loops over photons that the compiler turns into vector code (vector.cl).
#include "materials/diffuse.cl"
#include "materials/rough_lobe.cl"
#include "materials/texture.cl"

#define READ_COMMON_FIELDS(name, effect)
#define READ_OWN_FIELDS(name, effect) \
  if (HAS(effect)) name##_read(material, &bsdf);
#define READ_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) READ_##fields(name, effect)

// Puts the texture of a material, if it has one, in the place of its colour. Without a branch, for loops that are to be
// vectorised: there are textures where there is the effect.
INLINE void bsdf_texture_soa(global const Material *material, global const Texture *textures, global const half *texels,
                             real2 uv, Bsdf *bsdf) {
  uint number = material->color_texture;
  Texel texel = texture_lookup(textures + (max(number, 1u) - 1u), texels, uv);
  bool textured = number != 0;
  bsdf->color = choose3(textured, (real3)(texel.r, texel.g, texel.b), bsdf->color);
  bool diffuse = textured && (material->flags & MATERIAL_ALPHA_DIFFUSE) != 0 && texel.a > 0;
  bsdf->kind = diffuse ? MATERIAL_DIFFUSE : bsdf->kind;
}

// A material of one colour.
INLINE Bsdf bsdf_untextured(global const Material *material) {
  global const float *color = (global const float *)&material->color;
  Bsdf bsdf = {material->kind, (real3)(color[0], color[1], color[2]), color[3], 0,
               (real3)(0, 0, 0), (real3)(0, 0, 0), 0, false};
  if (HAS(EFFECT_ROUGH)) bsdf.alpha = lobe_alpha(material->alpha, transmits(bsdf.kind) ? bsdf.ior : 0);
  MATERIAL_TABLE(READ_ROW, )
  return bsdf;
}

INLINE Bsdf bsdf_at(global const Material *material, global const Texture *textures, global const half *texels,
                    real2 uv) {
  Bsdf bsdf = bsdf_untextured(material);
  if (HAS(EFFECT_TEXTURES) && material->color_texture != 0) bsdf_texture_soa(material, textures, texels, uv, &bsdf);
  return bsdf;
}

// A material of one colour that is Lambert's.
INLINE Bsdf lambert_untextured(global const Material *material) {
  global const float *color = (global const float *)&material->color;
  Bsdf bsdf = {MATERIAL_DIFFUSE, (real3)(color[0], color[1], color[2]), 1, 0,
               (real3)(0, 0, 0), (real3)(0, 0, 0), 0, false};
  return bsdf;
}

// Photons are kept whatever the texel that they land on reflects: the points around it may reflect more. Only where all is
// black, as on most emitters, are they of no use.
INLINE bool is_black(const Bsdf *bsdf, global const Material *material) {
  return material->color_texture == 0 && !(max_component(bsdf->color) > 0);
}

// Whether photons that land there are stored.
INLINE bool keeps_photons(const Bsdf *bsdf, global const Material *material) {
  return stores_photons(bsdf->kind) && !is_black(bsdf, material);
}

#define CHOOSE_ONE_LOBE(NAME, name, effect)
#define CHOOSE_LAYERED(NAME, name, effect) \
  if (IS_KIND(bsdf->kind, NAME, effect)) name##_choose_lobe(bsdf, wi, n, random);
#define CHOOSE_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  CHOOSE_##layers(NAME, name, effect)

#define BASE_OF_ONE_LOBE(NAME, name, effect)
#define BASE_OF_LAYERED(NAME, name, effect) \
  if (IS_KIND(bsdf->kind, NAME, effect)) return name##_base_transmittance(bsdf, cosine);
#define BASE_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  BASE_OF_##layers(NAME, name, effect)

// How much of the light that arrives at this cosine comes to the base of a layered material.
INLINE real base_transmittance(const Bsdf *bsdf, real cosine) {
  MATERIAL_TABLE(BASE_OF_ROW, )
  return 1;
}

// Makes a layered material one of its lobes, chosen by `random`.
INLINE void choose_lobe(Bsdf *bsdf, real3 wi, real3 n, real random) {
  MATERIAL_TABLE(CHOOSE_ROW, )
}

#define REFLECTANCE_OF_LAMBERT(NAME, name, effect)
#define REFLECTANCE_OF_SCATTERS(NAME, name, effect)
#define REFLECTANCE_OF_REFLECTS(NAME, name, effect)
#define REFLECTANCE_OF_TRANSMITS(NAME, name, effect) \
  if (IS_KIND(bsdf->kind, NAME, effect)) return name##_reflectance(bsdf, surface, wi, n);
#define REFLECTANCE_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  REFLECTANCE_OF_##family(NAME, name, effect)

// The probability with which a material that transmits, where smooth, reflects a path.
INLINE real lobe_reflectance(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n) {
  MATERIAL_TABLE(REFLECTANCE_OF_ROW, )
  return 1;
}

#define SELECT_LAMBERT(NAME, name, effect)
#define SELECT_SCATTERS(NAME, name, effect)
#define SELECT_REFLECTS(NAME, name, effect)                                                               \
  if (HAS(effect))                                                                                        \
    sample.weight =                                                                                       \
        choose3(bsdf->kind == MATERIAL_##NAME, name##_tint(bsdf, -dot3(wi, n), false), sample.weight);
#define SELECT_TRANSMITS(NAME, name, effect)                                                          \
  if (HAS(effect)) {                                                                                  \
    bool chosen = bsdf->kind == MATERIAL_##NAME;                                                      \
    BsdfSample own = name##_sample(bsdf, surface, wi, n, random, radiance);                           \
    x = chosen ? own.direction.x : x, y = chosen ? own.direction.y : y, z = chosen ? own.direction.z : z; \
    sample.weight = choose3(chosen, own.weight, sample.weight);                                       \
  }
#define SELECT_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  SELECT_##family(NAME, name, effect)

// What bsdf_sample() draws where every material is diffuse, a mirror or smooth and transmitting. What the branches hand on
// are scalars: see vector.cl.
INLINE BsdfSample bsdf_sample_smooth(const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n, real4 random,
                                     bool radiance) {
  BsdfSample sample = {wi, bsdf->color, 0};
  bool diffuse = is_diffuse(bsdf->kind);
  BsdfSample lambert = diffuse_sample(bsdf, surface, wi, n, random);
  real x = lambert.direction.x, y = lambert.direction.y, z = lambert.direction.z;
  if (HAS(EFFECTS_OF_MATERIALS(REFLECTS | TRANSMITS)) && !diffuse) {
    real3 wo = mirror_direction(surface, wi, n);
    x = wo.x, y = wo.y, z = wo.z;
  }
  MATERIAL_TABLE(SELECT_ROW, )
  sample.direction = (real3)(x, y, z);
  sample.weight = choose3(diffuse, lambert.weight, sample.weight);
  sample.pdf = diffuse ? lambert.pdf : 0;
  return sample;
}

#define SAMPLE_LAMBERT(NAME, name, effect)
#define SAMPLE_SCATTERS(NAME, name, effect)
#define SAMPLE_REFLECTS(NAME, name, effect)                                                            \
  if (IS_KIND(bsdf->kind, NAME, effect)) {                                                             \
    BsdfSample sample = {mirror_direction(surface, wi, n), name##_tint(bsdf, -dot3(wi, n), false), 0}; \
    return sample;                                                                                     \
  }
#define SAMPLE_TRANSMITS(NAME, name, effect) \
  if (IS_KIND(bsdf->kind, NAME, effect)) return name##_sample(bsdf, surface, wi, n, random, radiance);
#define SAMPLE_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) \
  SAMPLE_##family(NAME, name, effect)

// Draws where a path that arrives along `wi` goes on. `radiance` is true on camera paths.
INLINE BsdfSample bsdf_sample(const Bsdf *bsdf, const Surface *surface, real3 wi, real4 random, bool radiance) {
  real3 n = facing_normal(surface, wi);
  if (bsdf_is_rough(bsdf)) return rough_sample(bsdf, surface, wi, n, random, radiance);
  MATERIAL_TABLE(SAMPLE_ROW, )
  return diffuse_sample(bsdf, surface, wi, n, random);
}

// Emitted radiance towards where `direction` came from.
INLINE real3 emission_at(global const Material *material, const Surface *surface, real3 direction) {
  global const float *emission = (global const float *)&material->emission;
  bool front = dot3(surface->geometric_normal, direction) < 0;
  bool emits = front || (material->flags & MATERIAL_TWO_SIDED) != 0;
  return choose3(emits, (real3)(emission[0], emission[1], emission[2]), (real3)(0, 0, 0));
}
