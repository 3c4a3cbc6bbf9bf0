// Where the rays of a batch end: by brute force where the host asks for that, since the primitives are few; else by a stream
// through the tree, or one by one where the device has neither.
#include "traversal/brute_force.cl"
#include "traversal/geometry.cl"
#include "traversal/kdtree_stream.cl"

#if defined(BRUTE_FORCE) && STREAM_CAPACITY > 1u
#define STREAM_BRUTE_FORCE
#endif

// geometry_closest() of the first `count` rays, STREAM_CAPACITY at most; of those beyond, up to stream_padded(count), the hits
// are none. Where a ray meets nothing, so is its hit.
OUTLINE void rays_closest(const Geometry *g, const RayArrays *arrays, uint count, volatile global Counters *counters) {
  for (uint i = 0; i < stream_padded(count); ++i) arrays_put_hit(arrays, i, hit_none(INFINITY));
#if defined(STREAM_BRUTE_FORCE) || defined(KDTREE_STREAMS)
  if (HAS(EFFECT_PLANES)) planes_closest_all(g->shapes, g->plane_count, count, arrays);
#if defined(STREAM_BRUTE_FORCE)
  uint cut_short = brute_force_closest(g->nodes, g->blocks, g->shapes, g->curves, g->plane_count, count, arrays);
  if (cut_short > 0) atomic_add(&counters->traversal_bound, cut_short);
#else
  if (!HAS(EFFECTS_IN_LEAVES)) return;
  uint diagnostics[STREAM_CAPACITY];
  kdtree_stream(g->nodes, g->blocks, g->shapes, g->curves, arrays, count, diagnostics);
  for (uint i = 0; i < count; ++i) count_diagnostics(diagnostics[i], counters);
#endif
#else
  for (uint i = 0; i < count; ++i) {
    Hit hit = hit_none(INFINITY);
    geometry_closest(g, arrays_ray(arrays, i), &hit);
    count_diagnostics(hit.diagnostics, counters);
    arrays_put_hit(arrays, i, hit);
  }
#endif
}
