// What the film tells of its own error.
#include "film/pixel_statistics.cl"

// Pixels to each side over which variance and blur are pooled.
#define REACH 1

// Squares of the blur that are less than this many times what noise makes of them are none: with 1, a third of the pixels
// without any blur would pass for blurred, and their error with them.
#define NOISE_OF_KERNEL_BIAS 2.0f

// What of a pixel's variance, in PixelError.noise, is that of its neighbours. Rare bright paths have not been seen in most
// pixels, and in the others they have been seen too often: over all pixels the two make up for each other, nearly.
#define NEIGHBOURS_WEIGHT 0.02f

// Pixels to each side over which a pixel's bound looks for noise as well, and after how many passes half of that counts
// at least: where bright paths are rare, the first passes may have missed all of the pixels beside.
#define BOUND_REACH 2
#define BOUND_PASSES 12.0f

// Pixels to each side over which the noise of halves is compared with that of passes. Seven times seven tell a variance
// to a fifth.
#define HALF_BUFFERS_REACH 3

// The bias of a kernel over its difference to one of half the radius. Where illumination is smooth the bias goes with
// the area (Hachisuka, Jarosz & Jensen 2010, equation 10), and this is 4/3; along edges, of caustics and of shadows,
// the band that is wrong is as wide as the radius, and this is 2. Most of what is wrong lies along edges.
#define BIAS_OF_KERNEL 2.0f

// The window of at most 2 reach + 1 pixels around x that lies in [0, size): *first and its end.
INLINE uint window_of(uint x, uint size, uint reach, uint *first) {
  *first = x > reach ? x - reach : 0u;
  return min(x + reach + 1, size);
}

// Pixels to each side whose spread and blur pixel_error() reads: of windows of blur beside that of the pixel.
#define ERROR_REACH (3 * REACH + 1)

// A power of two that brings what pixel_error() squares near to 1: squares of very dim and very bright light are beyond
// floats. Errors are computed in its units.
INLINE float unit_around(global const PixelStatistics *pixels, uint width, uint height, uint x, uint y) {
  uint left, top, right = window_of(x, width, ERROR_REACH, &left), bottom = window_of(y, height, ERROR_REACH, &top);
  float largest = 0;
  for (uint j = top; j < bottom; ++j)
    for (uint i = left; i < right; ++i) {
      global const PixelStatistics *pixel = pixels + j * width + i;
      largest = fmax(largest, fmax(pixel->deviation, fmax(fabs(pixel->kernel_bias[0]), fabs(pixel->kernel_bias[1]))));
    }
  return largest > 0 ? ldexp(1.0f, -clamp(ilogb(largest), -100, 100)) : 1.0f;
}

// In squared units, as all variances here.
INLINE float variance_of_mean(global const PixelStatistics *pixel, float unit) {
  float deviation = pixel->deviation * unit;
  return deviation * deviation / fmax(pixel->estimates - 1, 1.0f);
}

// The mean of variances over the window around (x, y).
INLINE float variance_around(global const PixelStatistics *pixels, uint width, uint height, uint x, uint y, uint reach,
                             float unit) {
  uint left, top, right = window_of(x, width, reach, &left), bottom = window_of(y, height, reach, &top);
  float sum = 0;
  for (uint j = top; j < bottom; ++j)
    for (uint i = left; i < right; ++i) sum += variance_of_mean(pixels + j * width + i, unit);
  return sum / ((right - left) * (bottom - top));
}

// The variance of means around (x, y) over what it were if a pixel's estimates were independent of each other. The
// difference of halves tells it, since these are independent, but only where it is not that of the pixels beside.
INLINE float variance_ratio(global const PixelStatistics *pixels, uint width, uint height, uint x, uint y,
                            float unit) {
  uint left, top, right = window_of(x, width, HALF_BUFFERS_REACH, &left), bottom = window_of(y, height, HALF_BUFFERS_REACH, &top);
  float squares = 0, variances = 0;
  for (uint j = top; j < bottom; ++j)
    for (uint i = left; i < right; ++i) {
      global const PixelStatistics *pixel = pixels + j * width + i;
      float difference = pixel->half_difference * unit;
      squares += difference * difference;
      variances += variance_of_mean(pixel, unit);
    }
  float ratio = squares / variances;
  return variances > 0 && isfinite(ratio) ? ratio : 1.0f;
}

