// What lies behind the visible points in their buffer: see VisiblePoint in photon_records.h.
#include "materials/scattering.cl"
#include "shared/types.h"

INLINE global VisibleLightPasses *visible_layers(global VisiblePoint *points, const Params *params) {
  return (global VisibleLightPasses *)(points + params->pixel_count * params->visible_points);
}

INLINE global VisibleSegment *visible_segments(global VisiblePoint *points, const Params *params) {
  global VisibleLightPasses *layers = visible_layers(points, params);
  return (global VisibleSegment *)(HAS(OUTPUT_LIGHT_PASSES) ? layers + params->pixel_count * params->visible_points : layers);
}

INLINE global VisibleLobe *visible_lobes(global VisiblePoint *points, const Params *params) {
  global VisibleSegment *segments = visible_segments(points, params);
  return (global VisibleLobe *)(HAS(EFFECT_MEDIUM) ? segments + params->pixel_count * params->visible_points : segments);
}

// What weighs photons around a visible point at which a path arrives along `wi`, on the side of `n`.
INLINE VisibleLobe visible_lobe(const Bsdf *bsdf, real3 wi, real3 n) {
  VisibleLobe lobe;
  vstore3(wi, 0, lobe.wi);
  vstore3(n, 0, lobe.normal);
  vstore3(bsdf->color, 0, lobe.color);
  lobe.own = bsdf->own;
  lobe.kind = bsdf->kind;
  return lobe;
}
