// Russian roulette of camera paths.
#include "core/prelude.cl"

// From this bounce on, camera paths may end by Russian roulette.
#define ROULETTE_BOUNCE 5u

// Whether a camera path goes on after hit number `bounce`; a survivor of Russian roulette carries what the
// others would have carried.
INLINE bool path_survives(real3 *throughput, uint bounce, real random) {
  if (bounce >= ROULETTE_BOUNCE) {
    real survival = fmin(max_component(*throughput), (real)1);
    if (random >= survival) return false;
    *throughput /= survival;
  }
  return max_component(*throughput) > 0;
}
