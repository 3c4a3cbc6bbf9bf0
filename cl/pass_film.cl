// What the film tells of its own error.
#include "film.cl"

// Pixels to each side over which variance and bias are pooled. A variance of few passes is itself noisy, and rare
// bright paths hide from most pixels.
#define VARIANCE_REACH 1
#define BIAS_REACH 3

// The bias of a kernel over its difference to one of half the radius. Where illumination is smooth the bias goes with
// the area (Hachisuka, Jarosz & Jensen 2010, equation 10), and this is 4/3; along edges, of caustics and of surfaces,
// the band that is wrong is as wide as the radius, and this is 2. Most of what is wrong lies along edges.
#define BIAS_OF_BLUR 2.0f

// The window of at most 2 reach + 1 pixels around x that lies in [0, size): *first and its end.
INLINE uint window_of(uint x, uint size, uint reach, uint *first) {
  *first = x > reach ? x - reach : 0u;
  return min(x + reach + 1, size);
}

INLINE float film_estimates(global const FilmPixel *pixel, uint passes) { return (float)(passes - pixel->left_out); }

// Error of `pixel` after `passes` passes, in luminance.
//   noise: the standard deviation of the mean; its variance is that of the estimates over their number, whatever
//          schedule their radii follow.
//   bias:  its absolute value. The blur of the even passes and that of the odd ones have noises of their own, so that
//          the expectation of their product is the square of the blur. What is left of it above the standard error of
//          its mean over the window counts: where there is only noise, its root would pass for a bias.
INLINE PixelError pixel_error(global const FilmPixel *film, uint width, uint height, uint pixel, uint passes) {
  uint x = pixel % width, y = pixel / width, left, top;
  uint right = window_of(x, width, VARIANCE_REACH, &left), bottom = window_of(y, height, VARIANCE_REACH, &top);
  float variance = 0, sum = 0, sum_of_squares = 0;
  for (uint j = top; j < bottom; ++j)
    for (uint i = left; i < right; ++i) {
      global const FilmPixel *p = film + j * width + i;
      float estimates = film_estimates(p, passes);
      variance += p->spread / (fmax(estimates, 1.0f) * fmax(estimates - 1, 1.0f));
    }
  variance /= (right - left) * (bottom - top);
  right = window_of(x, width, BIAS_REACH, &left);
  bottom = window_of(y, height, BIAS_REACH, &top);
  float even = (passes + 1) / 2, odd = max(passes / 2, 1u);
  for (uint j = top; j < bottom; ++j)
    for (uint i = left; i < right; ++i) {
      float square = film[j * width + i].blur[0] / even * (film[j * width + i].blur[1] / odd);
      sum += square;
      sum_of_squares += square * square;
    }
  float count = (right - left) * (bottom - top), square = sum / count;
  square -= sqrt(fmax(sum_of_squares / count - square * square, 0.0f) / count);

  global const FilmPixel *p = film + pixel;
  PixelError error;
  error.luminance = luminance(p->sum[0], p->sum[1], p->sum[2]) / fmax(film_estimates(p, passes), 1.0f);
  error.noise = sqrt(variance);
  error.bias = BIAS_OF_BLUR * sqrt(fmax(square, 0.0f));
  return error;
}

// errors[i] = error of pixel i * stride, for i < count.
kernel void pixel_errors(global const FilmPixel *film, global PixelError *errors, uint width, uint height,
                         uint passes, uint stride, uint count) {
  uint i = get_global_id(0);
  if (i < count) errors[i] = pixel_error(film, width, height, i * stride, passes);
}
