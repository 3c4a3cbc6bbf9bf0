// The materials: tables that the host and the kernels read. The physics of each is in cl/materials/NAME.cl.
#pragma once

// Families. The functions that a material's file holds follow from its family, its layers and its fields.
#define LAMBERT 1u    // diffuse, at which camera paths of SPPM end; by Lambert's law, so that it needs no function
#define REFLECTS 2u   // a lobe about the mirrored direction: name_tint()
#define TRANSMITS 4u  // and one through the surface: name_sample(), name_reflectance(), name_tint(), name_ways(): see glass.cl
#define SCATTERS 64u  // diffuse by another law: name_over_lambert(), see over_lambert.cl
#define DIFFUSE_FAMILIES (LAMBERT | SCATTERS)

// Layers.
#define ONE_LOBE 0u
#define LAYERED 8u  // several: name_choose_lobe(), name_base_transmittance(): see plastic.cl

// Fields of its record: COMMON_FIELDS, or OWN_FIELDS beside them: name_read() and, on the host, write_name().

// What else the renderer asks about a material.
#define STORES_PHOTONS 16u  // photons that land there are kept
#define BOUNDS_BODY 32u     // it encloses a dielectric: paths keep the medium that they are in

// Keys of scene files beside those of every material: host/format/keys_material.cpp.
#define KEY_COLOR 1u
#define KEY_ETA_K 2u
#define KEY_IOR 4u
#define KEY_CAUCHY 8u
#define KEY_ABSORPTION 16u
#define KEY_ROUGHNESS 32u
#define KEY_PRIORITY 64u
#define KEY_DIFFUSE_ROUGHNESS 128u
#define KEYS_OF_GLASS (KEY_COLOR | KEY_IOR | KEY_CAUCHY | KEY_ABSORPTION | KEY_ROUGHNESS | KEY_PRIORITY)

// Columns: MATERIAL_NAME is its number in records; that number; its name in scene files and of its file, enumerator and
// functions; its effect, 0u for LAMBERT, which every program knows; family; layers; fields; what else; keys; what it is.
// `ROW(x, ...)` is made of each row.
#define MATERIAL_TABLE(ROW, x) \
  ROW(x, DIFFUSE,   0, diffuse,   0u,               LAMBERT,   ONE_LOBE, COMMON_FIELDS, STORES_PHOTONS, \
      KEY_COLOR, "Lambert surface") \
  ROW(x, MIRROR,    1, mirror,    EFFECT_MIRROR,    REFLECTS,  ONE_LOBE, COMMON_FIELDS, 0u,             \
      KEY_COLOR, "perfect mirror") \
  ROW(x, GLASS,     2, glass,     EFFECT_GLASS,     TRANSMITS, ONE_LOBE, COMMON_FIELDS, BOUNDS_BODY,    \
      KEYS_OF_GLASS, "dielectric, smooth or rough, that may absorb and disperse") \
  ROW(x, CONDUCTOR, 3, conductor, EFFECT_CONDUCTOR, REFLECTS,  ONE_LOBE, OWN_FIELDS,    0u,             \
      KEY_ETA_K | KEY_ROUGHNESS, "metal, smooth or rough") \
  ROW(x, PLASTIC,   4, plastic,   EFFECT_PLASTIC,   REFLECTS,  LAYERED,  OWN_FIELDS,    STORES_PHOTONS, \
      KEY_COLOR | KEY_IOR | KEY_ROUGHNESS, "coated diffuse: a dielectric boundary, smooth or rough, over a Lambert base") \
  ROW(x, THIN_GLASS, 5, thin_glass, EFFECT_THIN_GLASS, TRANSMITS, ONE_LOBE, COMMON_FIELDS, 0u, \
      KEY_COLOR | KEY_IOR, "pane of glass without thickness: two faces and all reflections between them") \
  ROW(x, OREN_NAYAR, 6, oren_nayar, EFFECT_OREN_NAYAR, SCATTERS, ONE_LOBE, OWN_FIELDS, STORES_PHOTONS, \
      KEY_COLOR | KEY_DIFFUSE_ROUGHNESS, "rough diffuse: plaster, clay, cloth, the moon")

// Their rows of EFFECT_TABLE: see effects.h for the columns.
#define MATERIAL_EFFECTS(ROW, x) \
  ROW(x, MIRROR,    6,  "mirror",    IN_PATHS, BATCHED,       NO_GEOMETRY, "mirrors") \
  ROW(x, GLASS,     7,  "glass",     IN_PATHS, BATCHED,       NO_GEOMETRY, "glass") \
  ROW(x, CONDUCTOR, 11, "conductor", IN_PATHS, SCALAR_EVENTS, NO_GEOMETRY, "conductors") \
  ROW(x, PLASTIC,   12, "plastic",   IN_PATHS, SCALAR_EVENTS, NO_GEOMETRY, "plastic") \
  ROW(x, THIN_GLASS, 26, "thin_glass", IN_PATHS, SCALAR_EVENTS, NO_GEOMETRY, "thin glass") \
  ROW(x, OREN_NAYAR, 29, "oren_nayar", IN_PATHS | IN_GATHER, SCALAR_PATHS, NO_GEOMETRY, "rough diffuse surfaces")

#ifdef __cplusplus
enum MaterialKind : unsigned {
#else
enum MaterialKind {
#endif
#define MATERIAL_NUMBER(x, NAME, number, ...) MATERIAL_##NAME = number,
  MATERIAL_TABLE(MATERIAL_NUMBER, )
#undef MATERIAL_NUMBER
};
