// What a light gives to a point, and the numbers by which an emitter and its parts are drawn.
#include "sampling/rng.cl"
#include "scene/scene.cl"

// A light's contribution to a point: radiance / pdf, not yet multiplied by BSDF, cosine and visibility.
typedef struct {
  real3 direction;  // unit, from the lit point
  real distance;
  real3 weight;     // radiance / pdf; zero where nothing arrives
  real pdf;         // per solid angle, the choice of emitter included; infinite for delta lights
  real margin;      // what to stop a shadow ray short by, so that it does not meet the light itself; of no meaning where
                    // the weight is zero
} LightSample;

// The number made of all 24 bits of u and the low 23 bits of v: the 24 bits of one random number are too few to choose
// among a million emitters. The highest bit of v is left to the caller.
INLINE ulong emitter_number(real u, real v) {
  return (ulong)(uint)(u * 16777216) << 23 | ((uint)(v * 16777216) & 0x7fffffu);
}

// The emitter that owns the number of u and v.
INLINE uint emitter_choose(const Scene *scene, real u, real v) {
  ulong number = emitter_number(u, v);
  uint low = 0, high = scene->emitter_count - 1;
  while (low < high) {
    uint middle = (low + high) / 2;
    if (number < scene->emitters[middle].cdf)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// Which of the numbers that the emitter owns was drawn with u and v.
INLINE ulong owned_number(const Scene *scene, global const Emitter *emitter, real u, real v) {
  ulong number = emitter_number(u, v);
  return emitter > scene->emitters ? number - (emitter - 1)->cdf : number;
}

// The weight of what a delta light sends to a point, per area across the light.
INLINE LightSample delta_sample(global const Emitter *emitter, real3 direction, real distance, real3 irradiance) {
  LightSample sample = {direction, distance, irradiance / emitter->probability, INFINITY, 0};
  return sample;
}
