// A light that shines from a point, the same in all directions.
#include "lights/light_sample.cl"

// The unit vector from `position` to the light's place, and the *distance; *reached is false at the place itself.
INLINE real3 direction_to_place(global const Emitter *emitter, real3 position, real *distance, bool *reached) {
  real3 to_light = convert_real3(emitter->a.xyz) - position;
  *distance = length(to_light);
  *reached = *distance > 0;
  return *reached ? to_light / *distance : (real3)(0, 0, 1);
}

// Irradiance: intensity over the square of the distance.
INLINE LightSample point_sample(const Scene *scene, global const Emitter *emitter, real3 position, real4 random) {
  real distance;
  bool reached;
  real3 direction = direction_to_place(emitter, position, &distance, &reached);
  real3 irradiance = convert_real3(emitter->radiance.xyz) / (distance * distance);
  return delta_sample(emitter, direction, distance, reached ? irradiance : (real3)(0, 0, 0));
}

// Directions are uniform over the sphere.
INLINE Ray point_emit(const Scene *scene, global const Emitter *emitter, real4 choice, real2 u, real3 *flux) {
  Ray ray = {convert_real3(emitter->a.xyz), sphere_uniform(u)};
  real3 intensity = convert_real3(emitter->radiance.xyz);
  *flux = intensity * (1 / max_component(intensity));
  return ray;
}
