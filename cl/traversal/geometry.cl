// All that a ray can meet: infinite planes, one after the other, and everything bounded, in the tree.
#include "shapes/shape.cl"
#include "traversal/kdtree.cl"
#include "traversal/planes.cl"

typedef struct {
  global const KdNode *nodes;
  global const TriangleBlock *blocks;
  global const TriangleAttributes *attributes;
  global const Shape *shapes;
  global const float *curves;
  uint plane_count;
} Geometry;

// The parameters that a kernel takes to see the scene, and the local `geometry` made of them. The first
// `plane_count` shapes are the infinite planes.
#define GEOMETRY_PARAMETERS                                                                 \
  global const KdNode *nodes, global const TriangleBlock *blocks,                           \
      global const TriangleAttributes *attributes, global const Shape *shapes, global const float *curves
#define GEOMETRY_INIT(plane_count) \
  const Geometry geometry = {nodes, blocks, attributes, shapes, curves, plane_count};

// Takes the nearest hit with 0 < t < hit->t into `hit`. False, and `hit` as it was, if there is none.
INLINE bool geometry_closest(const Geometry *g, Ray ray, Hit *hit) {
  bool found = planes_closest(g->shapes, g->plane_count, ray, hit);
  if (HAS(EFFECTS_IN_LEAVES))
    found |= kdtree_closest(g->nodes, g->blocks, g->shapes, g->curves, ray, hit);
  return found;
}

// geometry_occluded() but for the planes.
INLINE bool bounded_occluded(const Geometry *g, Ray ray, real t_max, uint *diagnostics) {
  return HAS(EFFECTS_IN_LEAVES) &&
         kdtree_occluded(g->nodes, g->blocks, g->shapes, g->curves, ray, t_max, diagnostics);
}

// Whether anything is met for 0 < t < t_max. Adds to *diagnostics.
INLINE bool geometry_occluded(const Geometry *g, Ray ray, real t_max, uint *diagnostics) {
  return planes_occluded(g->shapes, g->plane_count, ray, t_max) || bounded_occluded(g, ray, t_max, diagnostics);
}

// The surface at a hit that geometry_closest() has found along `ray`.
INLINE void geometry_surface(const Geometry *g, Ray ray, Hit hit, Surface *surface) {
  if (HAS(EFFECT_TRIANGLES) && !(hit.primitive & HIT_SHAPE))
    triangle_surface(g->blocks, g->attributes, hit, surface);
  else
    shape_surface(g->shapes + (hit.primitive & ~HIT_SHAPE), g->curves, ray, hit, surface);
}

// The same for loops over paths that are to be vectorised: what the branches hand on are scalars. Shapes are plain.
INLINE void geometry_surface_soa(const Geometry *g, Ray ray, Hit hit, Surface *surface) {
  SurfaceParts parts = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0}, 0, 0};
  if (HAS(EFFECT_TRIANGLES) && !(hit.primitive & HIT_SHAPE)) {
    Surface triangle;
    triangle_surface(g->blocks, g->attributes, hit, &triangle);
    surface_unpack(&triangle, &parts);
  } else {
    shape_surface_soa(g->shapes + (hit.primitive & ~HIT_SHAPE), g->curves, ray, hit, &parts);
  }
  surface_pack(&parts, surface);
}

// The index of the material at a hit.
INLINE uint geometry_material(const Geometry *g, Hit hit) {
  if (!HAS(EFFECT_TRIANGLES) || (hit.primitive & HIT_SHAPE)) return g->shapes[hit.primitive & ~HIT_SHAPE].material;
  uint triangle = g->blocks[hit.primitive / 8u].primitive[hit.primitive % 8u];
  return g->attributes[triangle].material & ~TRIANGLE_SMOOTH;
}
