// Traversal of the wide KD-tree without a stack: the nearest hit, and any hit.
//
// A node holds up to eight disjoint cells (bounds of what lies in them, cut at the split planes), tested at once.
// Along a ray disjoint cells have one order, so a hit inside the nearest cell ends the search. In place of a stack
// there is a trail of a few bits a level. The order of a node's children is a pure function of ray and node: on
// coming back to a node, its test is done again and the children after the one just left are found by their keys.
//
// Which cells a ray visits must cover the errors of the triangle test, else a ray through an edge shared by two
// cells could miss both triangles. The shear test is exact for vertices that are off by about 4 roundings of their
// distance, the slab test adds 3 roundings: every slab is therefore widened by 8 roundings of the largest distance
// between the ray's origin and a point of the scene.
#include "shapes/triangle.cl"
#include "shared/effects.h"
#include "traversal/prefetch.cl"

// What is not a triangle: of shapes/shape.cl, or of a test.
INLINE bool shape_closest(global const Shape *shape, uint index, global const float *curves, Ray ray, Hit *hit);
INLINE bool shape_occluded(global const Shape *shape, global const float *curves, Ray ray, real t_max, uint *diagnostics);

// More node tests than any ray can need: only a device that computes wrongly gets there, and then it must not hang.
#ifndef KD_STEP_LIMIT
#define KD_STEP_LIMIT (1u << 24)
#endif

#define UNIT 5.9604645e-8f  // roundoff of float

// The ray as the slab test wants it. Always in float, as the planes are: it only says where to look.
typedef struct {
  float3 origin;
  float3 inverse;
  float3 widening;      // in t, of each slab to both sides
  float3 enter, leave;  // added to plane * inverse; the widening is in them
  // Rows of KdNode.bounds by which a ray in this direction enters, and leaves, in floats from the first.
  size_t near_x, near_y, near_z, far_x, far_y, far_z;
} SlabRay;

// What of a SlabRay belongs to one axis, whose low planes are `row` floats from the first.
typedef struct {
  float inverse, widening, enter, leave;
  uint near, far;
} SlabAxis;

// `farthest`: the largest distance along an axis between the origin and a point of the tree.
INLINE SlabAxis slab_axis(float origin, float direction, float farthest, uint row) {
  SlabAxis s;
  // 1e-18 in place of 0 keeps every product finite for scenes up to 1e18 and below every widening.
  float size = fabs(direction) > 1e-18f ? fabs(direction) : 1e-18f;
  s.inverse = copysign(1.0f / size, direction);
  // 8 roundings of the distance, and 2 of the origin: plane * inverse - origin * inverse is one fma() a plane. A
  // third of the origin where it was rounded above; that of the direction counts with the distance, of whose 8 an
  // exact triangle test needs none.
  float width = (8 * UNIT) * farthest + ((sizeof(real) > sizeof(float) ? 3 : 2) * UNIT) * fabs(origin);
  s.widening = fabs(s.inverse) * width;
  s.enter = -origin * s.inverse - s.widening;
  s.leave = -origin * s.inverse + s.widening;
  uint high = (as_uint(direction) >> 31) * 24u;
  s.near = row + high, s.far = row + 24u - high;
  return s;
}

// From (x, y, z) to one corner of the tree, and from there to any other point.
INLINE float farthest_in_tree(global const KdNode *root, float x, float y, float z) {
  float from_x = fabs(x - root->bounds[0][0]), from_y = fabs(y - root->bounds[1][0]);
  float from_z = fabs(z - root->bounds[2][0]);
  return max(from_x, max(from_y, from_z)) + root->extent;
}

INLINE SlabRay slab_ray(Ray ray, global const KdNode *root) {
  float3 o = convert_float3(ray.origin), d = convert_float3(ray.direction);
  float farthest = farthest_in_tree(root, o.x, o.y, o.z);
  SlabAxis x = slab_axis(o.x, d.x, farthest, 0), y = slab_axis(o.y, d.y, farthest, 8);
  SlabAxis z = slab_axis(o.z, d.z, farthest, 16);
  SlabRay s;
  s.origin = o;
  s.inverse = (float3)(x.inverse, y.inverse, z.inverse);
  s.widening = (float3)(x.widening, y.widening, z.widening);
  s.enter = (float3)(x.enter, y.enter, z.enter);
  s.leave = (float3)(x.leave, y.leave, z.leave);
  s.near_x = x.near, s.near_y = y.near, s.near_z = z.near;
  s.far_x = x.far, s.far_y = y.far, s.far_z = z.far;
  return s;
}

INLINE float8 slab_planes(global const KdNode *node, size_t row) {
  return *(global const float8 *)(node->bounds[0] + row);
}

