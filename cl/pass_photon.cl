// Photon paths: from an emitter through the scene, stored at every diffuse surface they land on and wherever the
// medium scatters them.
#include "direct.cl"
#include "grid.cl"
#include "layers.cl"
#include "work_group.cl"

// Sets the random numbers of photons apart from those of camera paths.
#define PHOTON_SEED 0x9e3779b9u

// Flux in stored units, dithered so that its expectation is exact; *saturated where it does not fit.
INLINE uint flux_quantise(real flux, real random, bool *saturated) {
  real units = flux * PHOTON_FLUX_UNIT + random;
  *saturated = *saturated || units >= 65536;
  return (uint)clamp(units, (real)0, (real)65535);
}

// Photons that a work-group keeps until it asks for room for all of them at once: four of each of its usual 64 items.
// What finds no place here goes to the buffer by itself.
#define STAGED_PHOTONS (LARGEST_WORK_GROUP)

// Where one work-item leaves its photons.
typedef struct {
  local Photon *staged;   // of this item alone
  uint room;              // in `staged`
  uint count;             // how many are there
  uint indirect;          // how many were stored that are marked INDIRECT_PHOTON, there or not
  global Photon *photons; // the buffer of the pass, and what it holds
  uint capacity;
  volatile global Counters *counters;
} PhotonStore;

// Adds a photon, whose `flux` is relative to Params.photon_flux; where the buffer is full it is only counted.
INLINE void photon_store(PhotonStore *store, real3 position, uint normal, real3 flux, uint history, real4 dither) {
  bool saturated = false;
  uint r = flux_quantise(flux.x, dither.x, &saturated), g = flux_quantise(flux.y, dither.y, &saturated),
       b = flux_quantise(flux.z, dither.z, &saturated);
  if (saturated) atomic_inc(&store->counters->saturated);
  if (!isfinite(flux.x + flux.y + flux.z + position.x + position.y + position.z)) {
    atomic_inc(&store->counters->non_finite);
    return;
  }
  Photon photon;
  vstore3(position, 0, photon.position);
  photon.normal = normal;
  photon.flux_rg = r | g << 16;
  photon.flux_b = b;
  if (HAS(OUTPUT_LAYERS)) photon.flux_b |= history_layer(history) << PHOTON_LAYER_SHIFT;
  if (!(normal & IN_MEDIUM) && (normal & INDIRECT_PHOTON)) ++store->indirect;
  if (store->count < store->room) {
    store->staged[store->count++] = photon;
    return;
  }
  uint slot = list_reserve(1, &store->counters->photons);
  if (slot < store->capacity) store->photons[slot] = photon;
}

