// The film: exact running sums of radiance estimates.
#include "sampling/half_buffers.cl"
#include "film/light_passes.cl"
#include "core/prelude.cl"
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

INLINE float luminance(float red, float green, float blue) { return 0.2126f * red + 0.7152f * green + 0.0722f * blue; }

// The sign of the luminance of a pixel's estimate number `index` in FilmPixel.alternating. After an estimate that was
// left out, signs are no longer those of the halves, and tell an error as large as that of independent numbers.
INLINE float sign_of_estimate(uint index) { return half_of_passes(index) ? -1.0f : 1.0f; }

// sqrt(a^2 + b^2), whatever their size.
INLINE float root_of_squares(float a, float b) {
  float larger = fmax(fabs(a), fabs(b)), ratio = fmin(fabs(a), fabs(b)) / larger;
  return larger > 0 ? larger * sqrt(1 + ratio * ratio) : 0.0f;
}

// Adds the radiance estimate of pass `pass` to a pixel. One that is not finite, or with which the sum would not be, is
// left out of the mean, and counted. `blur` is what the estimate's luminance owes to the size of its kernel, as far as
// gather() can tell: see pass_film.cl for what becomes of it, of the spread, which goes on as Welford (1962) has it, and of
// the sum under changing signs. Spread and blur are kept as means: sums of floats would stop growing after 2^24 passes. The
// spread is kept as a deviation: squares of very dim and very bright light are beyond floats.
INLINE bool film_add(global FilmPixel *pixel, real3 radiance, real kernel_bias, uint pass,
                     volatile global Counters *counters) {
  if (!(isfinite(radiance.x) && isfinite(radiance.y) && isfinite(radiance.z))) {
    atomic_inc(&counters->non_finite);
    ++pixel->left_out;
    return false;
  }
  float value[3] = {(float)radiance.x, (float)radiance.y, (float)radiance.z}, before[3], hi[3], lo[3];
  for (int c = 0; c < 3; ++c) {
    before[c] = hi[c] = pixel->sum[c];
    lo[c] = pixel->low[c];
    sum_add(hi + c, lo + c, value[c]);
  }
  if (!(isfinite(hi[0]) && isfinite(hi[1]) && isfinite(hi[2]))) {
    atomic_inc(&counters->saturated);
    ++pixel->left_out;
    return false;
  }
  for (int c = 0; c < 3; ++c) {
    pixel->sum[c] = hi[c];
    pixel->low[c] = lo[c];
  }
  uint index = pass - pixel->left_out;
  float estimates = (float)index, added = luminance(value[0], value[1], value[2]);
  if (estimates > 0) {
    float deviation = added - luminance(before[0], before[1], before[2]) / estimates;
    float part = 1 / (estimates + 1), kept = estimates * part;
    pixel->m2_deviation = fmin(sqrt(kept) * root_of_squares(pixel->m2_deviation, deviation * sqrt(part)), FLT_MAX);
  }
  float signed_half_sum = pixel->signed_half_sum + sign_of_estimate(index) * added;
  pixel->signed_half_sum = clamp(signed_half_sum, -FLT_MAX, FLT_MAX);
  uint half_of_pass = half_of_passes(pass);
  float added_kernel_bias = isfinite(kernel_bias) ? (float)kernel_bias : 0.0f;
  pixel->kernel_bias[half_of_pass] += (added_kernel_bias - pixel->kernel_bias[half_of_pass]) / (passes_of_half(pass, half_of_pass) + 1.0f);
  return true;
}

// The same for pixel number `index` of `pixels`, with its layers.
INLINE void film_add_radiance(global FilmPixel *film, uint index, uint pixels, const Radiance *radiance, real kernel_bias,
                              uint pass, volatile global Counters *counters) {
  bool added = film_add(film + index, radiance->sum, kernel_bias, pass, counters);
  if (!HAS(OUTPUT_LIGHT_PASSES)) return;
  if (!added) return;
  global FilmLightPasses *layers = (global FilmLightPasses *)(film + pixels) + index;
  for (uint i = 0; i < LIGHT_PASS_COUNT; ++i) {
    float value[3] = {(float)radiance->layer[i].x, (float)radiance->layer[i].y, (float)radiance->layer[i].z};
    for (int c = 0; c < 3; ++c) {
      float hi = layers->sum[i][c], lo = layers->low[i][c];
      sum_add(&hi, &lo, value[c]);
      layers->sum[i][c] = hi;
      layers->low[i][c] = lo;
    }
  }
}
