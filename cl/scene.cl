// All that a path can meet, as one value: geometry, materials, textures and emitters.
#include "bsdf.cl"
#include "geometry.cl"

typedef struct {
  Geometry geometry;
  global const Material *materials;
  global const Texture *textures;
  global const half *texels;
  global const Emitter *emitters;
  global const EnvironmentTexel *environment;
  uint emitter_count;
  float emitter_density;
} Scene;

// Every kernel that traces takes these and begins with SCENE_INIT(params).
#define SCENE_PARAMETERS                                                                              \
  GEOMETRY_PARAMETERS, global const Material *materials, global const Texture *textures,              \
      global const half *texels, global const Emitter *emitters,                                      \
      global const EnvironmentTexel *environment
#define SCENE_INIT(params)                                                                            \
  GEOMETRY_INIT((params).plane_count)                                                                 \
  Scene scene = {geometry, materials, textures, texels, emitters, environment,                        \
                 (params).emitter_count, (params).emitter_density}
