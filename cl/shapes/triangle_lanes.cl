// Eight lanes at once: which of them hold, and the least.
#include "core/prelude.cl"

// The lanes of a comparison's result, one bit each. Written out by lanes the compilers make a dozen shuffles of it
// where x86 has one instruction.
INLINE uint lane_bits(int8 m) {
#ifdef __AVX__
  return (uint)__builtin_ia32_movmskps256(as_float8(m));
#else
  int8 bits = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  int4 a = bits.lo | bits.hi;
  int2 b = a.lo | a.hi;
  return (uint)(b.x | b.y);
#endif
}

INLINE bool any_lane(mask8 m) { return lane_bits(mask_lanes(m)) != 0; }

INLINE uint lowest_bit(uint bits) { return 31u - clz(bits & -bits); }

INLINE real min_lane(real8 v) {
  real4 a = min(v.lo, v.hi);
  real2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}

INLINE int min_lane_int(int8 v) {
  int4 a = min(v.lo, v.hi);
  int2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}
