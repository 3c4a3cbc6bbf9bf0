// Direct light by one shadow ray, and how it is weighted against rays that meet an emitter by BSDF sampling.
#include "lights/light.cl"
#include "materials/over_lambert.cl"
#include "scene/path_media.cl"

// The power heuristic for two densities (Veach 1997, 9.2), as a ratio, since the square of a small far light's
// density overflows.
INLINE real power_weight(real pdf, real other_pdf) {
  real ratio = other_pdf / pdf;
  return 1 / (1 + ratio * ratio);
}

// Whether something lies between the ray's origin and the light, which is that far. Adds the ray to *rays and what
// befell it to `counters`.
INLINE bool occluded_along(const Scene *scene, Ray shadow, real distance, uint *rays, volatile global Counters *counters) {
  ++*rays;
  uint diagnostics = 0;
  bool occluded = geometry_occluded(&scene->geometry, shadow, distance, &diagnostics);
  count_diagnostics(diagnostics, counters);
  return occluded;
}

// What glass or the medium leaves of a light's radiance along the shadow ray from `surface`: `interior` is that of the
// segment by which the path came, or with nested dielectrics that of the shadow ray.
INLINE void attenuate_light(const Scene *scene, Interior interior, const Surface *surface, LightSample *light) {
  if (!HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) return;
  if (!nested(scene))
    interior = interior_after(interior, scene->materials + surface->material, surface, light->direction);
  if (HAS(EFFECT_MEDIUM) && !interior.glass)
    light->weight *= transmittance(scene->medium.extinction, light->distance);
  else
    light->weight *= interior_transmittance(interior, light->distance);
}

// Whether the light that lies at the end of a shadow ray from `origin`, which runs in a dielectric, lies behind a face of
// that in contact: then no light comes straight.
INLINE bool light_covered(const Scene *scene, Interior interior, real3 origin, const LightSample *light) {
  if (!nested(scene) || !(scene->nested & NESTED_EMITTERS) || !interior.glass) return false;
  if (!(light->distance < INFINITY) || !(max_component(light->weight) > 0)) return false;
  real3 d = light->direction, place = ray_at(origin, light->distance, d);
  Ray ray = {ray_at(origin, light->distance - light->margin, d), d};
  HitFilter filter = {scene->materials, false};
  HitList list;
  geometry_hits(&scene->geometry, ray, 2 * light->margin, &filter, &list);
  for (uint i = 0; i < list.count; ++i) {
    Surface surface;
    geometry_surface(&scene->geometry, ray, list.hit[i], &surface);
    real3 n = surface.geometric_normal;
    real error = surface.error + (real)GAMMA(8) * max_component(abs3(place));
    bool in_contact = list.hit[i].t < light->margin || fabs(dot3(n, sub3(surface.position, place))) <= error_along(error, n);
    if (in_contact && dot3(n, d) > 0 && is_dielectric(scene, &surface)) return true;
  }
  return false;
}

// A light sample for a point with a rough lobe. Glass is lit from both sides: where the direction from one side's
// origin leads to the other, it is drawn again, by the same numbers, from the origin there.
INLINE LightSample light_sample_rough(const Scene *scene, const Bsdf *bsdf, const Surface *surface, real3 facing,
                                      real4 random, real3 *origin) {
  *origin = offset_origin(surface->position, surface->error, facing, facing);
  LightSample light = light_sample(scene, *origin, random);
  if (transmits(bsdf->kind) && dot3(light.direction, facing) < 0) {
    *origin = offset_origin(surface->position, surface->error, facing, -facing);
    light = light_sample(scene, *origin, random);
    if (!(dot3(light.direction, facing) < 0)) light.weight = (real3)(0, 0, 0);
  }
  return light;
}

// A point of a path at which direct light is sampled.
typedef struct {
  const Bsdf *bsdf;
  const Surface *surface;
  Interior interior;  // of the segment by which the path came, or with nested dielectrics that of the shadow ray
  real3 wi;           // along which the path arrives
  real3 n;            // the facing normal
  bool outside;       // known to be on no body and in none, nor in the medium: nothing is absorbed on the way there
} LitPoint;

// Radiance from one emitter that a rough lobe turns to the path, weighted against BSDF sampling. `behind` is the interior
// beyond the surface, of use with nested dielectrics alone.
static real3 direct_light_rough(const Scene *scene, const LitPoint *point, Interior behind, real3 throughput,
                                real4 random, uint *rays, volatile global Counters *counters) {
  const Bsdf *bsdf = point->bsdf;
  const Surface *surface = point->surface;
  Interior interior = point->interior;
  real3 wi = point->wi, g = surface->geometric_normal, origin;
  LightSample light = light_sample_rough(scene, bsdf, surface, dot3(wi, g) < 0 ? g : -g, random, &origin);
  if (!(max_component(light.weight) > 0)) return (real3)(0, 0, 0);
  BsdfSample lobe = rough_evaluate(bsdf, surface, wi, point->n, light.direction);
  if (!(lobe.pdf > 0) || !(max_component(lobe.weight) > 0)) return (real3)(0, 0, 0);
  Ray shadow = {origin, light.direction};
  if (nested(scene) && dot3(wi, g) * dot3(light.direction, g) > 0) interior = behind;
  if (light_covered(scene, interior, origin, &light)) return (real3)(0, 0, 0);
  if (occluded_along(scene, shadow, light.distance - light.margin, rays, counters)) return (real3)(0, 0, 0);
  attenuate_light(scene, interior, surface, &light);
  return throughput * lobe.weight * light.weight * (lobe.pdf * power_weight(light.pdf, lobe.pdf));
}

