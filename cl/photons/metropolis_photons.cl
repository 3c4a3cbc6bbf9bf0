// Photons guided to what the camera sees, after Hachisuka & Jensen, "Robust Adaptive Photon Tracing using Photon Path
// Visibility" (TOG 2011), but with a Markov chain of one step for each visible path in place of one long chain.
//
// Cells of space where visible points of earlier passes lie are marked. Of a pass's photons
//   pilot paths are traced as always; what they leave in cells without a mark stays. Those that land in a marked cell become
//          seeds: they are spread evenly over all paths that do (each path is a point of the unit cube of its random
//          numbers). They leave nothing there yet;
//   copies repeat a seed with slightly mutated numbers. Each is a step of Metropolis et al. from its seed: where it lands
//          in a marked cell too, it is accepted, with 1 / copies of the seed's flux;
//   seeds  are then traced again, with the flux of the copies that were not accepted.
// Since a seed is itself drawn from what the step leaves as it is, every accepted copy is too: there is no start to wait
// for, no constant to estimate, and passes are independent, so that their spread tells the error. The marks decide how
// noisy the picture is, and nothing else. Radii shrink as if copies were photons like others: sooner than by seeds alone.
#include "photons/visibility_grid.cl"
#include "photons/photon_stream.cl"
#include "core/work_group.cl"

// What Metropolis photons read and write beside the map: `seeds` holds the numbers of the pilot paths that became seeds, in any
// order, `accepted` how many copies of each were; for `marks` see visibility_grid.cl, for `emission` emission_map.cl, which
// has no cells where photons start everywhere.
typedef struct {
  global uint2 *seeds;
  volatile global uint *accepted;
  global const uint *visibility;
  Grid cells;
  global const EmissionCell *emission;
  uint emission_cells;
} Guide;

// Of photon number `number` of a launch: its path, which copy it is, its place in the list of seeds, and the
// weight of its flux.
typedef struct {
  uint path, copy, fresh, seed;
  real weight;
} PhotonStart;

INLINE PhotonStart guided_start(const Guide *guide, const Params *params, uint number) {
  PhotonStart start = {number, 0, 0, 0, 1};
  if (params->photon_role != PHOTONS_MUTATED_PATHS && params->photon_role != PHOTONS_CURRENT_PATHS) return start;
  bool copies = params->photon_role == PHOTONS_MUTATED_PATHS;
  number = min(number, params->photon_count - 1);  // lanes beyond the last photon fill a vector
  start.seed = copies ? number / params->photon_mutations : number;
  start.copy = copies ? 1 + number % params->photon_mutations : 0;
  uint2 seed = guide->seeds[start.seed];
  start.path = seed.x;
  start.fresh = DIM_BOUNCE_FIRST + seed.y * DIM_BOUNCE_STRIDE;
  if (params->photon_mutations == 0) return start;
  uint parts = copies ? 1 : params->photon_mutations - guide->accepted[start.seed];
  start.weight = (real)parts / params->photon_mutations;
  return start;
}

// Decides which records of the last event stay, by where they lie, and keeps the lists of seeds and of accepted copies.
OUTLINE void stream_guide(const Guide *guide, const Params *params, uint count, PhotonStream *batch,
                        volatile global Counters *counters) {
  bool learning = params->photon_role == PHOTONS_TO_LEARN_BY, pilot_paths = learning || params->photon_role == PHOTONS_PILOT_PATHS;
  // Light that shadow rays bring teaches nothing.
  uint wanted = learning ? EVENT_STORED : EVENT_STORED | EVENT_DEPOSITED_ELSEWHERE;
  uint seeds = 0;
  for (uint i = 0; i < count; ++i) {
    if (!(batch->events[i] & wanted)) continue;
    real3 position = (real3)(batch->position[0][i], batch->position[1][i], batch->position[2][i]);
    bool visible = !(batch->normal[i] & IN_MEDIUM) && (!learning || lies_in_grid(guide->cells, position)) &&
                  is_visible(guide->visibility, guide->cells, normal_unpack(batch->normal[i]), position);
    if (visible == pilot_paths) batch->events[i] &= ~(EVENT_STORED | EVENT_SATURATED);
    if (!visible || batch->useful[i]) continue;
    batch->useful[i] = pilot_paths ? 2 : 1;  // 2: not in the list yet
    seeds += pilot_paths ? 1 : 0;
    if (params->photon_role != PHOTONS_MUTATED_PATHS) continue;
    if (guide->seeds[batch->seed[i]].y == batch->bounce[i])
      atomic_inc(guide->accepted + batch->seed[i]);
    else
      batch->events[i] = 0;
  }
  if (seeds == 0) return;
  uint slot = list_reserve(seeds, &counters->seeds);
  for (uint i = 0; i < count; ++i) {
    if (batch->useful[i] != 2) continue;
    guide->seeds[slot++] = (uint2)(batch->index[i], batch->bounce[i]);
    batch->useful[i] = 1;
  }
}
