// Light that comes from beyond the scene, as rays that cover the sphere around it.
#include "shapes/ray.cl"
#include "shared/types.h"
#include "sampling/warp.cl"

// Where a photon starts that crosses the emitter's sphere along `direction`: a uniform point of the disc that touches
// the sphere where the light comes from. Density 1 / (pi radius^2) per area across the direction.
INLINE real3 infinite_light_origin(global const Emitter *emitter, real3 direction, real2 u) {
  real3 tangent, bitangent;
  orthonormal_basis(direction, &tangent, &bitangent);
  real2 d = disc_uniform(u);
  return convert_real3(emitter->a.xyz) + emitter->a.w * (d.x * tangent + d.y * bitangent - direction);
}
