// Photons on their way in a batch: what each carries, by component, so that the steps of a path that all take alike
// are loops over them which PoCL's compiler turns into vector code. See vector.cl for what such a loop may hold.
#include "media/interior.cl"
#include "film/light_passes.cl"
#include "scene/path_media.cl"
#include "sampling/rng.cl"
#include "core/stream_size.cl"

// Photons for each item of a work-group, whose first item traces those of all, and places that must be free before new
// photons join the wave.
#define PHOTONS_AN_ITEM 4u
#define PATH_REGENERATION 16u

// Effects with which the loop over a step is not vectorised: those that ask for loops, or for arithmetic of whole vectors,
// on the way. Then branches spare work, which selections would do for nothing.
#define EFFECTS_NOT_BATCHED_IN_EVENTS                                                                                        \
  (EFFECT_PLANES | EFFECT_DISKS | EFFECT_BEZIER | EFFECT_TEXTURES | EFFECT_ROUGH | EFFECT_CONDUCTOR |        \
   EFFECT_PLASTIC | EFFECT_ABSORPTION | EFFECT_DISPERSION | EFFECT_MEDIUM | EFFECT_NESTED)
#define EFFECTS_NOT_BATCHED_IN_EMISSION                                                                                      \
  (EFFECT_BEZIER | EFFECT_ENVIRONMENT | EFFECT_DELTA_LIGHTS | EFFECT_ABSORPTION | EFFECT_MEDIUM | EFFECT_NESTED)

// Whether the rays of a wave meet all primitives in place of walking the tree each: the host asks for it where they are
// few.
#if defined(BRUTE_FORCE) && STREAM_CAPACITY > 1u
#define STREAM_BRUTE_FORCE
#endif

// What befell a photon at one event of its path, as bits.
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

INLINE Ray stream_ray(const PhotonStream *wave, uint i) {
  Ray ray = {(real3)(wave->origin[0][i], wave->origin[1][i], wave->origin[2][i]),
             (real3)(wave->direction[0][i], wave->direction[1][i], wave->direction[2][i])};
  return ray;
}

INLINE PhotonState stream_get(const PhotonStream *wave, uint i) {
  PhotonState photon;
  photon.ray = stream_ray(wave, i);
  photon.flux = (real3)(wave->flux[0][i], wave->flux[1][i], wave->flux[2][i]);
  photon.mark = wave->mark[i];
  photon.prefix = HAS(OUTPUT_LIGHT_PASSES) ? wave->prefix[i] : PREFIX_DIRECT;
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) photon.interior = wave->interior[i];
  if (HAS(EFFECT_NESTED)) photon.media = wave->media[i], photon.diagnostics = 0;
  return photon;
}

INLINE void stream_put(PhotonStream *wave, uint i, const PhotonState *photon) {
  real3 origin = photon->ray.origin, direction = photon->ray.direction, flux = photon->flux;
  wave->origin[0][i] = origin.x, wave->origin[1][i] = origin.y, wave->origin[2][i] = origin.z;
  wave->direction[0][i] = direction.x, wave->direction[1][i] = direction.y, wave->direction[2][i] = direction.z;
  wave->flux[0][i] = flux.x, wave->flux[1][i] = flux.y, wave->flux[2][i] = flux.z;
  wave->mark[i] = photon->mark;
  if (HAS(OUTPUT_LIGHT_PASSES)) wave->prefix[i] = photon->prefix;
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) wave->interior[i] = photon->interior;
  if (HAS(EFFECT_NESTED)) wave->media[i] = photon->media;
}

INLINE void stream_put_record(PhotonStream *wave, uint i, const Photon *record) {
  wave->position[0][i] = record->position[0], wave->position[1][i] = record->position[1];
  wave->position[2][i] = record->position[2];
  wave->normal[i] = record->normal, wave->flux_rg[i] = record->flux_rg, wave->flux_b[i] = record->flux_b;
}

// Moves photon `from` to place `to`.
INLINE void stream_move(PhotonStream *wave, uint from, uint to) {
  for (uint k = 0; k < 3; ++k) {
    wave->origin[k][to] = wave->origin[k][from];
    wave->direction[k][to] = wave->direction[k][from];
    wave->flux[k][to] = wave->flux[k][from];
  }
  wave->index[to] = wave->index[from];
  wave->bounce[to] = wave->bounce[from];
  wave->mark[to] = wave->mark[from];
  if (HAS(OUTPUT_LIGHT_PASSES)) wave->prefix[to] = wave->prefix[from];
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) wave->interior[to] = wave->interior[from];
  if (HAS(EFFECT_NESTED)) wave->media[to] = wave->media[from];
  if (!HAS(EFFECT_GUIDED_PHOTONS)) return;
  wave->copy[to] = wave->copy[from];
  wave->fresh[to] = wave->fresh[from];
  wave->seed[to] = wave->seed[from];
  wave->useful[to] = wave->useful[from];
}
