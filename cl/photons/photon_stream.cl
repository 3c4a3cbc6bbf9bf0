// Photons on their way in a batch: what each carries, by component, so that the steps of a path that all take alike
// are loops over them which PoCL's compiler turns into vector code. See vector.cl for what such a loop may hold.
#include "media/interior.cl"
#include "film/light_passes.cl"
#include "scene/path_media.cl"
#include "sampling/rng.cl"
#include "core/components.cl"
#include "core/stream_size.cl"
#include "shapes/ray_components.cl"

// Photons for each item of a work-group, whose first item traces those of all, and places that must be free before new
// photons join the batch.
#define PHOTONS_AN_ITEM 4u
#define PATH_REGENERATION 16u

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
  bool lambert;  // at a Lambert vertex: a constant, by which the compiler leaves out what other surfaces ask for
} PhotonState;

// What a batch keeps of each, as lists of components.cl. Fields that not every batch has stand last, so that the others keep
// their alignment.
#define PHOTON_COMPONENTS(ROW, x) /* of PhotonState, beside its ray */ \
  ROW(x, VECTOR, real, flux, flux, ALWAYS) \
  ROW(x, SCALAR, uint, mark, mark, ALWAYS)
#define PHOTON_PATH_COMPONENTS(ROW, x) /* of its path: the index of that in the pass, and the events that lie behind it */ \
  ROW(x, SCALAR, uint, index, index, ALWAYS) \
  ROW(x, SCALAR, uint, bounce, bounce, ALWAYS)
#define PHOTON_RECORD_COMPONENTS(ROW, x) /* of a Photon */ \
  ROW(x, ARRAY,  real, position, position, ALWAYS) \
  ROW(x, SCALAR, uint, normal, normal, ALWAYS) \
  ROW(x, SCALAR, uint, flux_rg, flux_rg, ALWAYS) \
  ROW(x, SCALAR, uint, flux_b, flux_b, ALWAYS)
#define PHOTON_PREFIX_COMPONENTS(ROW, x) ROW(x, SCALAR, uint, prefix, prefix, OUTPUT_LIGHT_PASSES)
#define PHOTON_BODY_COMPONENTS(ROW, x) /* of PhotonState, what bodies it is in */ \
  ROW(x, SCALAR, Interior, interior, interior, EFFECT_ABSORPTION | EFFECT_MEDIUM) \
  ROW(x, SCALAR, PathMedia, media, media, EFFECT_NESTED)
// `copy` and `fresh` as in RandomStream; `seed` is its place in the list of seeds; `useful` not 0 where it has landed where the
// camera sees.
#define METROPOLIS_COMPONENTS(ROW, x) \
  ROW(x, SCALAR, uint, copy, copy, EFFECT_GUIDED_PHOTONS) \
  ROW(x, SCALAR, uint, fresh, fresh, EFFECT_GUIDED_PHOTONS) \
  ROW(x, SCALAR, uint, seed, seed, EFFECT_GUIDED_PHOTONS) \
  ROW(x, SCALAR, uint, useful, useful, EFFECT_GUIDED_PHOTONS)

typedef struct {
  RAY_COMPONENTS(COMPONENT_FIELD, )
  PHOTON_COMPONENTS(COMPONENT_FIELD, )
  PHOTON_PATH_COMPONENTS(COMPONENT_FIELD, )
  HIT_COMPONENTS(COMPONENT_FIELD, )
  uint events[STREAM_CAPACITY];  // EVENT_* bits
  PHOTON_RECORD_COMPONENTS(COMPONENT_FIELD, )
  PHOTON_PREFIX_COMPONENTS(COMPONENT_FIELD, )
  PHOTON_BODY_COMPONENTS(COMPONENT_FIELD, )
  METROPOLIS_COMPONENTS(COMPONENT_FIELD, )
} PhotonStream;

INLINE Ray stream_ray(const PhotonStream *state, uint i) {
  Ray ray;
  RAY_COMPONENTS(LOAD_ENTRY, ray)
  return ray;
}

INLINE Hit stream_hit(const PhotonStream *state, uint i) {
  Hit hit;
  HIT_COMPONENTS(LOAD_ENTRY, hit)
  hit.diagnostics = 0;
  return hit;
}

INLINE void stream_put_hit(PhotonStream *state, uint i, Hit hit) { HIT_COMPONENTS(STORE_ENTRY, hit) }

// Takes photon `i` into *photon: one at a Lambert vertex without the bodies that it is in, which are none. That is told
// by a field, since of constant arguments PoCL's compiler makes new calls that vectorised loops may not hold.
INLINE void stream_get(const PhotonStream *state, uint i, PhotonState *photon) {
  photon->prefix = PREFIX_DIRECT;
  photon->diagnostics = 0;
  RAY_COMPONENTS(LOAD_ENTRY, photon->ray)
  PHOTON_COMPONENTS(LOAD_ENTRY, (*photon))
  PHOTON_PREFIX_COMPONENTS(LOAD_ENTRY, (*photon))
  if (!photon->lambert) {
    PHOTON_BODY_COMPONENTS(LOAD_ENTRY, (*photon))
  }
}

INLINE void stream_put(PhotonStream *state, uint i, const PhotonState *photon) {
  RAY_COMPONENTS(STORE_ENTRY, photon->ray)
  PHOTON_COMPONENTS(STORE_ENTRY, (*photon))
  PHOTON_PREFIX_COMPONENTS(STORE_ENTRY, (*photon))
  if (!photon->lambert) {
    PHOTON_BODY_COMPONENTS(STORE_ENTRY, (*photon))
  }
}

INLINE Photon stream_get_record(const PhotonStream *state, uint i) {
  Photon record;
  PHOTON_RECORD_COMPONENTS(LOAD_ENTRY, record)
  return record;
}

INLINE void stream_put_record(PhotonStream *state, uint i, const Photon *record) {
  PHOTON_RECORD_COMPONENTS(STORE_ENTRY, (*record))
}

// Makes photon `i` what photon `from` is, but for its hit and its record.
INLINE void stream_move(PhotonStream *state, uint from, uint i) {
  RAY_COMPONENTS(MOVE_ENTRY, from)
  PHOTON_COMPONENTS(MOVE_ENTRY, from)
  PHOTON_PATH_COMPONENTS(MOVE_ENTRY, from)
  PHOTON_PREFIX_COMPONENTS(MOVE_ENTRY, from)
  PHOTON_BODY_COMPONENTS(MOVE_ENTRY, from)
  METROPOLIS_COMPONENTS(MOVE_ENTRY, from)
}
