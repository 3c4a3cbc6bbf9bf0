// The lights: tables that the host and the kernels read. The physics of each is in cl/lights/NAME.cl.
#pragma once

// Families. The functions that a light's file holds follow from it:
//   name_sample()    what arrives at a point: see light_sample.cl
//   name_emit()      a photon that starts there
//   name_radiance()  what a ray finds that leaves the scene, and the density with which name_sample() draws it
//   name_emission(), name_pdf()  the same of a ray that meets the light's body
#define DELTA 1u       // no ray meets it by chance: name_sample(), name_emit()
#define BACKGROUND 2u  // around the scene, one at most: name_sample(), name_emit(), name_radiance()
#define SURFACE 4u     // an object has its radiance: name_sample(), name_emit(), name_emission(), name_pdf()
#define EMISSIVE 8u    // another way to write an object whose material emits: no functions, see area_light.cl

// What else the renderer asks about a light.
#define BEYOND_SCENE 16u  // it has no place: its photons start around the scene
#define ON_DISK 32u       // the object that it is or lies on
#define ON_RECTANGLE 64u

// Keys of scene files: host/format/keys_light.cpp.
#define POSITION_KEY 1u
#define TARGET_KEY 2u
#define CONE_KEY 4u
#define INTENSITY_KEY 8u
#define DIRECTION_KEY 16u
#define IRRADIANCE_KEY 32u
#define NORMAL_KEY 64u
#define RADIUS_KEY 128u
#define RADIANCE_KEY 256u
#define MAP_KEY 512u
#define IMAGE_KEY 1024u
#define UP_KEY 2048u
#define SIZE_KEY 4096u
#define TWO_SIDED_KEY 8192u

// Columns: LIGHT_NAME is its number in records; that number, 16 to 31, since those below are of surfaces; its name in
// scene files and of its file, enumerator and functions; its effect, 0u where those of its body suffice; family; what else;
// keys; its name in text; what it is. `ROW(x, ...)` is made of each row.
#define LIGHT_TABLE(ROW, x) \
  ROW(x, POINT,       16, point,       EFFECT_DELTA_LIGHTS, DELTA,      0u,           \
      POSITION_KEY | INTENSITY_KEY, "point light", "light that shines from a point") \
  ROW(x, SPOT,        17, spot,        EFFECT_DELTA_LIGHTS, DELTA,      0u,           \
      POSITION_KEY | TARGET_KEY | CONE_KEY | INTENSITY_KEY, \
      "spot light", "light that shines from a point into a cone") \
  ROW(x, DIRECTIONAL, 18, directional, EFFECT_DELTA_LIGHTS, DELTA,      BEYOND_SCENE, \
      DIRECTION_KEY | IRRADIANCE_KEY, "directional light", "light from infinitely far, as the sun's") \
  ROW(x, DISK,        19, disk,        0u,                  EMISSIVE,   ON_DISK,      \
      POSITION_KEY | NORMAL_KEY | RADIUS_KEY | RADIANCE_KEY, \
      "disk light", "black disk that emits; the camera sees it") \
  ROW(x, RECTANGLE,   21, rectangle,   EFFECT_IMAGE_LIGHTS, SURFACE,    ON_RECTANGLE, \
      POSITION_KEY | NORMAL_KEY | UP_KEY | SIZE_KEY | IMAGE_KEY | TWO_SIDED_KEY, \
      "rectangle light", "black rectangle that emits one radiance or an image; the camera sees it") \
  ROW(x, ENVIRONMENT, 20, environment, EFFECT_ENVIRONMENT,  BACKGROUND, BEYOND_SCENE, \
      MAP_KEY, "environment", "light from all directions; one at most")

// Their rows of EFFECT_TABLE: see effects.h for the columns.
#define LIGHT_EFFECTS(ROW, x) \
  ROW(x, ENVIRONMENT,    13, "environment",    IN_PATHS,              SCALAR_LIGHTS,            NO_GEOMETRY,     "light from beyond the scene") \
  ROW(x, DELTA_LIGHTS,   14, "delta_lights",   IN_PATHS,              SCALAR_LIGHTS,            NO_GEOMETRY,     "point, spot and directional lights") \
  ROW(x, IMAGE_LIGHTS,   28, "image_lights",   IN_PATHS,              SCALAR_LIGHTS,            NO_GEOMETRY,     "rectangles whose light is an image")

#ifdef __cplusplus
enum LightNumber : unsigned {
#else
enum LightNumber {
#endif
#define LIGHT_NUMBER(x, NAME, number, ...) LIGHT_##NAME = number,
  LIGHT_TABLE(LIGHT_NUMBER, )
#undef LIGHT_NUMBER
};

// The numbers, as bits, and the effects of all lights of some families or properties.
#define LIGHT_BIT_IF(wanted, NAME, number, name, effect, family, properties, ...) \
  | ((((family) | (properties)) & (wanted)) != 0u ? 1u << (number) : 0u)
#define LIGHT_EFFECT_IF(wanted, NAME, number, name, effect, family, properties, ...) \
  | ((((family) | (properties)) & (wanted)) != 0u ? (effect) : 0u)
#define LIGHTS_WITH(wanted) (0u LIGHT_TABLE(LIGHT_BIT_IF, wanted))
#define EFFECTS_OF_LIGHTS(wanted) (0u LIGHT_TABLE(LIGHT_EFFECT_IF, wanted))