// Traces photon number `index` of the pass. Returns the number of rays traced.
OUTLINE uint photon_path(const Scene *scene, const Params *params, uint index, PhotonStore *store) {
  RandomStream stream = {params->seed ^ PHOTON_SEED, params->pass, index};

  real3 flux;
  Ray ray = photon_emit(scene, stream, &flux);
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  uint rays = 0, history = HISTORY_STRAIGHT, mark = 0;
  Interior interior = interior_none();
  for (uint depth = 0; depth < params->max_depth; ++depth) {
    Hit hit = hit_none(INFINITY);
    if (!(max_component(flux) > 0)) break;
    ++rays;
    bool met = geometry_closest(&scene->geometry, ray, &hit);
    count_faults(hit.faults, store->counters);
    if (HAS(EFFECT_MEDIUM) && medium_along(scene, ray, hit, met, interior)) {
      real before = max_component(flux), distance;
      if (medium_flight(&scene->medium, hit.t, random_at(stream, depth, DIM_MEDIUM).xy, &flux, &distance)) {
        flux *= scene->medium.scattering;
        real3 position = ray.origin + distance * ray.direction;
        if (!(shadow_rays && depth == 0))
          photon_store(store, position, direction_pack(ray.direction), flux, history,
                       random_at(stream, depth, DIM_QUANTISE));
        if (depth + 1 == params->max_depth) break;
        real4 random = random_at(stream, depth, DIM_BSDF);
        real survival = fmin(max_component(flux) / before, (real)1);
        if (random.w >= survival) break;
        flux /= survival;
        ray.origin = position;
        ray.direction = phase_sample(scene->medium.g, ray.direction, random.xy);
        history = history_after(history, false);
        mark = INDIRECT_PHOTON;
        continue;
      }
    }
    if (!met) break;
    Surface surface;
    geometry_surface(&scene->geometry, ray, hit, &surface);
    global const Material *material = scene->materials + surface.material;
    Bsdf bsdf = bsdf_at(material, scene->textures, scene->texels, surface.uv);
    if (HAS(EFFECT_TEXTURES)) make_finite(&bsdf.color, store->counters);
    if (HAS(EFFECT_DISPERSION))
      disperse(&bsdf, material, scene->inverse_wavelength2, random_at(stream, depth, DIM_CHANNEL).x, &flux);
    real3 n = facing_normal(&surface, ray.direction);
    real4 random = random_at(stream, depth, DIM_BSDF);

    real before = max_component(flux);
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) {
      interior = interior_before(interior, material, &surface, ray.direction);
      flux *= interior_transmittance(interior, hit.t);
    }

    bool plastic = HAS(EFFECT_PLASTIC) && bsdf.kind == MATERIAL_PLASTIC;
    if (bsdf.kind == MATERIAL_DIFFUSE || plastic) {
      // Photons are stored whatever the texel that they land on reflects: the points around it may reflect more.
      // Only where all is black, as on most lamps, are they of no use.
      bool black = material->color_texture == 0 && !(max_component(bsdf.color) > 0);
      if (black && !plastic) break;
      // With shadow rays the light that arrives straight from an emitter is counted there.
      if (!(shadow_rays && depth == 0) && !black) {
        real3 landed = flux * shading_normal_arrival(&surface, ray.direction);
        if (plastic) landed *= fresnel_transmittance(-dot(ray.direction, n), bsdf.ior);
        bool front = dot(surface.geometric_normal, ray.direction) < 0;
        photon_store(store, surface.position,
                     normal_pack(front ? surface.geometric_normal : -surface.geometric_normal) | mark, landed,
                     history, random_at(stream, depth, DIM_QUANTISE));
      }
    }
    if (depth + 1 == params->max_depth) break;

    if (plastic) plastic_choose(&bsdf, ray.direction, n, random.z);
    history = history_after(history, bsdf_is_specular(&bsdf));
    if (bsdf.kind == MATERIAL_DIFFUSE) mark = INDIRECT_PHOTON;
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
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) interior = interior_after(interior, material, &surface, next.direction);
    ray.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, next.direction);
    ray.direction = next.direction;
  }
  return rays;
}

// Traces the photons of a pass. They are appended in any order; those that find the buffer full are counted, so that
// the host can enlarge it and trace the pass again.
kernel void trace_photons(SCENE_PARAMETERS, global Photon *photons, volatile global Counters *counters,
                          Params params) {
  local Photon staged[STAGED_PHOTONS];
  local uint group_numbers[LARGEST_WORK_GROUP], places[LARGEST_WORK_GROUP + 1];
  uint index = get_global_id(0), room = STAGED_PHOTONS / get_local_size(0), rays = 0;
  PhotonStore store = {staged + get_local_id(0) * room, room, 0, 0, photons, params.photon_capacity, counters};
  if (index < params.photon_count) {
    SCENE_INIT(params);
    rays = photon_path(&scene, &params, params.first_photon + index, &store);
  }
  uint first = group_reserve(store.count, places, &counters->photons);
  for (uint i = 0; i < store.count; ++i)
    if (first + i < params.photon_capacity) photons[first + i] = store.staged[i];
  group_add(rays, group_numbers, &counters->rays);
  barrier(CLK_LOCAL_MEM_FENCE);
  group_add(store.indirect, group_numbers, &counters->indirect);
}
