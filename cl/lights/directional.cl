// Light from infinitely far, as the sun's: all of it travels one way.
#include "lights/horizon_emission.cl"
#include "lights/light_sample.cl"

INLINE LightSample directional_sample(const Scene *scene, global const Emitter *emitter, real3 position, real4 random) {
  return delta_sample(emitter, -convert_real3(emitter->b.xyz), INFINITY, convert_real3(emitter->radiance.xyz));
}

// From the disc before the scene, or from before its infinite planes.
INLINE Ray directional_emit(const Scene *scene, global const Emitter *emitter, real4 choice, real2 u, real3 *flux) {
  real3 irradiance = convert_real3(emitter->radiance.xyz);
  real weight;
  Ray ray = infinite_light_ray(scene, emitter, convert_real3(emitter->b.xyz), u, &weight);
  *flux = irradiance * (weight / max_component(irradiance));
  return ray;
}
