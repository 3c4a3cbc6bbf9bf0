// Photon paths: from an emitter through the scene, stored at every diffuse surface they land on and wherever the
// medium scatters them.
#include "photons/projection_map.cl"
#include "photons/channel_shifts.cl"
#include "photons/emission_map.cl"
#include "photons/metropolis_photons.cl"
#include "photons/photon_interaction.cl"
#include "core/work_group.cl"
#include "traversal/ray_stream.cl"

// Sets the random numbers of photons apart from those of camera paths.
#define PHOTON_SEED 0x9e3779b9u

// The random numbers of photon i of the batch.
INLINE RandomStream stream_random(const Params *params, const PhotonStream *batch, uint i) {
  RandomStream stream = {params->seed ^ PHOTON_SEED, params->pass, batch->index[i],
                         HAS(EFFECT_GUIDED_PHOTONS) ? batch->copy[i] : 0, HAS(EFFECT_GUIDED_PHOTONS) ? batch->fresh[i] : 0};
  return stream;
}

// By what photons are led where they are of use.
typedef struct {
  const Guide *guide;
  const Aim *aim;
} Guidance;

// Starts `count` photons of the pass, from number `first` on, behind the `alive` first of the batch.
OUTLINE void stream_emit(const Scene *from, const Params *settings, Guidance by, uint first, uint alive, uint count,
                         PhotonStream *batch, volatile global Counters *counters) {
  const Guide *guide = by.guide;
  const Scene scene = *from;
  const Params params = *settings;
  global const ProjectionCell *cells = by.aim->cells;
  global const EmissionCell *emission = guide->emission;
  const uint emission_cells = guide->emission_cells;
  for (uint i = alive; i < alive + count; ++i) {
    PhotonStart start = {first + i - alive, 0, 0, 0, 1};
    if (HAS(EFFECT_GUIDED_PHOTONS)) {
      start = guided_start(guide, &params, first + i - alive);
      batch->copy[i] = start.copy;
      batch->fresh[i] = start.fresh;
      batch->seed[i] = start.seed;
      batch->useful[i] = 0;
    }
    batch->index[i] = start.path;
    batch->bounce[i] = 0;
    batch->flux[0][i] = start.weight;  // until the photon has a flux of its own
    if (HAS(EFFECT_GUIDED_PHOTONS) && emission_cells > 0) {
      RandomStream stream = stream_random(&params, batch, i);
      real4 choice = random4(stream, DIM_EMITTER);
      uint cell = emission_cell(emission, emission_cells, random4(stream, DIM_EMISSION_CELL).x);
      batch->flux_rg[i] = cell;  // until the photon has a record
      batch->flux[0][i] *= emission[cell].weight;
      batch->primitive[i] = emitter_choose(&scene, emission_number(emission + cell, 0, choice.x), choice.w);
    } else {
      batch->primitive[i] = photon_emitter(&scene, stream_random(&params, batch, i));
    }
  }
  const real3 scale = channel_scale(params.channel_shifts);
#if VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_EMISSION))
#pragma clang loop vectorize(assume_safety)
#endif
  for (uint i = alive; i < alive + count; ++i) {
    RandomStream stream = stream_random(&params, batch, i);
    real4 random = random4(stream, DIM_EMISSION), choice = random4(stream, DIM_EMITTER);
    real u = random.x, v = random.y, weight = 1;
    uint emitter = batch->primitive[i];
    if (HAS(EFFECT_GUIDED_PHOTONS) && emission_cells > 0)
      choice = emission_numbers(emission + batch->flux_rg[i], choice, &u, &v);
    if (HAS(EFFECT_AIMED_PHOTONS))
      weight = aim(cells, projection_square(emitter, params.emitter_count), random.z, &u, &v);
    real3 flux;
    Ray ray = photon_emit_from(&scene, emitter, choice, u, v, &flux);
    flux = mul3(scale, flux);
    if (HAS(EFFECT_AIMED_PHOTONS)) flux = scaled3(weight, flux);
    if (HAS(EFFECT_GUIDED_PHOTONS)) flux = scaled3(batch->flux[0][i], flux);
    PhotonState photon;
    photon.lambert = false;
    photon.ray = ray, photon.flux = flux;
    photon.prefix = PREFIX_DIRECT, photon.mark = 0, photon.interior = interior_none();
    if (HAS(EFFECT_HORIZON) && light_is(scene.emitters + emitter, LIGHTS_WITH(BEYOND_SCENE))) photon.mark = FROM_BEYOND;
    if (HAS(EFFECT_NESTED)) {
      uint diagnostics = 0;
      photon.media = media_at_emitter(&scene, emitter, ray, &diagnostics);
      if (nested(&scene)) photon.interior = interior_of_stack(&scene, &photon.media.stack);
      count_diagnostics(diagnostics, counters);
    }
    batch->events[i] = max_component(flux) > 0 ? EVENT_ALIVE : 0u;
    stream_put(batch, i, &photon);
  }
}

