// The halves into which a pixel's passes fall, by Thue and Morse: of passes 2 m and 2 m + 1 one is in either, and what
// drifts, or comes again every two or four passes, is alike in both over eight. The camera paths of the halves draw
// independent numbers (sobol.cl), so that the difference of their means tells the error of the mean of all (film.cl).
#include "core/prelude.cl"

// 0 or 1.
INLINE uint half_of_passes(uint pass) { return popcount(pass) & 1u; }

// How many of the first `passes` passes are in half `of_half`.
INLINE uint passes_of_half(uint passes, uint of_half) {
  return passes / 2 + ((passes & 1u) != 0 && half_of_passes(passes - 1u) == of_half ? 1u : 0u);
}
