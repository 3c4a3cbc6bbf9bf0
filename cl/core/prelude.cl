// What every program begins with: strict arithmetic, the scalar type, and small vector helpers.
#include "shared/real.h"

// Contraction would make the same expression round differently in two kernels; watertight edges, grid cells
// and compensated sums rely on identical rounding. Fused operations are written as fma() where wanted.
#pragma OPENCL FP_CONTRACT OFF

// Large helpers are not inlined by PoCL by themselves; in traversal that costs 10-15%. Oclgrind runs kernels
// unoptimised and knows no inlined calls: there CAUSTICL_NO_INLINE leaves functions as they are.
#ifdef CAUSTICL_NO_INLINE
#define INLINE static inline
#else
#define INLINE __attribute__((always_inline)) static inline
#endif

// PoCL compiles three copies of a kernel: the kernel itself and two loops over the items of a work-group. What a
// kernel does with one item is therefore one function that is not inlined: in a third of the time to compile, at the
// same speed. Other compilers are left to choose.
#if defined(POCL_DEVICE_ADDRESS_BITS) && !defined(CAUSTICL_NO_INLINE)
#define OUTLINE __attribute__((noinline)) static
#else
#define OUTLINE static
#endif

#define PI ((real)3.14159265358979323846)
#define INV_PI ((real)0.31830988618379067154)

// Bound of the relative error of n chained roundings (Higham): n u / (1 - n u).
#define GAMMA(n) ((n) * REAL_EPSILON / (1 - (n) * REAL_EPSILON))

// The same where two forms of one thing meet that the host has rounded to floats each on its own: a map and its
// inverse, an emitter and the shape that it is. They stay that far apart in double.
#define STORED_EPSILON ((real)5.9604644775390625e-8)
#define STORED_GAMMA(n) ((n) * STORED_EPSILON / (1 - (n) * STORED_EPSILON))

// The lanes of a comparison of two real8, as those of two float8 are.
INLINE int8 mask_lanes(mask8 m) {
#ifdef CAUSTICL_DOUBLE
  return convert_int8(m);
#else
  return m;
#endif
}

INLINE real max_component(real3 v) { return max(v.x, max(v.y, v.z)); }
// Rounded after each product and sum, from left to right. dot() is the device's own, which GPUs fuse: where two kernels,
// or one ray and a packet, must agree to the bit or on a sign, they take this.
INLINE real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
// Of the rows of an affine map: the linear part of one, the image of the origin; the map of a direction and of a point.
INLINE real3 affine_row(global const float4 *rows, uint row) {
  global const float *numbers = (global const float *)(rows + row);  // loads of whole vectors keep loops scalar
  return (real3)(numbers[0], numbers[1], numbers[2]);
}
INLINE real3 affine_origin(global const float4 *rows) {
  global const float *numbers = (global const float *)rows;
  return (real3)(numbers[3], numbers[7], numbers[11]);
}
INLINE real3 transform_vector(global const float4 *rows, real3 v) {
  return (real3)(dot3(affine_row(rows, 0), v), dot3(affine_row(rows, 1), v), dot3(affine_row(rows, 2), v));
}
INLINE real3 transform_point(global const float4 *rows, real3 p) {
  real3 moved = transform_vector(rows, p), origin = affine_origin(rows);
  return (real3)(moved.x + origin.x, moved.y + origin.y, moved.z + origin.z);
}
// A normal by the transpose of the inverse's rows: n_world = to_local^T n_local (not normalised).
INLINE real3 transform_normal(global const float4 *inverse_rows, real3 n) {
  return convert_real3(inverse_rows[0].xyz) * n.x + convert_real3(inverse_rows[1].xyz) * n.y +
         convert_real3(inverse_rows[2].xyz) * n.z;
}
