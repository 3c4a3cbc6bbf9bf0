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

// A pixel's sums over its radiance estimates, one per pass, and what tells how far their mean may be off. All are exact, and
// the same whatever the order of the passes; what belongs to a half of the passes (half_buffers.cl) has an element for each.
typedef struct {
  ExactSum radiance[3];
  ExactSum luminance[2];    // of the upper 14 bits of each estimate's: see squared_bits()
  ExactSum luminance2;      // of the squares of these
  ExactSum kernel_bias[2];  // what luminance owes to the photons' kernel
  uint left_out[2];         // estimates that were not finite: the means are over the others
  float missed;             // luminance that photons which the pixel does not find may bring, see unknown_error.cl; negative
                            //   where it has found any
  uint unused;
} FilmPixel;
CHECK_SIZE(FilmPixel, 144);

// What a look at the film makes of it, in luminance.
typedef struct {
  float estimates;        // that the means are over
  float luminance;        // their mean
  float deviation;        // their standard deviation from it
  float kernel_bias[2];   // the mean of each half of the passes
  float half_difference;  // half by how much the mean of one half is above that of the other, as PixelError has it
  uint unknown;           // 1 where the error of the mean cannot be told: see unknown_error.cl
} PixelStatistics;
CHECK_SIZE(PixelStatistics, 28);

// The layers of a picture, see light_passes.cl.
#define LIGHT_PASS_DIRECT 0u
#define LIGHT_PASS_CAUSTIC 1u
#define LIGHT_PASS_INDIRECT 2u
#define LIGHT_PASS_COUNT 3u

// A pixel's sums of what belongs to each layer, as FilmPixel has them of the whole. With OUTPUT_LIGHT_PASSES those of all
// pixels follow the film in its buffer.
typedef struct {
  ExactSum radiance[LIGHT_PASS_COUNT][3];
} FilmLightPasses;
CHECK_SIZE(FilmLightPasses, 144);

// How far a pixel's luminance may be off.
typedef struct {
  float luminance;     // the mean of its estimates
  float noise;         // standard deviation of that by the pixel's own passes: its course tells that of the picture's noise
  float pooled_noise;  // the same, such that it is right of this pixel: see pixel_error of pass_film.cl
  float bias;          // absolute; infinite where the error cannot be told
  float half_difference;         // an error as noise makes it: half by how much one half of the passes is brighter than the other
} PixelError;
CHECK_SIZE(PixelError, 20);
