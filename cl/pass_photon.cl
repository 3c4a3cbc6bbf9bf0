// Photon paths: from an emitter through the scene, stored at every diffuse surface they land on.
#include "direct.cl"
#include "grid.cl"

// Sets the random numbers of photons apart from those of camera paths.
#define PHOTON_SEED 0x9e3779b9u

// Flux in stored units, dithered so that its expectation is exact; *saturated where it does not fit.
INLINE uint flux_quantise(real flux, real random, bool *saturated) {
  real units = flux * PHOTON_FLUX_UNIT + random;
  *saturated = *saturated || units >= 65536;
  return (uint)clamp(units, (real)0, (real)65535);
}

// More photons than any buffer holds need not be told apart, and a count that wrapped around would pass for few.
#define PHOTON_COUNT_LIMIT 0x80000000u

// Traces photon number `index` of the pass. Photons are appended in any order; where the buffer is
// full they are only counted, so that the host can enlarge it and trace the pass again.
OUTLINE void photon_path(const Scene *scene, const Params *params, uint index, global Photon *photons,
                         volatile global Counters *counters) {
  RandomStream stream = {params->seed ^ PHOTON_SEED, params->pass, index};

  real3 flux;
  Ray ray = photon_emit(scene, stream, &flux);
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  uint rays = 0;
  for (uint depth = 0; depth < params->max_depth; ++depth) {
    Hit hit = hit_none(INFINITY);
    if (!(max_component(flux) > 0)) break;
    ++rays;
    bool met = geometry_closest(&scene->geometry, ray, &hit);
    count_faults(hit.faults, counters);
    if (!met) break;
    Surface surface;
    geometry_surface(&scene->geometry, ray, hit, &surface);
    Bsdf bsdf = bsdf_at(scene->materials + surface.material, scene->textures, scene->texels, surface.uv);
    if (HAS(EFFECT_TEXTURES)) make_finite(&bsdf.color, counters);
    real3 n = facing_normal(&surface, ray.direction);
    real4 random = random_at(stream, depth, DIM_BSDF);

    real before = max_component(flux);

    bool plastic = HAS(EFFECT_PLASTIC) && bsdf.kind == MATERIAL_PLASTIC;
    if (bsdf.kind == MATERIAL_DIFFUSE || plastic) {
      // Photons are stored whatever the texel that they land on reflects: the points around it may reflect more.
      // Only where all is black, as on most lamps, are they of no use.
      global const Material *material = scene->materials + surface.material;
      bool black = material->color_texture == 0 && !(max_component(bsdf.color) > 0);
      if (black && !plastic) break;
      // With shadow rays the light that arrives straight from an emitter is counted there.
      if (!(shadow_rays && depth == 0) && !black) {
        real3 landed = flux * shading_normal_arrival(&surface, ray.direction);
        if (plastic) landed *= fresnel_transmittance(-dot(ray.direction, n), bsdf.ior);
        real4 dither = random_at(stream, depth, DIM_QUANTISE);
        bool saturated = false;
        uint r = flux_quantise(landed.x, dither.x, &saturated), g = flux_quantise(landed.y, dither.y, &saturated),
             b = flux_quantise(landed.z, dither.z, &saturated);
        if (saturated) atomic_inc(&counters->saturated);
        if (isfinite(landed.x + landed.y + landed.z + surface.position.x + surface.position.y + surface.position.z)) {
          uint slot = atomic_inc(&counters->photons);
          if (slot >= PHOTON_COUNT_LIMIT) atomic_dec(&counters->photons);
          if (slot < params->photon_capacity) {
            bool front = dot(surface.geometric_normal, ray.direction) < 0;
            global Photon *photon = photons + slot;
            vstore3(surface.position, 0, photon->position);
            photon->normal = normal_pack(front ? surface.geometric_normal : -surface.geometric_normal);
            photon->flux_rg = r | g << 16;
            photon->flux_b = b;
          }
        } else {
          atomic_inc(&counters->non_finite);
        }
      }
    }
    if (depth + 1 == params->max_depth) break;

    if (plastic) plastic_choose(&bsdf, ray.direction, n, random.z);
    BsdfSample next = bsdf_sample(&bsdf, &surface, ray.direction, random, false);
    if (bsdf.kind == MATERIAL_DIFFUSE || bsdf_is_rough(&bsdf)) {
      flux *= shading_normal_arrival(&surface, ray.direction);
      next.weight *= shading_normal_departure(&surface, next.direction, n);
    }
    // Absorption by Russian roulette: survivors keep the largest channel of the flux that they came with.
    flux *= next.weight;
    real survival = fmin(max_component(flux) / before, (real)1);
    if (random.w >= survival) break;
    flux /= survival;
    ray.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, next.direction);
    ray.direction = next.direction;
  }
  atomic_add(&counters->rays, rays);
}

kernel void trace_photons(SCENE_PARAMETERS, global Photon *photons, volatile global Counters *counters,
                          Params params) {
  uint index = get_global_id(0);
  if (index >= params.photon_count) return;
  SCENE_INIT(params);
  photon_path(&scene, &params, index, photons, counters);
}
