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

// The texel, of `count` that one emitter has from `first` on, that owns `number`.
INLINE uint map_texel(global const EnvironmentTexel *first, uint count, ulong number) {
  uint low = 0, high = count - 1;
  while (low < high) {
    uint middle = (low + high) / 2;
    if (number < first[middle].cdf)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// A point drawn on an emissive surface.
typedef struct {
  real3 position, normal;  // outward
  real error;              // as in Surface
  real area_pdf;           // given the emitter
} LightPoint;

// Light from the point to `position`, its weight aside; *edge_on where that is to be left out.
INLINE LightSample light_from_point(global const Emitter *emitter, real3 position, LightPoint point, bool *edge_on) {
  real probability = emitter->probability;  // here, since a loop with a load under a condition is not vectorised
  real3 to_light = sub3(point.position, position);
  real distance2 = dot3(to_light, to_light), distance = sqrt(distance2);
  real3 towards = choose3(distance2 > 0, quotient3(to_light, distance), (real3)(0, 0, 1));
  real cosine = -dot3(towards, point.normal);
  cosine = emitter->two_sided != 0 ? fabs(cosine) : cosine;
  // A ray to a light that is seen edge-on stops so short of it that a wall before the light may be missed. That light is
  // less than a millionth of what the light sends elsewhere, and is left out.
  *edge_on = (cosine < (real)1e-3f) & (4 * point.error > (real)0.01f * distance * cosine);
  bool lit = distance2 > 0 && point.area_pdf > 0 && cosine > 0;
  real pdf = lit ? probability * point.area_pdf * distance2 / cosine : 0;
  // An error of the surface's place moves the hit by 1 / cosine times as much.
  real margin = (real)1e-5f * distance + fmin(4 * point.error / cosine, (real)0.5f * distance);
  LightSample sample = {towards, distance, (real3)(0, 0, 0), pdf, margin};
  return sample;
}

// The weight of what a delta light sends to a point, per area across the light.
INLINE LightSample delta_sample(global const Emitter *emitter, real3 direction, real distance, real3 irradiance) {
  LightSample sample = {direction, distance, irradiance / emitter->probability, INFINITY, 0};
  return sample;
}
