// What lies behind the visible points in their buffer: see VisiblePoint in photon_records.h.
#include "core/prelude.cl"
#include "shared/effects.h"
#include "shared/types.h"

INLINE global VisibleLightPasses *visible_layers(global VisiblePoint *points, const Params *params) {
  return (global VisibleLightPasses *)(points + params->pixel_count * params->visible_points);
}

INLINE global VisibleSegment *visible_segments(global VisiblePoint *points, const Params *params) {
  global VisibleLightPasses *layers = visible_layers(points, params);
  return (global VisibleSegment *)(HAS(OUTPUT_LIGHT_PASSES) ? layers + params->pixel_count * params->visible_points : layers);
}
