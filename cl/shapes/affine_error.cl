// Errors of shapes that rays meet in a local space.
#include "core/prelude.cl"
#include "core/vector.cl"
#include "shared/types.h"

// The error of a position in the world that to_world has made of a local one: what a spawned ray may be off by when
// to_local takes it back, and `met`, by how much the intersection there may be off, brought to the world. A bound of each
// component, by running error analysis (Pharr, Jakob, Humphreys, PBR section 6.8).
INLINE real affine_error(global const Shape *shape, real3 position, real met) {
  global const float4 *in = shape->to_local, *out = shape->to_world;
  real3 world = fabs(position);
  real3 error = (real3)(dot(fabs(convert_real3(in[0].xyz)), world) + fabs(in[0].w),
                        dot(fabs(convert_real3(in[1].xyz)), world) + fabs(in[1].w),
                        dot(fabs(convert_real3(in[2].xyz)), world) + fabs(in[2].w)) * STORED_GAMMA(8);
  error += met;
  return max_component((real3)(dot(fabs(convert_real3(out[0].xyz)), error) + STORED_GAMMA(4) * fabs(out[0].w),
                               dot(fabs(convert_real3(out[1].xyz)), error) + STORED_GAMMA(4) * fabs(out[1].w),
                               dot(fabs(convert_real3(out[2].xyz)), error) + STORED_GAMMA(4) * fabs(out[2].w)));
}
