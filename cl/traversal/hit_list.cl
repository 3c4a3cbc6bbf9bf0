// All primitives that a ray meets, in any order: what lies at one place, and how often a ray leaves a body.
#include "core/material_kind.cl"
#include "traversal/geometry.cl"

// Primitives that a list holds, at most. Those beyond are left out, and `full` is set.
#define HIT_LIST_CAPACITY 24u

typedef struct {
  uint count;
  bool full;
  uint primitive[HIT_LIST_CAPACITY];  // of the scene: a triangle, or HIT_SHAPE | a shape
  Hit hit[HIT_LIST_CAPACITY];
} HitList;

// Which primitives a list is to hold: those of every material, or of dielectrics.
typedef struct {
  global const Material *materials;
  bool dielectrics;
} HitFilter;

// Adds a hit of a primitive, unless the list has it already: a tree may name a primitive in several leaves.
INLINE void hit_list_add(HitList *list, const HitFilter *filter, uint material, uint primitive, Hit hit) {
  if (filter->dielectrics && !bounds_body(filter->materials[material].kind)) return;
  for (uint i = 0; i < list->count; ++i)
    if (list->primitive[i] == primitive) return;
  if (list->count == HIT_LIST_CAPACITY) {
    list->full = true;
    return;
  }
  list->primitive[list->count] = primitive;
  list->hit[list->count++] = hit;
}

// Adds the nearest hit of a shape for 0 < t < t_max.
INLINE void shape_hits(const Geometry *g, uint index, Ray ray, real t_max, const HitFilter *filter, HitList *list) {
  Hit hit = hit_none(t_max);
  if (shape_closest(g->shapes + index, index, g->curves, ray, &hit))
    hit_list_add(list, filter, g->shapes[index].material, HIT_SHAPE | index, hit);
}

INLINE void leaf_hits(const Geometry *g, uint child, uint count, const TreeRay *r, real t_max, const HitFilter *filter,
                      HitList *list) {
  uint first = child & KD_INDEX;
  for (uint i = first; i < first + count * BLOCK_STRIDE; i += BLOCK_STRIDE) {
    real8 t, weight_1, weight_2;
    if (HAS(EFFECT_TRIANGLES) && block_intersect(g->blocks + i, r->triangle, t_max, &t, &weight_1, &weight_2)) {
      real distance[8], u[8], v[8];
      vstore8(t, 0, distance);
      vstore8(weight_1, 0, u);
      vstore8(weight_2, 0, v);
      for (uint lane = 0; lane < 8; ++lane) {
        if (!(distance[lane] < t_max)) continue;
        uint primitive = g->blocks[i].primitive[lane];
        Hit hit = {distance[lane], i * 8u + lane, u[lane], v[lane], 0};
        hit_list_add(list, filter, g->attributes[primitive].material & ~TRIANGLE_SMOOTH, primitive, hit);
      }
    }
    if (HAS(EFFECTS_IN_SHAPE_LEAVES) && (child & KD_SHAPES))
      for (uint did_hit = block_shapes(g->blocks + i, r->slab, t_max); did_hit != 0; did_hit &= did_hit - 1u)
        shape_hits(g, g->blocks[i].primitive[lowest_bit(did_hit)] & ~BLOCK_SHAPE, r->ray, t_max, filter, list);
  }
}

// Every triangle that the ray meets for 0 < t < t_max, and of every shape the nearest hit there. The walk is that of
// kdtree_occluded(), which no hit ends.
OUTLINE void geometry_hits(const Geometry *g, Ray ray, real t_max, const HitFilter *filter, HitList *list) {
  list->count = 0;
  list->full = false;
  if (HAS(EFFECT_PLANES))
    for (uint i = 0; i < g->plane_count; ++i) shape_hits(g, i, ray, t_max, filter, list);
  global const KdNode *nodes = g->nodes;
  if (!HAS(EFFECTS_IN_LEAVES) || nodes->child[0] == 0) return;
  TreeRay r = tree_ray(ray, nodes);
  uint index = 0;
  ulong trail_low = 0, trail_high = 0;
  for (uint step = 0; step < KD_STEP_LIMIT; ++step) {
    float8 enter, leave;
    node_intervals(nodes + index, r.slab, &enter, &leave);
    int8 did_hit = (enter <= leave) & (enter < (float)t_max);
    uint left = lane_bits(did_hit);
    for (;;) {
      if (left) {
        uint slot = lowest_bit(left);
        left &= left - 1u;
        uint child = nodes[index].child[slot];
        if (!(child & KD_LEAF)) {
          index = child;
          trail_high = (trail_high << 8) | (trail_low >> 56);
          trail_low = (trail_low << 8) | left;
          break;
        }
        leaf_hits(g, child, nodes[index].block_count[slot], &r, t_max, filter, list);
      } else {
        if (index == 0) return;
        index = nodes[index].parent;
        left = (uint)trail_low & 255u;
        trail_low = (trail_low >> 8) | (trail_high << 56);
        trail_high >>= 8;
      }
    }
  }
  list->full = true;
}
