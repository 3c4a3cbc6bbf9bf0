// What lies along a path's segments: the inside of glass, which absorbs, or the medium that fills all other space.
#include "core/material_kind.cl"
#include "media/medium.cl"
#include "shapes/ray.cl"
#include "shared/types.h"

// Whether a path is inside of glass, as far as surfaces have told.
typedef struct {
  bool glass;
  real3 absorption;  // of the glass, per unit length; zero outside
} Interior;

INLINE Interior interior_none(void) {
  Interior interior = {false, (real3)(0, 0, 0)};
  return interior;
}

INLINE Interior interior_of(global const Material *material) {
  Interior interior = {true, convert_real3(material->absorption.xyz)};
  return interior;
}

// The interior of the segment that ended at `surface`. A boundary that is met from behind encloses the segment,
// wherever the path began; one that is met from the front, or is not of glass, leaves it as the last boundary told.
INLINE Interior interior_before(Interior interior, global const Material *material, const Surface *surface,
                                real3 direction) {
  bool behind = bounds_body(material->kind) && dot3(direction, surface->geometric_normal) > 0;
  return behind ? interior_of(material) : interior;
}

// The interior of the segment that leaves `surface` along `direction`.
INLINE Interior interior_after(Interior interior, global const Material *material, const Surface *surface,
                               real3 direction) {
  if (!bounds_body(material->kind)) return interior;
  return dot3(direction, surface->geometric_normal) < 0 ? interior_of(material) : interior_none();
}

// Fraction of light that is left after `distance` inside of glass; outside all of it.
INLINE real3 interior_transmittance(Interior interior, real distance) {
  return transmittance(interior.absorption, distance);
}