// Light from one emitter, and the shadow ray that decides whether it arrives.
typedef struct {
  Ray shadow;
  real distance;    // how far that goes
  real3 reflected;  // radiance to the path if nothing is in the way; zero where no ray need tell
} LightCandidate;

// Light from emitter `chosen` at a diffuse point (`reflectance` = albedo / pi, which over_lambert.cl multiplies; the
// boundary of coated diffuse lets a fraction of the light through). With `weigh_bsdf`, the sample is weighted against BSDF
// sampling by the power heuristic.
INLINE LightCandidate sample_light_unoccluded(const Scene *scene, uint chosen, const LitPoint *point, real3 reflectance,
                                              real4 random, bool weigh_bsdf) {
  const Bsdf *bsdf = point->bsdf;
  const Surface *surface = point->surface;
  real3 wi = point->wi, n = point->n;
  // The light is sampled from where the shadow ray starts: at grazing incidence the step off the surface is
  // longer than the margin that keeps the ray from meeting the light itself.
  real3 g = surface->geometric_normal;
  real side = dot3(wi, g) < 0 ? 1 : -1;
  real3 origin = offset_origin(surface->position, surface->error, g, scaled3(side, g));
  LightSample light = light_sample_from(scene, chosen, origin, random);
  real cosine = dot3(light.direction, n);
  // The true surface must be seen from the same side by the light and by the path.
  bool same_side = dot3(light.direction, g) * dot3(wi, g) < 0;
  if (!point->outside) {
    if (HAS(EFFECT_NESTED) && light_covered(scene, point->interior, origin, &light)) light.weight = (real3)(0, 0, 0);
    attenuate_light(scene, point->interior, surface, &light);
  }
  real weight = 1;
  if (weigh_bsdf) weight = power_weight(light.pdf, cosine * INV_PI);
  if (HAS(EFFECT_PLASTIC) && bsdf->coated) weight *= fresnel_transmittance(cosine, bsdf->ior);
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) reflectance = mul3(reflectance, over_lambert(bsdf, wi, light.direction, n));
  real3 reflected = scaled3(cosine * weight, mul3(reflectance, light.weight));
  LightCandidate found = {{origin, light.direction}, light.distance - light.margin,
                           choose3(cosine > 0 && same_side, reflected, (real3)(0, 0, 0))};
  return found;
}

// What of that is reflected to the path.
static real3 direct_light(const Scene *scene, const LitPoint *point, real3 reflectance, real4 random, bool weigh_bsdf,
                          uint *rays, volatile global Counters *counters) {
  uint chosen = emitter_choose(scene, random.x, random.w);
  LightCandidate light = sample_light_unoccluded(scene, chosen, point, reflectance, random, weigh_bsdf);
  if (!(max_component(light.reflected) > 0) || occluded_along(scene, light.shadow, light.distance, rays, counters))
    return (real3)(0, 0, 0);
  return light.reflected;
}

// The radiance of the environment that a ray into the open finds, as it counts beside light sampling; bsdf_pdf is the
// density of the ray's direction, 0 where no light sample could find what it does.
INLINE real3 escaped_radiance(const Scene *scene, real3 direction, real bsdf_pdf) {
  real pdf;
  real3 radiance = background_radiance(scene, direction, &pdf);
  return bsdf_pdf > 0 ? radiance * power_weight(bsdf_pdf, pdf) : radiance;
}

// Radiance from one emitter that the medium at `position` scatters to a path that arrives along `wi`;
// `throughput` includes the scattering coefficient. With `weigh_phase`, the sample is weighted against sampling of the
// phase function by the power heuristic.
static real3 direct_light_medium(const Scene *scene, real3 position, real3 wi, real3 throughput, real4 random,
                                 bool weigh_phase, uint *rays, volatile global Counters *counters) {
  LightSample light = light_sample(scene, position, random);
  if (!(max_component(light.weight * throughput) > 0)) return (real3)(0, 0, 0);
  Ray shadow = {position, light.direction};
  if (occluded_along(scene, shadow, light.distance - light.margin, rays, counters)) return (real3)(0, 0, 0);
  real phase = phase_density(scene->medium.g, dot3(light.direction, wi));
  real weight = weigh_phase ? power_weight(light.pdf, phase) : 1;
  return throughput * light.weight * transmittance(scene->medium.extinction, light.distance) * (phase * weight);
}

// What radiance that a BSDF sample found at an emissive surface counts for beside light sampling; bsdf_pdf is the
// density of the ray's direction.
INLINE real emission_weight(const Scene *scene, Ray ray, Hit hit, const Surface *surface,
                            global const Material *material, real bsdf_pdf) {
  return power_weight(bsdf_pdf, light_pdf(scene, ray.origin, ray.direction, hit, surface, material));
}
