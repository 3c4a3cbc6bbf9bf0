// The mean of a pixel's probes, see kernel_area.cl. SppmPixel.coverage holds two of them, for the radius and for half of it, in
// 16 bits each: seven bits of how many probes, and the others of their sum.
#include "core/prelude.cl"
#include "shared/types.h"

// Where so many are counted, all count half from then on: radii shrink, and old probes are of larger ones. Even, so that
// half of as many full discs are full discs.
#define KERNEL_AREA_PROBES 126u
#define KERNEL_AREA_COUNT_MASK 127u

// A pixel whose first so many probes found full discs is probed once in so many passes: an odd number, so that it is the turn
// of each of its samples.
#define KERNEL_AREA_FIRST_PROBES 6u
#define KERNEL_AREA_RARELY 7u

// Less is taken for this: a mean of few probes that found something is too noisy to divide by.
#define KERNEL_AREA_LEAST 0.125f

// A pixel's state with one probe more. `odd` alternates, to which side halves are rounded.
INLINE uint kernel_area_add(uint state, uint probe, uint odd) {
  if (!(probe & KERNEL_AREA_PROBED)) return state;
  uint shift = (probe & KERNEL_AREA_OF_HALF) ? 16u : 0u, mean = state >> shift & 0xffffu;
  uint count = mean & KERNEL_AREA_COUNT_MASK, sum = mean >> 7u;
  if (count == KERNEL_AREA_PROBES) {
    count = KERNEL_AREA_PROBES / 2;
    sum = (sum + (odd & 1u)) / 2;
  }
  mean = (count + 1) | (sum + (probe >> KERNEL_AREA_SHIFT & 3u)) << 7u;
  return (state & ~(0xffffu << shift)) | mean << shift;
}

// Whether a probe is worth its ray. Where a pixel's probes have found other than full discs, that of each of its points;
// before, that of one of them, and after the first few only in every seventh pass, in turn with other pixels.
INLINE bool kernel_area_wanted(uint state, uint pixel, uint pass, bool in_turn) {
  uint whole = state & 0xffffu, half_radius = state >> 16u;
  uint probes = whole & KERNEL_AREA_COUNT_MASK;
  bool full = whole >> 7u == probes && half_radius >> 7u == (half_radius & KERNEL_AREA_COUNT_MASK);
  return !full || (in_turn && (probes < KERNEL_AREA_FIRST_PROBES || (pixel + pass) % KERNEL_AREA_RARELY == 0));
}

// A full disc counts as one more probe, so that few of them do not say much.
INLINE float kernel_area_mean(uint mean) { return (float)((mean >> 7u) + 1u) / (float)((mean & KERNEL_AREA_COUNT_MASK) + 1u); }

// The fraction of a disc that is covered, for `radius_ratio` times the radius that probes are of. What an
// edge takes from a disc goes with its radius.
INLINE float kernel_area_of(uint state, float radius_ratio) {
  float whole = kernel_area_mean(state & 0xffffu), half_radius = kernel_area_mean(state >> 16u);
  float covered = half_radius + (whole - half_radius) * (2 * radius_ratio - 1);
  return clamp(covered, KERNEL_AREA_LEAST, fmax(fmax(whole, half_radius), 1.0f));
}
