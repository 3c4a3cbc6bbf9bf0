// Arithmetic of real3 component by component, and which loops are vectorised. Compilers that turn loops over paths into
// vector code (PoCL's) take scalars alone: a loop that holds an operation on a real3, or merges two of them where
// branches meet, stays scalar. What a loop over photons, camera rays or ends of camera paths calls is therefore written
// with these; a real3 that is only made and taken apart costs nothing. Sums go from left to right, as those of dot3().
//
// Nor may what such a loop calls have an argument that nothing reads in some program, or that is the same constant in all
// calls: the compiler then makes a new call without the marks that say that the loop's steps are independent. And no branch
// may lead to a load that others do without: what either side is, is computed and chosen.
#include "shared/effects.h"
#include "core/prelude.cl"

// Whether a loop of independent steps is to be vectorised where effects in `not_batched` would keep it from that: where the
// items of a work-group run one after the other, as PoCL's do. Other devices have vectors of items.
#if defined(POCL_DEVICE_ADDRESS_BITS) && !defined(CAUSTICL_DOUBLE)
// The driver vectorises when it makes the kernel of a program, and would warn that it did not before.
#pragma clang diagnostic ignored "-Wpass-failed"
#define VECTORISED(not_batched) ((EFFECTS & (not_batched)) == 0u)
#else
#define VECTORISED(not_batched) 0
#endif

INLINE real3 add3(real3 a, real3 b) { return (real3)(a.x + b.x, a.y + b.y, a.z + b.z); }
INLINE real3 sub3(real3 a, real3 b) { return (real3)(a.x - b.x, a.y - b.y, a.z - b.z); }
INLINE real3 mul3(real3 a, real3 b) { return (real3)(a.x * b.x, a.y * b.y, a.z * b.z); }
INLINE real3 scaled3(real s, real3 v) { return (real3)(s * v.x, s * v.y, s * v.z); }
INLINE real3 quotient3(real3 v, real d) { return (real3)(v.x / d, v.y / d, v.z / d); }
INLINE real3 negated3(real3 v) { return (real3)(-v.x, -v.y, -v.z); }
INLINE real3 abs3(real3 v) { return (real3)(fabs(v.x), fabs(v.y), fabs(v.z)); }
INLINE real3 ray_at(real3 origin, real t, real3 direction) {
  return (real3)(fma(t, direction.x, origin.x), fma(t, direction.y, origin.y), fma(t, direction.z, origin.z));
}
INLINE real3 cross3(real3 a, real3 b) {
  return (real3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
INLINE real3 choose3(bool first, real3 a, real3 b) {
  return (real3)(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

// v over its length, which must lie between 1e-18 and 1e18: beyond, the square leaves the range of a float.
INLINE real3 unit3(real3 v) { return scaled3(1 / sqrt(dot3(v, v)), v); }

// A power of two that brings `size` into [1, 2), 2^100 at most.
INLINE real unit_scale(real size) {
#ifdef CAUSTICL_DOUBLE
  return ldexp((real)1, -max(ilogb(size), -100));
#else
  return as_float((254u << 23) - max(as_uint(size) & 0x7f800000u, 27u << 23));
#endif
}

// v over its length, whatever that is.
INLINE real3 unit3_of_any(real3 v) { return unit3(scaled3(unit_scale(max_component(abs3(v))), v)); }

// The next number beyond x on the side that `side` has the sign of; x where that is 0.
INLINE real next_beyond(real x, real side) {
#ifdef CAUSTICL_DOUBLE
  return side == 0 ? x : nextafter(x, side > 0 ? (real)INFINITY : -(real)INFINITY);
#else
  int bits = as_int(x), step = (x > 0) == (side > 0) ? 1 : -1;
  real next = x == 0 ? copysign(as_float(1), side) : as_float(bits + step);
  return side == 0 || isinf(x) ? x : next;
#endif
}