// Puts what photons in a gap of no width meet next in the place of what their rays have met.
OUTLINE void stream_contacts(const Scene *scene, uint count, PhotonStream *batch) {
  for (uint i = 0; i < count; ++i) {
    if (!nested(scene) || batch->media[i].contact == CONTACT_NONE) continue;
    Hit hit = hit_none(INFINITY);
    media_closest(scene, batch->media + i, stream_ray(batch, i), &hit);
    stream_put_hit(batch, i, hit);
  }
}

// Whether photon `i` is outside of all bodies and on none.
INLINE bool stream_outside(const Scene *scene, const PhotonStream *batch, uint i) {
  const uint k = HAS(EFFECT_NESTED) ? i : 0;
  return is_outside(scene, HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM) ? batch->interior[i] : interior_none(), batch->media + k);
}

// Takes photon `i` past its hit. Of *photon it is known whether that is a Lambert vertex.
INLINE void stream_event(const Scene *scene, const Params *params, uint i, PhotonStream *batch, PhotonState *photon) {
  RandomStream stream = stream_random(params, batch, i);
  Hit hit = stream_hit(batch, i);
  uint events = 0;
  photon->diagnostics = 0;
  if (photon->lambert || HAS(EFFECT_MEDIUM) || hit.primitive != HIT_NONE) {
    stream_get(batch, i, photon);
    Photon record = {{0, 0, 0}, 0, 0, 0};
    events = photon_interact(scene, params, stream, batch->bounce[i], hit, photon, &record);
    stream_put(batch, i, photon);
    stream_put_record(batch, i, &record);
  }
  batch->events[i] = events;
}

#if VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_LAMBERT)) && !VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_EVENTS))
// Takes the photons at Lambert vertices past their hits. `others` become the rest of `count`; returns how many these are.
OUTLINE uint stream_scatter_lambert(const Scene *from, const Params *settings, uint count, PhotonStream *batch, uint *others) {
  const Scene scene = *from;
  const Params params = *settings;
  uint lambert[STREAM_CAPACITY], lambert_count = 0, other_count = 0;
  for (uint i = 0; i < count; ++i) {
    uint is_lambert = stream_outside(&scene, batch, i) && meets_lambert(&scene, stream_ray(batch, i), stream_hit(batch, i));
    lambert[lambert_count] = i, lambert_count += is_lambert;
    others[other_count] = i, other_count += is_lambert ^ 1u;
  }
#pragma clang loop vectorize(assume_safety)
  for (uint k = 0; k < lambert_count; ++k) {
    PhotonState photon;
    photon.lambert = true;
    stream_event(&scene, &params, lambert[k], batch, &photon);
  }
  return other_count;
}
#define LAMBERT_APART
#endif

