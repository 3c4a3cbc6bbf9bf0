// A light that shines from a point into a cone.
#include "lights/point.cl"

// The fraction of a spot's intensity that leaves along the unit vector `direction`: 1 in the even part of the
// cone, 0 outside, and a cubic step in the cosine between.
INLINE real spot_falloff(global const Emitter *emitter, real3 direction) {
  // 1 - cosine by the chord, which keeps narrow cones exact.
  real3 chord = direction - convert_real3(emitter->b.xyz);
  real drop = dot(chord, chord) / 2, outer = emitter->c.x, even = emitter->c.y;
  if (drop <= even) return 1;
  if (!(drop < outer)) return 0;
  real t = (outer - drop) / (outer - even);
  return t * t * (3 - 2 * t);
}

INLINE LightSample spot_sample(const Scene *scene, global const Emitter *emitter, real3 position, real4 random) {
  real distance;
  bool reached;
  real3 direction = direction_to_place(emitter, position, &distance, &reached);
  real3 intensity = convert_real3(emitter->radiance.xyz) * spot_falloff(emitter, -direction);
  real3 irradiance = intensity / (distance * distance);
  return delta_sample(emitter, direction, distance, reached ? irradiance : (real3)(0, 0, 0));
}

// Directions are uniform over the cone.
INLINE Ray spot_emit(const Scene *scene, global const Emitter *emitter, real4 choice, real2 u, real3 *flux) {
  Ray ray = {convert_real3(emitter->a.xyz), cone_uniform(u, convert_real3(emitter->b.xyz), emitter->c.x)};
  real3 intensity = convert_real3(emitter->radiance.xyz);
  // A spot's power is pi intensity (outer + even): the step is 1/2 on average.
  real weight = spot_falloff(emitter, ray.direction) * 2 * emitter->c.x / emitter->radiance.w;
  *flux = intensity * (weight / max_component(intensity));
  return ray;
}