// Where the ray enters and leaves each child's cell; the ray meets the children with enter <= leave.
INLINE void node_intervals(global const KdNode *node, SlabRay ray, float8 *enter, float8 *leave) {
  float8 near_x = fma(slab_planes(node, ray.near_x), ray.inverse.x, ray.enter.x);
  float8 near_y = fma(slab_planes(node, ray.near_y), ray.inverse.y, ray.enter.y);
  float8 near_z = fma(slab_planes(node, ray.near_z), ray.inverse.z, ray.enter.z);
  float8 far_x = fma(slab_planes(node, ray.far_x), ray.inverse.x, ray.leave.x);
  float8 far_y = fma(slab_planes(node, ray.far_y), ray.inverse.y, ray.leave.y);
  float8 far_z = fma(slab_planes(node, ray.far_z), ray.inverse.z, ray.leave.z);
  *enter = max(max(near_x, near_y), max(near_z, (float8)0));
  *leave = min(min(far_x, far_y), far_z);
}

// Whether a hit at t in the cell of one child is nearer than any in a cell not yet visited. It must lie before the
// exit, narrowed by what the entry of the next cell is widened by. And the cells must have been in order: where a
// plane parts two cells at t = p, widened by w, the middles of their intervals can be in the wrong order only if the
// later one is left before p + 3 w. For a ray within a split plane w is huge, and it never ends early.
INLINE bool hit_is_final(global const KdNode *node, uint slot, SlabRay ray, float t) {
  global const float *planes = node->bounds[0] + slot;
  float near_x = fma(planes[ray.near_x] - ray.origin.x, ray.inverse.x, 4 * ray.widening.x);
  float near_y = fma(planes[ray.near_y] - ray.origin.y, ray.inverse.y, 4 * ray.widening.y);
  float near_z = fma(planes[ray.near_z] - ray.origin.z, ray.inverse.z, 4 * ray.widening.z);
  float far_x = fma(planes[ray.far_x] - ray.origin.x, ray.inverse.x, -ray.widening.x);
  float far_y = fma(planes[ray.far_y] - ray.origin.y, ray.inverse.y, -ray.widening.y);
  float far_z = fma(planes[ray.far_z] - ray.origin.z, ray.inverse.z, -ray.widening.z);
  return max(t, max(near_x, max(near_y, near_z))) <= min(far_x, min(far_y, far_z));
}

// The lanes of a block with a shape whose bounds the ray meets before t_max, as bits.
INLINE uint block_shapes(global const TriangleBlock *block, SlabRay ray, float t_max) {
  // The corners lie in the place of vertices 0 and 1, 24 floats apart, as the high planes of a node from the low.
  global const float *corner = block->position[0][0];
  float8 near_x = fma(*(global const float8 *)(corner + ray.near_x), ray.inverse.x, ray.enter.x);
  float8 near_y = fma(*(global const float8 *)(corner + ray.near_y), ray.inverse.y, ray.enter.y);
  float8 near_z = fma(*(global const float8 *)(corner + ray.near_z), ray.inverse.z, ray.enter.z);
  float8 far_x = fma(*(global const float8 *)(corner + ray.far_x), ray.inverse.x, ray.leave.x);
  float8 far_y = fma(*(global const float8 *)(corner + ray.far_y), ray.inverse.y, ray.leave.y);
  float8 far_z = fma(*(global const float8 *)(corner + ray.far_z), ray.inverse.z, ray.leave.z);
  float8 enter = max(max(near_x, near_y), max(near_z, (float8)0));
  float8 leave = min(min(far_x, far_y), min(far_z, (float8)t_max));
  int8 primitive = as_int8(*(global const uint8 *)block->primitive);
  return lane_bits((enter <= leave) & (primitive < 0) & (primitive != -1));
}

// A ray as nodes, triangles and shapes take it.
typedef struct {
  Ray ray;
  TriangleRay triangle;
  SlabRay slab;
} TreeRay;

INLINE TreeRay tree_ray(Ray ray, global const KdNode *nodes) {
  TreeRay result;
  result.ray = ray;
  result.triangle = triangle_ray(ray);
  result.slab = slab_ray(ray, nodes);
  return result;
}

// The nearest hit before hit->t among the `count` blocks of a leaf.
INLINE bool leaf_closest(global const TriangleBlock *blocks, global const Shape *shapes, global const float *curves,
                         uint child, uint count, const TreeRay *r, Hit *hit) {
  bool found = false;
  uint first = child & KD_INDEX;
  for (uint i = first; i < first + count * BLOCK_STRIDE; i += BLOCK_STRIDE) {
    if (HAS(EFFECT_TRIANGLES)) found |= block_closest(blocks, i, r->triangle, hit);
    if (HAS(EFFECTS_IN_SHAPE_LEAVES) && (child & KD_SHAPES)) {
      for (uint did_hit = block_shapes(blocks + i, r->slab, hit->t); did_hit != 0; did_hit &= did_hit - 1u) {
        uint index = blocks[i].primitive[lowest_bit(did_hit)] & ~BLOCK_SHAPE;
        found |= shape_closest(shapes + index, index, curves, r->ray, hit);
      }
    }
  }
  return found;
}

