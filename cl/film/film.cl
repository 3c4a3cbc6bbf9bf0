// The film: exact sums of radiance estimates.
#include "sampling/half_buffers.cl"
#include "film/light_passes.cl"
#include "core/prelude.cl"
#include "shared/types.h"

INLINE float luminance(float red, float green, float blue) { return 0.2126f * red + 0.7152f * green + 0.0722f * blue; }

INLINE void film_sum(global ExactSum *sum, float x) {
  if (x != 0) *sum = exact_sum_add(*sum, x);
}

// Adds the radiance estimate of pass `pass` to a pixel. One that is not finite, or that no float holds, is left out of the
// mean, and counted. `kernel_bias` is what the estimate's luminance owes to the size of its kernel, as far as gather() can
// tell.
INLINE bool film_add(global FilmPixel *pixel, real3 radiance, real kernel_bias, uint pass,
                     volatile global Counters *counters) {
  uint in_half = half_of_passes(pass);
  float value[3] = {(float)radiance.x, (float)radiance.y, (float)radiance.z};
  if (!(isfinite(value[0]) && isfinite(value[1]) && isfinite(value[2]))) {
    bool saturated = isfinite(radiance.x) && isfinite(radiance.y) && isfinite(radiance.z);
    atomic_inc(saturated ? &counters->saturated : &counters->non_finite);
    ++pixel->left_out[in_half];
    return false;
  }
  for (int c = 0; c < 3; ++c) film_sum(pixel->radiance + c, value[c]);
  // Halves of the numbers have sums that are finite.
  float light = 2 * luminance(0.5f * value[0], 0.5f * value[1], 0.5f * value[2]);
  uint bits = squared_bits(fabs(light));
  if (bits != 0) {
    film_sum(pixel->luminance + in_half, copysign(as_float(bits), light));
    pixel->luminance2 = exact_sum_add_square(pixel->luminance2, bits);
  }
  if (isfinite((float)kernel_bias)) film_sum(pixel->kernel_bias + in_half, (float)kernel_bias);
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
    film_sum(layers->radiance[i], (float)radiance->layer[i].x);
    film_sum(layers->radiance[i] + 1, (float)radiance->layer[i].y);
    film_sum(layers->radiance[i] + 2, (float)radiance->layer[i].z);
  }
}
