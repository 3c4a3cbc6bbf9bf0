// The layers of a picture, by the history of each path. They add up to the radiance.
//
// The first diffuse vertex of a camera path is its first vertex that scatters by other than a perfectly specular lobe: a diffuse
// surface, a rough lobe, the medium. In Heckbert's notation (1990), with S a perfectly specular vertex, D any other:
//   direct    E S* L and E S* D L: emission that is seen, and light that comes to the first diffuse vertex straight from its source
//   caustic   E S* D S+ L: light that met only mirrors, glass and polished metal on its way to the first diffuse vertex
//   indirect  all else
#include "core/prelude.cl"
#include "shared/effects.h"
#include "shared/types.h"

// What lies between the first diffuse vertex and the end of a camera path, or between the source of a photon and where it is: the
// same history, read from either end.
#define PREFIX_NO_DIFFUSE 0u  // of a camera path alone
#define PREFIX_DIRECT 1u
#define PREFIX_SPECULAR 2u
#define PREFIX_SCATTERED 3u

// The history beyond a vertex that scattered the path.
INLINE uint prefix_after(uint prefix, bool specular) {
  if (specular) return prefix == PREFIX_DIRECT ? PREFIX_SPECULAR : prefix;
  return prefix == PREFIX_NO_DIFFUSE ? PREFIX_DIRECT : PREFIX_SCATTERED;
}

// LIGHT_PASS_*: of light whose source lies at the end of that history.
INLINE uint prefix_light_pass(uint prefix) { return max(prefix, PREFIX_DIRECT) - PREFIX_DIRECT; }

// The mark of a visible point at the end of that history.
INLINE uint diffuse_vertex_mark(uint prefix) {
  return HAS(OUTPUT_LIGHT_PASSES) && prefix != PREFIX_NO_DIFFUSE ? BEYOND_DIFFUSE : 0u;
}

// Radiance along a path, and what of it belongs to each layer.
typedef struct {
  real3 sum;
  real3 layer[LIGHT_PASS_COUNT];  // with OUTPUT_LIGHT_PASSES
} Radiance;

INLINE Radiance radiance_none(void) {
  Radiance radiance;
  radiance.sum = (real3)(0, 0, 0);
  if (HAS(OUTPUT_LIGHT_PASSES))
    for (uint i = 0; i < LIGHT_PASS_COUNT; ++i) radiance.layer[i] = (real3)(0, 0, 0);
  return radiance;
}

// Adds what a path finds at the end of that history.
INLINE void radiance_add(Radiance *radiance, uint prefix, real3 found) {
  radiance->sum += found;
  if (HAS(OUTPUT_LIGHT_PASSES)) radiance->layer[prefix_light_pass(prefix)] += found;
}
