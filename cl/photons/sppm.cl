// The progressive radius (Hachisuka & Jensen 2009, equations 8 and 9).
#include "film/film.cl"
#include "shared/types.h"

// Adds x to the unevaluated sum *hi + *lo: the rounding error of each addition (Knuth's TwoSum) is kept, so
// 10^8 additions lose nothing that matters, where a plain float stops growing.
INLINE void sum_add(float *hi, float *lo, float x) {
  float s = *hi + x;
  float b = s - *hi;
  float error = (*hi - (s - b)) + (x - b);
  float tail = *lo + error;
  *hi = s + tail;
  *lo = tail - (*hi - s);
}

// Photons found so far by a pixel, as a number.
INLINE float sppm_photons(SppmPixel pixel) { return pixel.photons_high * 4294967296.0f + pixel.photons_low; }

// With so many more found.
INLINE SppmPixel sppm_count(SppmPixel pixel, uint found) {
  ulong photons = add_sat(upsample(pixel.photons_high, pixel.photons_low), (ulong)found);
  pixel.photons_high = (uint)(photons >> 32);
  pixel.photons_low = (uint)photons;
  return pixel;
}

// The pixel's statistics after `found` photons in a pass:
//   N' = N + alpha M,  R'^2 = R^2 (N + alpha M) / (N + M).
// N is alpha times the number of all photons so far, which is kept as an integer. The quotient is
// 1 - (1 - alpha) M / (N + M), and only that small correction is rounded: R^2 as hi + lo then stays within
// 1e-6 of exact over 10^6 passes, where a float recursion drifts by up to 3%. M = 0 changes no bit.
//
// The paper's accumulated flux tau needs no state of its own: by (11) tau_i / R_i^2 = sum of Phi_j / R_j^2, so
// equation (7) is the mean over passes of Phi_j / (pi R_j^2 photons per pass), and that sum is the film's.
INLINE SppmPixel sppm_update(SppmPixel pixel, uint found, float alpha) {
  if (found == 0) return pixel;
  float m = (float)found, before = sppm_photons(pixel), total = alpha * before + m;
  float fraction = (1 - alpha) * m / total;
  if (fraction > 0.5f) {
    // The first passes, alpha small: what remains is the smaller part, so it is what must be rounded.
    float kept = alpha * (before + m) / total;
    pixel.radius2_hi *= kept;
    pixel.radius2_lo *= kept;
  } else {
    sum_add(&pixel.radius2_hi, &pixel.radius2_lo, -fraction * pixel.radius2_lo);
    sum_add(&pixel.radius2_hi, &pixel.radius2_lo, -fraction * pixel.radius2_hi);
  }
  // Some devices flush what is smaller than the smallest normal number to a radius of zero, which would divide.
  if (!(pixel.radius2_hi >= FLT_MIN)) {
    pixel.radius2_hi = FLT_MIN;
    pixel.radius2_lo = 0;
  }
  return sppm_count(pixel, found);
}