// Takes each photon past its hit.
OUTLINE void stream_scatter(const Scene *from, const Params *settings, uint count, PhotonStream *batch,
                            volatile global Counters *counters) {
#ifdef LAMBERT_APART
  uint others[STREAM_CAPACITY];
  count = stream_scatter_lambert(from, settings, count, batch, others);
  for (uint k = 0; k < count; ++k) {
    PhotonState photon;
    photon.lambert = false;
    stream_event(from, settings, others[k], batch, &photon);
    if (HAS(EFFECT_NESTED)) count_diagnostics(photon.diagnostics, counters);
  }
#else
  const Scene scene = *from;
  const Params params = *settings;
#if VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_EVENTS))
#pragma clang loop vectorize(assume_safety)
#endif
  for (uint i = 0; i < count; ++i) {
    PhotonState photon;
    photon.lambert = false;
    stream_event(&scene, &params, i, batch, &photon);
    if (HAS(EFFECT_NESTED)) count_diagnostics(photon.diagnostics, counters);
  }
#endif
}

// Counts the pilot paths that land as parts of caustics, by the cell that they left by.
OUTLINE void stream_learn(const Scene *scene, const Params *params, const PhotonStream *batch, uint count, const Aim *aim) {
  for (uint i = 0; i < count; ++i) {
    if (!(batch->events[i] & EVENT_STORED) || (batch->normal[i] & (IN_MEDIUM | INDIRECT_PHOTON))) continue;
    RandomStream stream = stream_random(params, batch, i);
    real4 random = random4(stream, DIM_EMISSION);
    atomic_inc(aim->deposited + projection_square(photon_emitter(scene, stream), scene->emitter_count) +
               projection_cell(random.x, random.y));
  }
}

// Stores the records of the last event and counts what went wrong there.
OUTLINE void stream_deposit(uint count, const PhotonStream *batch, global Photon *photons, uint capacity,
                        volatile global Counters *counters) {
  // Which events left a record is as good as random: a list without branches costs a third of asking one at a time.
  uint kept[STREAM_CAPACITY], stored = 0, copies = 0, indirect = 0, saturated = 0, non_finite = 0;
  for (uint i = 0; i < count; ++i) {
    uint events = batch->events[i];
    bool stays = (events & EVENT_STORED) != 0;
    kept[stored] = i;
    stored += stays;
    bool is_indirect = stays && (batch->normal[i] & (IN_MEDIUM | INDIRECT_PHOTON)) == INDIRECT_PHOTON;
    indirect += is_indirect;
    if (HAS(EFFECT_SMOOTH)) {
      uint more = stays ? events >> EVENT_COPIES_SHIFT : 0;
      copies += more;
      indirect += is_indirect ? more : 0;
    }
    saturated += (events & EVENT_SATURATED) != 0;
    non_finite += (events & EVENT_NON_FINITE) != 0;
  }
  if (saturated > 0) atomic_add(&counters->saturated, saturated);
  if (non_finite > 0) atomic_add(&counters->non_finite, non_finite);
  if (stored == 0) return;
  if (indirect > 0) atomic_add(&counters->indirect, indirect);
  uint slot = list_reserve(stored + copies, &counters->photons);
  uint room = slot < capacity ? min(stored + copies, capacity - slot) : 0, next = stored;
  for (uint k = 0; k < min(stored, room); ++k) {
    uint i = kept[k];
    Photon photon = stream_get_record(batch, i);
    photons[slot + k] = photon;
    if (HAS(EFFECT_SMOOTH))
      for (uint more = batch->events[i] >> EVENT_COPIES_SHIFT; more > 0 && next < room; --more) photons[slot + next++] = photon;
  }
}

// Moves those of the photons from `first` to `end` that go on behind the `first` first. Returns how many there are
// then.
OUTLINE uint stream_compact(uint first, uint end, PhotonStream *batch) {
  uint alive = first;
  for (uint i = first; i < end; ++i) {
    stream_move(batch, i, alive);
    alive += batch->events[i] & EVENT_ALIVE;
  }
  return alive;
}

