// Point, spot and directional lights: no ray meets them by chance, so that they are found by sampling them alone.
#include "lights/infinite_light.cl"

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

// What arrives at `position`, as irradiance of a surface across the light, with the unit *direction towards the light
// and its *distance (INFINITY for a directional light).
INLINE real3 delta_light_arrival(global const Emitter *emitter, real3 position, real3 *direction, real *distance) {
  real3 radiance = convert_real3(emitter->radiance.xyz);
  if (emitter->type == EMITTER_DIRECTIONAL) {
    *direction = -convert_real3(emitter->b.xyz);
    *distance = INFINITY;
    return radiance;
  }
  real3 to_light = convert_real3(emitter->a.xyz) - position;
  *distance = length(to_light);
  if (!(*distance > 0)) return (real3)(0, 0, 0);
  *direction = to_light / *distance;
  if (emitter->type == EMITTER_SPOT) radiance *= spot_falloff(emitter, -*direction);
  return radiance / (*distance * *distance);
}

// A photon of the light: directions uniform over the sphere or cone, or one direction from the disc before the scene.
// *weight is its flux over the mean of all.
INLINE Ray delta_light_ray(global const Emitter *emitter, real2 u, real *weight) {
  Ray ray;
  *weight = 1;
  if (emitter->type == EMITTER_DIRECTIONAL) {
    ray.direction = convert_real3(emitter->b.xyz);
    ray.origin = infinite_light_origin(emitter, ray.direction, u);
    return ray;
  }
  ray.origin = convert_real3(emitter->a.xyz);
  if (emitter->type == EMITTER_SPOT) {
    ray.direction = cone_uniform(u, convert_real3(emitter->b.xyz), emitter->c.x);
    // A spot's power is pi intensity (outer + even): the step is 1/2 on average.
    *weight = spot_falloff(emitter, ray.direction) * 2 * emitter->c.x / emitter->radiance.w;
  } else {
    ray.direction = sphere_uniform(u);
  }
  return ray;
}
