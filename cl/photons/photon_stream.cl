// Photons on their way in a batch: what each carries, by component, so that the steps of a path that all take alike
// are loops over them which PoCL's compiler turns into vector code. See vector.cl for what such a loop may hold.
#include "media/interior.cl"
#include "film/light_passes.cl"
#include "scene/path_media.cl"
#include "sampling/rng.cl"
#include "core/stream_size.cl"

// Photons for each item of a work-group, whose first item traces those of all, and places that must be free before new
// photons join the batch.
#define PHOTONS_AN_ITEM 4u
#define PATH_REGENERATION 16u

// Whether the rays of a batch meet all primitives in place of walking the tree each: the host asks for it where they are
// few.
#if defined(BRUTE_FORCE) && STREAM_CAPACITY > 1u
#define STREAM_BRUTE_FORCE
#endif

// What happened to a photon at one event of its path, as bits.
#define EVENT_ALIVE 1u       // it goes on
#define EVENT_STORED 2u      // `deposited` holds its record
#define EVENT_SATURATED 4u   // that had more flux than it holds
#define EVENT_NON_FINITE 8u  // it had no finite record
#define EVENT_DEPOSITED_ELSEWHERE 16u     // the record is not to be stored, since shadow rays bring that light
#define EVENT_COPIES_SHIFT 8u  // from this bit on, how many records more are to be stored with the same content
#define EVENT_MOST_COPIES 4095u

// What a photon carries from event to event.
typedef struct {
  Ray ray;
  real3 flux;
  uint prefix;
  uint mark;  // INDIRECT_PHOTON, or 0
  Interior interior;
  PathMedia media;  // with EFFECT_NESTED
  // DIAGNOSTIC_* of the present event, with EFFECT_NESTED. Here, since a variable of its own that the event is given a pointer to
  // keeps the loop over events scalar.
  uint diagnostics;
} PhotonState;

typedef struct {
  real origin[3][STREAM_CAPACITY], direction[3][STREAM_CAPACITY], flux[3][STREAM_CAPACITY];
  uint index[STREAM_CAPACITY];      // of the photon's path in its pass
  uint bounce[STREAM_CAPACITY];     // events that lie behind it
  uint mark[STREAM_CAPACITY];       // INDIRECT_PHOTON, or 0
  uint primitive[STREAM_CAPACITY];  // as in Hit
  real t[STREAM_CAPACITY], u[STREAM_CAPACITY], v[STREAM_CAPACITY];
  uint events[STREAM_CAPACITY];  // EVENT_* bits
  real position[3][STREAM_CAPACITY];  // of its record, and the rest of that
  uint normal[STREAM_CAPACITY], flux_rg[STREAM_CAPACITY], flux_b[STREAM_CAPACITY];
  uint prefix[(EFFECTS & OUTPUT_LIGHT_PASSES) ? STREAM_CAPACITY : 1u];
  Interior interior[(EFFECTS & (EFFECT_ABSORPTION | EFFECT_MEDIUM)) ? STREAM_CAPACITY : 1u];
  PathMedia media[(EFFECTS & EFFECT_NESTED) ? STREAM_CAPACITY : 1u];
  uint copy[(EFFECTS & EFFECT_GUIDED_PHOTONS) ? STREAM_CAPACITY : 1u];  // as in RandomStream
  uint fresh[(EFFECTS & EFFECT_GUIDED_PHOTONS) ? STREAM_CAPACITY : 1u];
  uint seed[(EFFECTS & EFFECT_GUIDED_PHOTONS) ? STREAM_CAPACITY : 1u];  // its place in the list of seeds
  uint useful[(EFFECTS & EFFECT_GUIDED_PHOTONS) ? STREAM_CAPACITY : 1u];  // not 0 where it has landed where the camera sees
} PhotonStream;

INLINE Ray stream_ray(const PhotonStream *batch, uint i) {
  Ray ray = {(real3)(batch->origin[0][i], batch->origin[1][i], batch->origin[2][i]),
             (real3)(batch->direction[0][i], batch->direction[1][i], batch->direction[2][i])};
  return ray;
}

INLINE PhotonState stream_get(const PhotonStream *batch, uint i) {
  PhotonState photon;
  photon.ray = stream_ray(batch, i);
  photon.flux = (real3)(batch->flux[0][i], batch->flux[1][i], batch->flux[2][i]);
  photon.mark = batch->mark[i];
  photon.prefix = HAS(OUTPUT_LIGHT_PASSES) ? batch->prefix[i] : PREFIX_DIRECT;
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) photon.interior = batch->interior[i];
  if (HAS(EFFECT_NESTED)) photon.media = batch->media[i], photon.diagnostics = 0;
  return photon;
}

INLINE void stream_put(PhotonStream *batch, uint i, const PhotonState *photon) {
  real3 origin = photon->ray.origin, direction = photon->ray.direction, flux = photon->flux;
  batch->origin[0][i] = origin.x, batch->origin[1][i] = origin.y, batch->origin[2][i] = origin.z;
  batch->direction[0][i] = direction.x, batch->direction[1][i] = direction.y, batch->direction[2][i] = direction.z;
  batch->flux[0][i] = flux.x, batch->flux[1][i] = flux.y, batch->flux[2][i] = flux.z;
  batch->mark[i] = photon->mark;
  if (HAS(OUTPUT_LIGHT_PASSES)) batch->prefix[i] = photon->prefix;
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) batch->interior[i] = photon->interior;
  if (HAS(EFFECT_NESTED)) batch->media[i] = photon->media;
}

INLINE void stream_put_record(PhotonStream *batch, uint i, const Photon *record) {
  batch->position[0][i] = record->position[0], batch->position[1][i] = record->position[1];
  batch->position[2][i] = record->position[2];
  batch->normal[i] = record->normal, batch->flux_rg[i] = record->flux_rg, batch->flux_b[i] = record->flux_b;
}

// Moves photon `from` to place `to`.
INLINE void stream_move(PhotonStream *batch, uint from, uint to) {
  for (uint k = 0; k < 3; ++k) {
    batch->origin[k][to] = batch->origin[k][from];
    batch->direction[k][to] = batch->direction[k][from];
    batch->flux[k][to] = batch->flux[k][from];
  }
  batch->index[to] = batch->index[from];
  batch->bounce[to] = batch->bounce[from];
  batch->mark[to] = batch->mark[from];
  if (HAS(OUTPUT_LIGHT_PASSES)) batch->prefix[to] = batch->prefix[from];
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) batch->interior[to] = batch->interior[from];
  if (HAS(EFFECT_NESTED)) batch->media[to] = batch->media[from];
  if (!HAS(EFFECT_GUIDED_PHOTONS)) return;
  batch->copy[to] = batch->copy[from];
  batch->fresh[to] = batch->fresh[from];
  batch->seed[to] = batch->seed[from];
  batch->useful[to] = batch->useful[from];
}
