// Russian roulette of camera paths.
#include "core/prelude.cl"

// Camera paths of more hits than this may end by Russian roulette.
#define ROULETTE_DEPTH 5u

// Whether a camera path goes on after hit number `depth`; a survivor of Russian roulette carries what the others
// would have carried.
INLINE bool path_survives(real3 *throughput, uint depth, real random) {
  if (depth >= ROULETTE_DEPTH) {
    real survival = fmin(max_component(*throughput), (real)1);
    if (random >= survival) return false;
    *throughput /= survival;
  }
  return max_component(*throughput) > 0;
}
