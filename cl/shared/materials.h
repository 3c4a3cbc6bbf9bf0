// The materials: one table that the host and the kernels read. The physics of each is in cl/materials/NAME.cl.
#pragma once

// Families. A program finds the functions that a material's file has to hold by its family.
#define LAMBERT 1u    // the diffuse surface, at which camera paths end
#define REFLECTS 2u   // a lobe about the mirrored direction: name_tint() is what reflection is multiplied by
#define TRANSMITS 4u  // and one through the surface: name_sample(), name_ways(), name_reflectance(), see glass.cl

// Layers.
#define ONE_LOBE 0u
#define LAYERED 8u  // name_choose_lobe() makes it one of its lobes; name_base_transmittance(): see plastic.cl

// Fields of its record: COMMON_FIELDS, or OWN_FIELDS beside them, which name_read() reads.

// What else the renderer asks about a material.
#define STORES_PHOTONS 16u  // photons that land there are kept
#define BOUNDS_BODY 32u     // it encloses a dielectric: paths keep the medium that they are in

// Columns: MATERIAL_NAME is its number in records; that number; the name of the host's enumerator and of the file, and
// prefix of its functions; the effect of EFFECT_TABLE, 0u if every program knows the material; family; layers; fields;
// what else.
// `ROW(x, ...)` is made of each row.
#define MATERIAL_TABLE(ROW, x) \
  ROW(x, DIFFUSE,   0, diffuse,   0u,               LAMBERT,   ONE_LOBE, COMMON_FIELDS, STORES_PHOTONS) \
  ROW(x, MIRROR,    1, mirror,    EFFECT_MIRROR,    REFLECTS,  ONE_LOBE, COMMON_FIELDS, 0u) \
  ROW(x, GLASS,     2, glass,     EFFECT_GLASS,     TRANSMITS, ONE_LOBE, COMMON_FIELDS, BOUNDS_BODY) \
  ROW(x, CONDUCTOR, 3, conductor, EFFECT_CONDUCTOR, REFLECTS,  ONE_LOBE, OWN_FIELDS,    0u) \
  ROW(x, PLASTIC,   4, plastic,   EFFECT_PLASTIC,   REFLECTS,  LAYERED,  OWN_FIELDS,    STORES_PHOTONS)

#ifdef __cplusplus
enum MaterialKind : unsigned {
#else
enum MaterialKind {
#endif
#define MATERIAL_NUMBER(x, NAME, number, name, effect, family, layers, fields, properties) MATERIAL_##NAME = number,
  MATERIAL_TABLE(MATERIAL_NUMBER, )
#undef MATERIAL_NUMBER
};
