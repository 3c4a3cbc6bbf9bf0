// What the sums of a pixel tell: means, and the deviation of its estimates.
#include "film/film.cl"

// Less than this, of what the pixel has, may be missing untold: see unknown_error.cl.
#define UNKNOWN_FRACTION 0.01f

// A number as an unevaluated sum hi + lo, of 44 bits and more.
typedef struct {
  float hi, lo;
} TwoFloats;

INLINE TwoFloats two_floats(float larger, float smaller) {
  float s = larger + smaller;
  TwoFloats result = {s, smaller - (s - larger)};
  return result;
}
INLINE TwoFloats two_floats_of(int64 x) {
  float hi = (float)x;
  return two_floats(hi, (float)(x - (int64)hi));
}

// a / b, whose remainder fma() has without rounding.
INLINE TwoFloats two_floats_quotient(TwoFloats a, TwoFloats b) {
  float quotient = a.hi / b.hi;
  float remainder = fma(-quotient, b.hi, a.hi) + fma(-quotient, b.lo, a.lo);
  return two_floats(quotient, remainder / b.hi);
}

// The sum over `count` in units of its bin, without what the rest of a bin of 2^28 has below 2^-44.
INLINE TwoFloats exact_sum_mean(ExactSum sum, TwoFloats count) {
  TwoFloats high = two_floats_of(sum.high), low = two_floats_of(exact_sum_low(sum));
  float unit = 1.0f / (1 << EXACT_SUM_BITS);
  TwoFloats head = two_floats(high.hi, low.hi * unit), swapped = two_floats(low.hi * unit, high.hi);
  TwoFloats total = fabs(high.hi) >= fabs(low.hi * unit) ? head : swapped;
  total.lo += high.lo + low.lo * unit;
  return two_floats_quotient(two_floats(total.hi, total.lo), count);
}

// x * 2^exponent in two steps, since the power alone may be beyond floats: ldexp() takes many times as long on some devices.
INLINE float scaled(float x, int exponent) {
  int half_way = clamp(exponent, -252, 252) / 2, rest = clamp(exponent, -252, 252) - half_way;
  return x * as_float((uint)(half_way + 127) << 23) * as_float((uint)(rest + 127) << 23);
}

// The exponent of the unit of the sum's bin.
INLINE int exact_sum_exponent(ExactSum sum) { return EXACT_SUM_BITS * exact_sum_bin(sum) - EXACT_SUM_UNIT; }

// The mean of `count` numbers as a float.
INLINE float exact_sum_mean_float(ExactSum sum, uint count) {
  float units = (float)sum.high + (float)exact_sum_low(sum) * (1.0f / (1 << EXACT_SUM_BITS));
  return scaled(units / (float)max(count, 1u), exact_sum_exponent(sum));
}

// The standard deviation of `count` numbers from their mean, by their sum and that of their squares. Both are exact, so
// that their difference keeps the digits which floats would lose.
INLINE float exact_deviation(ExactSum sum, ExactSum squares, uint count) {
  TwoFloats n = two_floats_of(max(count, 1u));
  TwoFloats mean = exact_sum_mean(sum, n), square = exact_sum_mean(squares, n);
  // In squared units of the sum's bin.
  int exponent = exact_sum_exponent(sum), scale = EXACT_SUM_BITS * (exact_sum_bin(squares) - 2 * exact_sum_bin(sum));
  float product = mean.hi * mean.hi, error = fma(mean.hi, mean.hi, -product) + 2 * mean.hi * mean.lo;
  float variance = (scaled(square.hi, scale) - product) + (scaled(square.lo, scale) - error);
  return scaled(sqrt(fmax(variance, 0.0f)), exponent);
}

// Of a pixel after `passes` passes of each half.
INLINE PixelStatistics pixel_statistics(global const FilmPixel *pixel, uint2 passes) {
  uint first = passes.x - pixel->left_out[0], second = passes.y - pixel->left_out[1], all = first + second;
  PixelStatistics result;
  result.estimates = (float)all;
  ExactSum luminance = exact_sum_of_parts(pixel->luminance[0], pixel->luminance[1]);
  result.luminance = exact_sum_mean_float(luminance, all);
  result.deviation = exact_deviation(luminance, pixel->luminance2, all);
  result.kernel_bias[0] = exact_sum_mean_float(pixel->kernel_bias[0], first);
  result.kernel_bias[1] = exact_sum_mean_float(pixel->kernel_bias[1], second);
  // Such that its variance is that of the mean of all, where the halves are not of one size either.
  float difference = exact_sum_mean_float(pixel->luminance[0], first) - exact_sum_mean_float(pixel->luminance[1], second);
  result.half_difference = difference * sqrt((float)first / fmax((float)all, 1.0f) * ((float)second / fmax((float)all, 1.0f)));
  result.unknown = pixel->missed > UNKNOWN_FRACTION * result.luminance ? 1u : 0u;
  return result;
}