// The blur of the window around (x, y), as far as it lies within the picture: of the halves of the passes the mean, and
// half of what the first has more; none where all lies outside.
typedef struct {
  float mean, deviation;
  uint pixels;
} KernelBias;
// Not inlined: the compiler of PoCL 6 (LLVM 19) fails on the kernel otherwise.
OUTLINE KernelBias kernel_bias_around(global const PixelStatistics *pixels, uint width, uint height, int x, int y, float unit) {
  float first = 0, second = 0;
  KernelBias kernel_bias = {0, 0, 0};
  for (int j = max(y - REACH, 0); j < min(y + REACH + 1, (int)height); ++j)
    for (int i = max(x - REACH, 0); i < min(x + REACH + 1, (int)width); ++i, ++kernel_bias.pixels) {
      first += pixels[j * width + i].kernel_bias[0] * unit;
      second += pixels[j * width + i].kernel_bias[1] * unit;
    }
  if (kernel_bias.pixels == 0) return kernel_bias;
  first /= (float)kernel_bias.pixels;
  second /= (float)kernel_bias.pixels;
  kernel_bias.mean = (first + second) / 2;
  kernel_bias.deviation = (first - second) / 2;
  return kernel_bias;
}

// Error of `pixel` in luminance. `low_discrepancy` tells that a pixel's estimates are more even than
// independent ones (sobol.cl), and owe nothing to what other pixels have in common.
//   noise: the standard deviation of the mean; its variance is that of the estimates over their number, whatever
//          schedule their radii follow, times variance_ratio() where they are even. What the pixel's own passes say of
//          it is right on average, but in few passes it is itself noisy; pooled_noise takes the mean of variances around,
//          which is smooth, but too large for most pixels beside edges and glints, and no less than a part of
//          the mean further around, which goes down with passes.
//   bias:  its absolute value, from the blur around the pixel, once of each half of the passes. Both have noises of their
//          own, so that half their difference is as noisy as their mean: the square of the first, over the pixel's window
//          and the eight beside it, is what the square of the second owes to noise.
//   half_difference: of the means of both halves of the passes. It is made of the same estimates as the error of their
//          mean, but for signs, and has its variance and kurtosis.
INLINE PixelError pixel_error(global const PixelStatistics *pixels, uint width, uint height, uint pixel,
                              bool low_discrepancy) {
  uint x = pixel % width, y = pixel / width;
  global const PixelStatistics *p = pixels + pixel;
  float unit = unit_around(pixels, width, height, x, y);
  float pooled = variance_around(pixels, width, height, x, y, REACH, unit);
  float further = variance_around(pixels, width, height, x, y, BOUND_REACH, unit);
  float bound = fmax(pooled, BOUND_PASSES / (BOUND_PASSES + p->estimates) * further);
  KernelBias own = kernel_bias_around(pixels, width, height, (int)x, (int)y, unit);
  float noise = 0, windows = 0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      KernelBias beside = kernel_bias_around(pixels, width, height, (int)x + i * (2 * REACH + 1), (int)y + j * (2 * REACH + 1), unit);
      noise += beside.deviation * beside.deviation;
      windows += beside.pixels > 0 ? 1.0f : 0.0f;
    }
  PixelError error;
  error.luminance = p->luminance;
  float ratio = low_discrepancy ? variance_ratio(pixels, width, height, x, y, unit) : 1.0f;
  float own_variance = variance_of_mean(p, unit);
  error.noise = sqrt(ratio * ((1 - NEIGHBOURS_WEIGHT) * own_variance + NEIGHBOURS_WEIGHT * pooled)) / unit;
  error.pooled_noise = sqrt(ratio * bound) / unit;
  error.bias = BIAS_OF_KERNEL * sqrt(fmax(own.mean * own.mean - NOISE_OF_KERNEL_BIAS * noise / windows, 0.0f)) / unit;
  error.half_difference = p->half_difference;
  if (p->unknown != 0) error.bias = INFINITY;
  return error;
}

// What a look at `count` pixels of the film, after so many passes of each half, makes of them. *found is not 0 where any has
// found a photon.
kernel void film_statistics(global const FilmPixel *film, global PixelStatistics *pixels, volatile global uint *found,
                            uint2 passes, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  pixels[i] = pixel_statistics(film + i, passes);
  // Neighbours mostly agree: the first of a row of such pixels tells for all.
  if (film[i].missed < 0 && (i == 0 || !(film[i - 1].missed < 0))) atomic_or(found, 1u);
}

// errors[i] = error of pixel i * stride of a part of `size` pixels: its first column and row, its width and height; for
// i < count. With *found = 0 photons are stored of which no pixel has found any: then the error of all is unknown.
kernel void pixel_errors(global const PixelStatistics *pixels, global PixelError *errors, global const uint *found,
                         uint2 size, uint4 part, uint stride, uint count, uint low_discrepancy) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint x = part.x + i * stride % part.z, y = part.y + i * stride / part.z;
  errors[i] = pixel_error(pixels, size.x, size.y, y * size.x + x, low_discrepancy != 0);
  if (*found == 0) errors[i].bias = INFINITY;
}
