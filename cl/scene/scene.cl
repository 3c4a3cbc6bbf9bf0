// All that a path can meet, as one value: geometry, materials, textures and emitters.
#include "materials/dispersion.cl"
#include "traversal/geometry.cl"
#include "media/interior.cl"
#include "media/medium.cl"

typedef struct {
  Geometry geometry;
  global const Material *materials;
  global const Texture *textures;
  global const half *texels;
  global const Emitter *emitters;
  global const EnvironmentTexel *environment;
  uint emitter_count;
  float emitter_density;
  real3 inverse_wavelength2;  // of each channel, in um^-2
  Medium medium;
  bool emission_met;  // as in Params
  uint nested;        // as in Params, like the box
  real3 contact_low, contact_high, inside_direction;
  global const WallGrid *walls;  // with EFFECT_WALLS, in kernels that are given them
} Scene;

// Every kernel that traces takes these and begins with SCENE_INIT(params).
#define SCENE_PARAMETERS                                                                              \
  GEOMETRY_PARAMETERS, global const Material *materials, global const Texture *textures,              \
      global const half *texels, global const Emitter *emitters,                                      \
      global const EnvironmentTexel *environment
#define SCENE_INIT(params)                                                                            \
  GEOMETRY_INIT((params).plane_count)                                                                 \
  Scene scene = {geometry, materials, textures, texels, emitters, environment,                                  \
                 (params).emitter_count, (params).emitter_density,                                                    \
                 (real3)((params).inverse_wavelength2[0], (params).inverse_wavelength2[1],                            \
                         (params).inverse_wavelength2[2]),                                                            \
                 {convert_real3((params).extinction.xyz), convert_real3((params).scattering.xyz),                     \
                  (params).extinction.w},                                                                             \
                 (params).emission_met != 0, (params).nested,                                                         \
                 (real3)((params).contact_low[0], (params).contact_low[1], (params).contact_low[2]),                  \
                 (real3)((params).contact_high[0], (params).contact_high[1], (params).contact_high[2]),              \
                 (real3)((params).inside_direction[0], (params).inside_direction[1], (params).inside_direction[2]), 0}

// Whether the medium lies along the ray up to `hit`, which is one where `met`: everywhere but inside of glass.
INLINE bool medium_along(const Scene *scene, Ray ray, Hit hit, bool did_hit, Interior interior) {
  if (!did_hit) return !interior.glass;
  Surface surface;
  geometry_surface(&scene->geometry, ray, hit, &surface);
  return !interior_before(interior, scene->materials + surface.material, &surface, ray.direction).glass;
}
