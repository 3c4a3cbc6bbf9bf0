// The film: exact running sums of radiance estimates.
#include "prelude.cl"
#include "types.h"

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

// Adds one radiance estimate to a pixel. One that is not finite, or with which the sum would not be, is left out of
// the mean, and counted.
INLINE void film_add(global FilmPixel *pixel, real3 radiance, volatile global Counters *counters) {
  if (!(isfinite(radiance.x) && isfinite(radiance.y) && isfinite(radiance.z))) {
    atomic_inc(&counters->non_finite);
    ++pixel->left_out;
    return;
  }
  float value[3] = {(float)radiance.x, (float)radiance.y, (float)radiance.z}, hi[3], lo[3];
  for (int c = 0; c < 3; ++c) {
    hi[c] = pixel->sum[c];
    lo[c] = pixel->low[c];
    sum_add(hi + c, lo + c, value[c]);
  }
  if (!(isfinite(hi[0]) && isfinite(hi[1]) && isfinite(hi[2]))) {
    atomic_inc(&counters->saturated);
    ++pixel->left_out;
    return;
  }
  for (int c = 0; c < 3; ++c) {
    pixel->sum[c] = hi[c];
    pixel->low[c] = lo[c];
  }
}
