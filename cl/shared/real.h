// `real` is the type of all light-transport arithmetic, and of what a pass hands to the next. The scene, scalars
// of a launch and the film are floats, so that a double-precision build of the same sources, which defines
// CAUSTICL_DOUBLE, renders the same scene to the bit. Random numbers have 24 bits in both: the same seed draws the
// same paths, and what differs between two pictures is what rounding did.
#pragma once

#ifndef __OPENCL_VERSION__
namespace causticl {
/// As in the float build, whose records the host knows; in the double build they take up to twice the bytes.
using real = float;
}  // namespace causticl
#elif defined(CAUSTICL_DOUBLE)
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
typedef double2 real2;
typedef double3 real3;
typedef double4 real4;
typedef double8 real8;
typedef long8 mask8;  // what comparing two real8 gives
#define convert_real2 convert_double2
#define convert_real3 convert_double3
#define convert_real4 convert_double4
#define convert_real8 convert_double8
#define REAL_EPSILON 1.1102230246251565e-16
#define REAL_MAX 1.7976931348623157e308
#else
typedef float real;
typedef float2 real2;
typedef float3 real3;
typedef float4 real4;
typedef float8 real8;
typedef int8 mask8;
#define convert_real2 convert_float2
#define convert_real3 convert_float3
#define convert_real4 convert_float4
#define convert_real8 convert_float8
#define REAL_EPSILON 5.9604644775390625e-8f  // unit roundoff, 2^-24
#define REAL_MAX FLT_MAX
#endif
