// The layers of a picture, by the history of each path. They add up to the radiance.
//
// The receiver of a camera path is its first vertex that scatters by other than a perfectly specular lobe: a diffuse
// surface, a rough lobe, the medium. In Heckbert's notation (1990), with S a perfectly specular vertex, D any other:
//   direct    E S* L and E S* D L: emission that is seen, and light that comes to the receiver straight from its source
//   caustic   E S* D S+ L: light that met only mirrors, glass and polished metal on its way to the receiver
//   indirect  all else
#include "core/prelude.cl"
#include "shared/effects.h"
#include "shared/types.h"

// What lies between the receiver and the end of a camera path, or between the source of a photon and where it is: the
// same history, read from either end.
#define HISTORY_NO_RECEIVER 0u  // of a camera path alone
#define HISTORY_STRAIGHT 1u
#define HISTORY_SPECULAR 2u
#define HISTORY_SCATTERED 3u

// The history beyond a vertex that scattered the path.
INLINE uint history_after(uint history, bool specular) {
  if (specular) return history == HISTORY_STRAIGHT ? HISTORY_SPECULAR : history;
  return history == HISTORY_NO_RECEIVER ? HISTORY_STRAIGHT : HISTORY_SCATTERED;
}

// LAYER_*: of light whose source lies at the end of that history.
INLINE uint history_layer(uint history) { return max(history, HISTORY_STRAIGHT) - HISTORY_STRAIGHT; }

// The mark of a visible point at the end of that history.
INLINE uint receiver_mark(uint history) {
  return HAS(OUTPUT_LAYERS) && history != HISTORY_NO_RECEIVER ? BEYOND_RECEIVER : 0u;
}

// Radiance along a path, and what of it belongs to each layer.
typedef struct {
  real3 sum;
  real3 layer[LAYER_COUNT];  // with OUTPUT_LAYERS
} Radiance;

INLINE Radiance radiance_none(void) {
  Radiance radiance;
  radiance.sum = (real3)(0, 0, 0);
  if (HAS(OUTPUT_LAYERS))
    for (uint i = 0; i < LAYER_COUNT; ++i) radiance.layer[i] = (real3)(0, 0, 0);
  return radiance;
}

// Adds what a path finds at the end of that history.
INLINE void radiance_add(Radiance *radiance, uint history, real3 found) {
  radiance->sum += found;
  if (HAS(OUTPUT_LAYERS)) radiance->layer[history_layer(history)] += found;
}