INLINE bool leaf_occluded(global const TriangleBlock *blocks, global const Shape *shapes, global const float *curves,
                          uint child, uint count, const TreeRay *r, real t_max, uint *diagnostics) {
  uint first = child & KD_INDEX;
  for (uint i = first; i < first + count * BLOCK_STRIDE; i += BLOCK_STRIDE) {
    real8 t, weight_1, weight_2;
    if (HAS(EFFECT_TRIANGLES) && block_intersect(blocks + i, r->triangle, t_max, &t, &weight_1, &weight_2)) return true;
    if (HAS(EFFECTS_IN_SHAPE_LEAVES) && (child & KD_SHAPES)) {
      for (uint did_hit = block_shapes(blocks + i, r->slab, t_max); did_hit != 0; did_hit &= did_hit - 1u) {
        uint index = blocks[i].primitive[lowest_bit(did_hit)] & ~BLOCK_SHAPE;
        if (shape_occluded(shapes + index, curves, r->ray, t_max, diagnostics)) return true;
      }
    }
  }
  return false;
}

#define TRAIL_DONE 0u    // no sibling is left
#define TRAIL_RETEST 7u  // siblings are left; which, the node's test must say
#define TRAIL_NEXT 8u    // 8 | slot: the next sibling

// The nearest hit of everything in the tree before hit->t. False, and `hit` as it was, if there is none.
INLINE bool kdtree_closest(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                           global const float *curves, Ray ray, Hit *hit) {
  const int8 lanes = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  if (nodes->child[0] == 0) return false;
  TreeRay r = tree_ray(ray, nodes);
  bool found = false;
  uint index = 0, slot = 0;
  bool retest = false;  // only the children after `slot`
  ulong trail = 0;      // 4 bits a level, the current node lowest
  uint more = 0;        // 1 bit a level: siblings are left after the one that the trail names
  for (uint step = 0; step < KD_STEP_LIMIT; ++step) {
    // The children met, by keys: the middle of the interval in the cell, the lane in the lowest bits. The middle is
    // right for flat cells as well, and does not depend on the hit so far.
    global const KdNode *node = nodes + index;
    float8 enter, leave;
    node_intervals(node, r.slab, &enter, &leave);
    int8 key = (as_int8(enter + leave) & ~7) | lanes;
    int8 did_hit = (enter <= leave) & (enter < (float)hit->t);
    int keys[8];
    vstore8(key, 0, keys);
    if (retest) did_hit &= key > keys[slot];
    trail &= ~15ul;
    more &= ~1u;
    uint left = lane_bits(did_hit);
    bool descend = left != 0;
    if (descend) {
      uint rest = left & (left - 1u);
      key = did_hit ? key : INT_MAX;
      int nearest = min_lane_int(key);
      slot = (uint)nearest & 7u;
      uint second = (uint)min_lane_int(key == nearest ? INT_MAX : key) & 7u;
      more |= (rest & (rest - 1u)) ? 1u : 0u;
      trail |= rest ? TRAIL_NEXT | second : 0u;
      prefetch_child(nodes, blocks, node->child[second]);
    }
    // Visit child `slot` if there is one, then what the trail names, until a node must be tested.
    for (;;) {
      if (descend) {
        uint child = nodes[index].child[slot];
        if (!(child & KD_LEAF)) {
          index = child;
          trail <<= 4;
          more <<= 1;
          retest = false;
          break;
        }
        if (leaf_closest(blocks, shapes, curves, child, nodes[index].block_count[slot], &r, hit)) {
          found = true;
          if (hit_is_final(nodes + index, slot, r.slab, (float)hit->t)) return true;
        }
      }
      uint next = (uint)trail & 15u;
      if (next & TRAIL_NEXT) {
        slot = next & 7u;
        trail ^= next ^ ((more & 1u) ? TRAIL_RETEST : TRAIL_DONE);
        descend = true;
      } else if (next == TRAIL_RETEST) {
        retest = true;
        break;
      } else {
        if (index == 0) return found;
        slot = nodes[index].slot;
        index = nodes[index].parent;
        trail >>= 4;
        more >>= 1;
        descend = false;
      }
    }
  }
  hit->diagnostics |= DIAGNOSTIC_TRAVERSAL_BOUND;
  return found;
}

// Whether anything in the tree is met for 0 < t < t_max; adds to *faults. The order does not matter here, so the trail
// holds the children left to visit, one bit each.
INLINE bool kdtree_occluded(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                            global const float *curves, Ray ray, real t_max, uint *diagnostics) {
  if (nodes->child[0] == 0) return false;
  TreeRay r = tree_ray(ray, nodes);
  uint index = 0;
  ulong trail_low = 0, trail_high = 0;  // 8 bits a level, the node above the current one lowest
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
        if (leaf_occluded(blocks, shapes, curves, child, nodes[index].block_count[slot], &r, t_max, diagnostics))
          return true;
      } else {
        if (index == 0) return false;
        index = nodes[index].parent;
        left = (uint)trail_low & 255u;
        trail_low = (trail_low >> 8) | (trail_high << 56);
        trail_high >>= 8;
      }
    }
  }
  *diagnostics |= DIAGNOSTIC_TRAVERSAL_BOUND;
  return true;
}
