// What lies behind the visible points in their buffer: see VisiblePoint in photon_records.h.
#include "core/prelude.cl"
#include "shared/effects.h"
#include "shared/types.h"

INLINE global VisibleLayers *visible_layers(global VisiblePoint *points, const Params *params) {
  return (global VisibleLayers *)(points + params->pixel_count * params->visible_points);
}

INLINE global VisibleSegment *visible_segments(global VisiblePoint *points, const Params *params) {
  global VisibleLayers *layers = visible_layers(points, params);
  return (global VisibleSegment *)(HAS(OUTPUT_LAYERS) ? layers + params->pixel_count * params->visible_points : layers);
}
