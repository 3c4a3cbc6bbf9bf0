// What every program begins with: strict arithmetic, the scalar type, and small vector helpers.

// Contraction would make the same expression round differently in two kernels; watertight edges, grid cells
// and compensated sums rely on identical rounding. Fused operations are written as fma() where wanted.
#pragma OPENCL FP_CONTRACT OFF

// `real` is the type of all light-transport arithmetic; buffers hold float. A double-precision build of the
// same sources defines CAUSTICL_DOUBLE.
#ifdef CAUSTICL_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double2 real2;
typedef double3 real3;
typedef double4 real4;
typedef double8 real8;
#define convert_real3 convert_double3
#define convert_real8 convert_double8
#define REAL_EPSILON 1.1102230246251565e-16
#define REAL_MAX 1.7976931348623157e308
#else
typedef float real;
typedef float2 real2;
typedef float3 real3;
typedef float4 real4;
typedef float8 real8;
#define convert_real3 convert_float3
#define convert_real8 convert_float8
#define REAL_EPSILON 5.9604644775390625e-8f  // unit roundoff, 2^-24
#define REAL_MAX FLT_MAX
#endif

// Large helpers are not inlined by PoCL by themselves; in traversal that costs 10-15%. Oclgrind runs kernels
// unoptimised and knows no inlined calls: there CAUSTICL_NO_INLINE leaves functions as they are.
#ifdef CAUSTICL_NO_INLINE
#define INLINE static inline
#else
#define INLINE __attribute__((always_inline)) static inline
#endif

#define PI ((real)3.14159265358979323846)
#define INV_PI ((real)0.31830988618379067154)

// Bound of the relative error of n chained roundings (Higham): n u / (1 - n u).
#define GAMMA(n) ((n) * REAL_EPSILON / (1 - (n) * REAL_EPSILON))

INLINE real max_component(real3 v) { return max(v.x, max(v.y, v.z)); }
// Rows of an affine map applied to a point and to a direction.
INLINE real3 transform_point(global const float4 *rows, real3 p) {
  real3 r0 = convert_real3(rows[0].xyz), r1 = convert_real3(rows[1].xyz), r2 = convert_real3(rows[2].xyz);
  return (real3)(dot(r0, p) + rows[0].w, dot(r1, p) + rows[1].w, dot(r2, p) + rows[2].w);
}
INLINE real3 transform_vector(global const float4 *rows, real3 v) {
  return (real3)(dot(convert_real3(rows[0].xyz), v), dot(convert_real3(rows[1].xyz), v),
                 dot(convert_real3(rows[2].xyz), v));
}
// A normal by the transpose of the inverse's rows: n_world = to_local^T n_local (not normalised).
INLINE real3 transform_normal(global const float4 *inverse_rows, real3 n) {
  return convert_real3(inverse_rows[0].xyz) * n.x + convert_real3(inverse_rows[1].xyz) * n.y +
         convert_real3(inverse_rows[2].xyz) * n.z;
}
