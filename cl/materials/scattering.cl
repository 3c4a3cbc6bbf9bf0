// What a material's functions take and give: the material at one point, the sample of a lobe.
//
// Here wi is the direction in which a path arrives and wo that in which it goes on, both along the path; n is the shading
// normal on the side that the path comes from, g the geometric one.
#include "core/material_kind.cl"
#include "core/vector.cl"
#include "shapes/ray.cl"
#include "shared/types.h"

// A material at one point, textures resolved.
typedef struct {
  uint kind;  // MATERIAL_DIFFUSE ...
  real3 color;
  real ior;      // inside / outside
  real alpha;    // of a rough lobe; 0 for a perfectly specular one
  real3 eta, k;  // conductor: complex index inside / outside
  real own;      // what the material's file keeps there, by name_read()
  bool coated;   // the Lambert lobe of coated diffuse, under its boundary
} Bsdf;

// The shading normal on the side of the surface that `direction` arrives at. Where interpolation tilted it
// away from the ray altogether, the geometric normal takes its place.
INLINE real3 facing_normal(const Surface *surface, real3 direction) {
  real side = dot3(surface->geometric_normal, direction) < 0 ? 1 : -1;
  bool tilted = !(side * dot3(surface->shading_normal, direction) < 0);
  return scaled3(side, choose3(tilted, surface->geometric_normal, surface->shading_normal));
}

typedef struct {
  real3 direction;
  real3 weight;  // BSDF * cosine / pdf; zero ends the path
  real pdf;      // per solid angle; 0 for a perfectly specular lobe
} BsdfSample;

// A grazing ray is lifted by this cosine off the surface where rounding might put it on the other side.
#define GRAZING_COSINE ((real)1e-6 * (REAL_EPSILON / STORED_EPSILON))

// Whether light sampling can find the lobe, and its density weighs against that of lights.
INLINE bool bsdf_is_rough(const Bsdf *bsdf) {
  return HAS(EFFECT_ROUGH) && !is_diffuse(bsdf->kind) && bsdf->alpha > 0;
}

// Whether the path leaves in the one direction that goes with its arrival.
INLINE bool bsdf_is_specular(const Bsdf *bsdf) { return !is_diffuse(bsdf->kind) && !bsdf_is_rough(bsdf); }
