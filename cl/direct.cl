// Direct light at a diffuse point by one shadow ray.
#include "light.cl"

// Reflected radiance from one emitter at a Lambert point (`reflectance` = albedo / pi) with facing normal n.
// `arriving` is the direction of the path that found the point. With `weigh_bsdf`, the sample is weighted
// against BSDF sampling by the power heuristic (Veach 1997, 9.2). Adds the rays that it traced to *rays and what
// befell them to `counters`.
static real3 direct_light(const Scene *scene, const Surface *surface, real3 arriving, real3 n, real3 reflectance,
                          real4 random, bool weigh_bsdf, uint *rays,
                          volatile global Counters *counters) {
  // The light is sampled from where the shadow ray starts: at grazing incidence the step off the surface is
  // longer than the margin that keeps the ray from meeting the light itself.
  real3 g = surface->geometric_normal;
  real3 origin = offset_origin(surface->position, surface->error, g, dot(arriving, g) < 0 ? g : -g);
  LightSample light = light_sample(scene, origin, random);
  real cosine = dot(light.direction, n);
  // The true surface must be seen from the same side by the light and by the path.
  bool same_side = dot(light.direction, g) * dot(arriving, g) < 0;
  if (!(cosine > 0) || !same_side || !(max_component(light.weight) > 0)) return (real3)(0, 0, 0);
  Ray shadow = {origin, light.direction};
  ++*rays;
  uint faults = 0;
  bool occluded = geometry_occluded(&scene->geometry, shadow, light.distance - light.margin, &faults);
  count_faults(faults, counters);
  if (occluded) return (real3)(0, 0, 0);
  real weight = 1;
  if (weigh_bsdf) {
    // As a ratio, since the square of a small far light's density overflows.
    real ratio = cosine * INV_PI / light.pdf;
    weight = 1 / (1 + ratio * ratio);
  }
  return reflectance * light.weight * (cosine * weight);
}