// Traces photons [first, end) of the pass, a batch of them one event at a time; new ones take the places of those that
// have ended. Returns the number of rays.
OUTLINE uint stream_paths(const Scene *scene, const Params *params, Guidance by, uint first, uint end,
                          global Photon *photons, volatile global Counters *counters) {
  PhotonStream batch;
  uint rays = 0, alive = 0;
  if (params->max_depth == 0) return 0;
  while (first < end || alive > 0) {
    uint room = (STREAM_CAPACITY - alive) / STREAM_STEP * STREAM_STEP, fresh = min(end - first, room);
    if (fresh > 0 && (room >= PATH_REGENERATION || alive == 0)) {
      stream_emit(scene, params, by, first, alive, stream_padded(fresh), &batch, counters);
      first += fresh;
      alive = stream_compact(alive, alive + fresh, &batch);
    }
    rays += alive;
    RayArrays ray_arrays = RAY_ARRAYS(&batch);
    rays_closest(&scene->geometry, &ray_arrays, alive, counters);
    if (HAS(EFFECT_NESTED)) stream_contacts(scene, alive, &batch);
    uint padded = stream_padded(alive);
#ifdef LAMBERT_APART
    padded = alive;
#endif
    stream_scatter(scene, params, HAS(EFFECT_MEDIUM) ? alive : padded, &batch, counters);
    if (HAS(EFFECT_GUIDED_PHOTONS) && params->photon_role >= PHOTONS_PILOT_PATHS)
      stream_guide(by.guide, params, alive, &batch, counters);
    if (HAS(EFFECT_AIMED_PHOTONS) && params->photon_role == PHOTONS_FOR_PROJECTION_MAP)
      stream_learn(scene, params, &batch, alive, by.aim);
    else if (!HAS(EFFECT_GUIDED_PHOTONS) || params->photon_role != PHOTONS_TO_LEARN_BY)
      stream_deposit(alive, &batch, photons, params->photon_capacity, counters);
    for (uint i = 0; i < alive; ++i) ++batch.bounce[i];
    alive = stream_compact(0, alive, &batch);
  }
  return rays;
}

// Traces the photons of a pass. They are appended in any order; those that find the buffer full are counted, so that
// the host can enlarge it and trace the pass again. Where photons go in batches, one item of a work-group traces
// PHOTONS_AN_ITEM for each item of that, if any are left for the group. What follows
// `params` is asked for by Metropolis photons, and at the end by aimed ones.
kernel void trace_photons(SCENE_PARAMETERS, global Photon *photons, volatile global Counters *counters,
                          Params params, global uint2 *seeds, volatile global uint *accepted, global const uint *visibility,
                          Grid cells, global const EmissionCell *emission, uint emission_cells,
                          global const ProjectionCell *projection_cells, volatile global uint *projection_deposits) {
  uint first = get_global_id(0), end = first + 1;
  if (STREAM_CAPACITY > 1u && !group_share(params.photon_count, PHOTONS_AN_ITEM, &first, &end)) return;
  if (first >= params.photon_count) return;
  SCENE_INIT(params);
  Guide guide = {seeds, accepted, visibility, cells, emission, emission_cells};
  Aim aim = {projection_cells, projection_deposits};
  Guidance guidance = {&guide, &aim};
  uint rays = stream_paths(&scene, &params, guidance, params.first_photon + first, params.first_photon + end, photons,
                         counters);
  count_rays(rays, counters);
}

// numbers[i] = the START_NUMBERS of seed number i of the list, as its photon used them. Of pilot paths PHOTONS_TO_LEARN_BY.
kernel void seed_numbers(global const uint2 *seeds, global const EmissionCell *emission, uint emission_cells,
                         global float *numbers, uint seed, uint pass, uint count) {
  uint i = get_global_id(0);
  if (!HAS(EFFECT_GUIDED_PHOTONS) || i >= count) return;
  RandomStream stream = {seed ^ PHOTON_SEED, pass, seeds[i].x, 0, 0};
  real4 choice = random4(stream, DIM_EMITTER), random = random4(stream, DIM_EMISSION);
  real u = random.x, v = random.y;
  if (emission_cells > 0) {
    uint cell = emission_cell(emission, emission_cells, random4(stream, DIM_EMISSION_CELL).x);
    choice = emission_numbers(emission + cell, choice, &u, &v);
  }
  global float *point = numbers + i * START_NUMBERS;
  point[0] = choice.x, point[1] = choice.y, point[2] = choice.z, point[3] = u, point[4] = v;
}
