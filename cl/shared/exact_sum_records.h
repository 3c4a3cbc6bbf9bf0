// Sums of floats that are the same to the bit in whatever order and in whatever parts they are added up. Part of types.h.
//
// Reproducible summation (Demmel & Nguyen, "Parallel Reproducible Summation", 2015; Ahrens, Demmel & Nguyen 2020), in
// integers. The range of floats is cut into bins of EXACT_SUM_BITS bits, in the same places for all sums. A float, rounded
// to the nearest multiple of each bin's unit from the top down, falls into two neighbouring bins without a remainder. A sum
// keeps the integer sums of its two topmost bins; what lies below was never added, or is dropped when a larger number
// comes: since every bin is a sum of its own, both leave the same. What is lost of a number is at most 2^-28 of the largest
// one. 2^30 numbers fit.
#pragma once

#define EXACT_SUM_BITS 28
// The unit of bin 0: 2^-149, the smallest float, of sums; 2^-298 of sums of squares.
#define EXACT_SUM_UNIT 149
#define EXACT_SUM_BIN_MASK 31

// high * 2^(28 bin - 149) + low * 2^(28 (bin - 1) - 149). Zero as a whole is the empty sum.
typedef struct {
  int64 high;
  int64 low_and_bin;  // 32 low + bin
} ExactSum;
CHECK_SIZE(ExactSum, 16);

#ifdef __OPENCL_VERSION__
#ifdef CAUSTICL_NO_INLINE  // see prelude.cl
#define SHARED_INLINE static inline
#else
#define SHARED_INLINE __attribute__((always_inline)) static inline
#endif
#define SHARED_FLOAT_BITS(x) as_uint(x)
#else
#define SHARED_INLINE inline
#define SHARED_FLOAT_BITS(x) std::bit_cast<uint>(x)
#endif

SHARED_INLINE int exact_sum_bin(ExactSum sum) { return (int)(sum.low_and_bin & EXACT_SUM_BIN_MASK); }
SHARED_INLINE int64 exact_sum_low(ExactSum sum) { return sum.low_and_bin >> 5; }

// The sum of both: `high` in units of bin `bin`, `low` of the one below.
SHARED_INLINE ExactSum exact_sum_bins(int64 high, int64 low, int bin) {
  ExactSum sum = {high, low * (EXACT_SUM_BIN_MASK + 1) + bin};
  return sum;
}

// With what falls into bin `bin` and the one below.
SHARED_INLINE ExactSum exact_sum_add_bins(ExactSum sum, int64 high, int64 low, int bin) {
  int top = exact_sum_bin(sum);
  if (bin == top) {
    sum.high += high;
    sum.low_and_bin += low * (EXACT_SUM_BIN_MASK + 1);
    return sum;
  }
  if (bin < top) {
    if (bin + 1 == top) sum.low_and_bin += high * (EXACT_SUM_BIN_MASK + 1);
    return sum;
  }
  return exact_sum_bins(high, low + (bin == top + 1 ? sum.high : 0), bin);
}

// With `magnitude` * 2^exponent units of bin 0 more, or less where it is `negative`; magnitude < 2^bits.
SHARED_INLINE ExactSum exact_sum_add_integer(ExactSum sum, int64 magnitude, int exponent, int bits, bool negative) {
  int bin = (exponent + bits) / EXACT_SUM_BITS;
  // In units of the bin below: less than 2^55.
  int64 units = magnitude << (exponent - EXACT_SUM_BITS * (bin - 1));
  int64 high = (units + ((int64)1 << (EXACT_SUM_BITS - 1))) >> EXACT_SUM_BITS;
  int64 low = units - (high << EXACT_SUM_BITS);
  return exact_sum_add_bins(sum, negative ? -high : high, negative ? -low : low, bin);
}

// A finite float as mantissa * 2^(exponent - 149).
SHARED_INLINE uint float_mantissa(uint bits) { return (bits & 0x7fffffu) | ((bits & 0x7f800000u) != 0 ? 0x800000u : 0u); }
SHARED_INLINE int float_exponent(uint bits) {
  int exponent = (int)(bits >> 23 & 0xffu);
  return exponent > 0 ? exponent - 1 : 0;
}

// With a finite x more.
SHARED_INLINE ExactSum exact_sum_add(ExactSum sum, float x) {
  uint bits = SHARED_FLOAT_BITS(x);
  return exact_sum_add_integer(sum, float_mantissa(bits), float_exponent(bits), 24, (bits >> 31) != 0);
}

// Of x >= 0 the upper 14 bits, rounded: what exact_sum_add_square() squares.
SHARED_INLINE uint squared_bits(float x) {
  uint bits = SHARED_FLOAT_BITS(x) + 0x200u;
  return (bits < 0x7f800000u ? bits : 0x7f7fffffu) & ~0x3ffu;
}

// A sum of squares, whose bin 0 has the unit 2^-298, with the square of these bits more.
SHARED_INLINE ExactSum exact_sum_add_square(ExactSum sum, uint bits) {
  int64 mantissa = float_mantissa(bits) >> 10;
  return exact_sum_add_integer(sum, mantissa * mantissa, 2 * (float_exponent(bits) + 10), 28, false);
}

// The sum of all that was added to a and to b.
SHARED_INLINE ExactSum exact_sum_of_parts(ExactSum a, ExactSum b) {
  int bin = exact_sum_bin(b);
  if (bin <= exact_sum_bin(a)) return exact_sum_add_bins(a, b.high, exact_sum_low(b), bin);
  return exact_sum_add_bins(b, a.high, exact_sum_low(a), exact_sum_bin(a));
}
