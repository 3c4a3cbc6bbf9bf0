// What is kept of every pixel from pass to pass, and what is known of its error. Part of types.h.
#pragma once

// What SPPM keeps of a pixel between passes besides the film: its squared radius as an unevaluated sum
// hi + lo, the number of all photons found so far, as two halves, and how much of its kernel lies on surfaces. N of the
// paper is alpha times the photons.
typedef struct {
  float radius2_hi, radius2_lo;
  uint photons_low, photons_high;
  uint coverage;  // see kernel_area_mean.cl
} SppmPixel;
CHECK_SIZE(SppmPixel, 20);

// A pixel's sum of radiance estimates, one per pass, each channel as an unevaluated sum hi + lo, and what tells how
// far their mean may be off.
typedef struct {
  float sum[3];
  float low[3];
  uint left_out;  // estimates that were not finite: the mean is over the others
  float m2_deviation;   // standard deviation of the estimates' luminance from their mean, over their number
  float kernel_bias[2];  // what luminance owes to the photons' kernel, the mean of each half of the passes
  float signed_half_sum;  // sum of the estimates' luminance under changing signs: see sign_of_estimate of film.cl
  uint unknown;       // 1 where the error of the mean cannot be told: see unknown_error.cl
} FilmPixel;
CHECK_SIZE(FilmPixel, 48);

// The layers of a picture, see light_passes.cl.
#define LIGHT_PASS_DIRECT 0u
#define LIGHT_PASS_CAUSTIC 1u
#define LIGHT_PASS_INDIRECT 2u
#define LIGHT_PASS_COUNT 3u

// A pixel's sums of what belongs to each layer, as FilmPixel has them of the whole. With OUTPUT_LIGHT_PASSES those of all
// pixels follow the film in its buffer.
typedef struct {
  float sum[LIGHT_PASS_COUNT][3];
  float low[LIGHT_PASS_COUNT][3];
} FilmLightPasses;
CHECK_SIZE(FilmLightPasses, 72);

// How far a pixel's luminance may be off.
typedef struct {
  float luminance;     // the mean of its estimates
  float noise;         // standard deviation of that by the pixel's own passes: its course tells that of the picture's noise
  float pooled_noise;  // the same, such that it is right of this pixel: see pixel_error of pass_film.cl
  float bias;          // absolute; infinite where the error cannot be told
  float half_difference;         // an error as noise makes it: half by how much one half of the passes is brighter than the other
} PixelError;
CHECK_SIZE(PixelError, 20);
