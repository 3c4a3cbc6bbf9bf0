// Stream traversal of the tree: the hits of rays that go different ways, as those of photons do, a batch at once.
//
// A ray alone mostly waits: each step for the last one, and for memory; and where steps differ from ray to ray no
// processor foresees its branches. Here all rays of a batch take a step of one kind before any takes the next: tests of
// nodes, then of the triangles in leaves, then the ways back. These steps have hardly a branch: what a ray does next it
// is told by lists, to whose ends every ray is written and where only those stay that are counted. So the steps of
// several rays overlap in the processor, and what the next ones read is fetched ahead. Every ray visits what it visits
// in kdtree_closest(), to the same hits to the bit; KD_STEP_LIMIT counts the steps of the batch. Shadow rays, most of
// which meet nothing on a way that they share, are faster alone.
//
// On devices that run the items of a work-group in turn; for float and the watertight test.
#include "traversal/kdtree.cl"
#include "core/components.cl"
#include "core/stream_size.cl"
#include "core/vector.cl"
#include "shapes/ray_components.cl"

#if STREAM_CAPACITY > 1u && !defined(CAUSTICL_DOUBLE) && !defined(TRIANGLES_PRECOMPUTED)
#define KDTREE_STREAMS
#endif

#ifdef KDTREE_STREAMS
// As lists of components.cl: of a SlabRay, and of a TriangleRay.
#define SLAB_COMPONENTS(ROW, x) \
  ROW(x, VECTOR, float, inverse, inverse, ALWAYS) \
  ROW(x, VECTOR, float, widening, widening, ALWAYS) \
  ROW(x, VECTOR, float, enter, enter, ALWAYS) \
  ROW(x, VECTOR, float, leave, leave, ALWAYS) \
  ROW(x, PARTS,  uint,  near, near_, ALWAYS) \
  ROW(x, PARTS,  uint,  far, far_, ALWAYS)
#define SLAB_ORIGIN_COMPONENTS(ROW, x) ROW(x, VECTOR, float, origin, origin, ALWAYS)
#define TRIANGLE_COMPONENTS(ROW, x) \
  ROW(x, PARTS,  uint,  axis, , ALWAYS) \
  ROW(x, PARTS,  float, sheared_origin, origin_, ALWAYS) \
  ROW(x, SCALAR, float, shear_x, shear_x, ALWAYS) \
  ROW(x, SCALAR, float, shear_y, shear_y, ALWAYS) \
  ROW(x, SCALAR, float, scale_z, scale_z, ALWAYS)

// Where each ray is in the tree, and what it has met so far.
typedef struct {
  SLAB_COMPONENTS(COMPONENT_FIELD, )
  TRIANGLE_COMPONENTS(COMPONENT_FIELD, )
  SLAB_ORIGIN_COMPONENTS(COMPONENT_FIELD, )
  HIT_COMPONENTS(COMPONENT_FIELD, )
  uint diagnostics[STREAM_CAPACITY];  // of the hit
  uint node[STREAM_CAPACITY], slot[STREAM_CAPACITY];  // where it is, and the child that it is at or has just left
  uint again[STREAM_CAPACITY];  // 1 where the node is to be tested for children after `slot` alone
  uint more[STREAM_CAPACITY];   // as in kdtree_closest(), like the trail
  ulong trail[STREAM_CAPACITY];
} StreamTraversal;

// The first where `use_first` is 1, the second where it is 0. By arithmetic, as all choices below: of others the
// compiler makes branches.
INLINE uint chosen(uint use_first, uint first, uint second) { return second ^ ((second ^ first) & -use_first); }

INLINE SlabRay traverse_slab(const StreamTraversal *state, uint i) {
  SlabRay slab;
  SLAB_ORIGIN_COMPONENTS(LOAD_ENTRY, slab)
  SLAB_COMPONENTS(LOAD_ENTRY, slab)
  return slab;
}

INLINE TriangleRay traverse_triangle(const StreamTraversal *state, uint i) {
  TriangleRay ray;
  TRIANGLE_COMPONENTS(LOAD_ENTRY, ray)
  return ray;
}

INLINE Hit traverse_hit(const StreamTraversal *state, uint i) {
  Hit hit;
  HIT_COMPONENTS(LOAD_ENTRY, hit)
  hit.diagnostics = state->diagnostics[i];
  return hit;
}

INLINE void traverse_put_hit(StreamTraversal *state, uint i, Hit hit) {
  HIT_COMPONENTS(STORE_ENTRY, hit)
  state->diagnostics[i] = hit.diagnostics;
}

INLINE void traverse_begin(global const KdNode *root, const RayArrays *rays, StreamTraversal *state, uint i) {
  Ray ray = arrays_ray(rays, i);
  SlabRay slab = slab_ray(ray, root);
  TriangleRay triangle = triangle_ray(ray);
  SLAB_ORIGIN_COMPONENTS(STORE_ENTRY, slab)
  SLAB_COMPONENTS(STORE_ENTRY, slab)
  TRIANGLE_COMPONENTS(STORE_ENTRY, triangle)
  traverse_put_hit(state, i, arrays_hit(rays, i));
  state->node[i] = 0, state->slot[i] = 0, state->again[i] = 0, state->more[i] = 0, state->trail[i] = 0;
}

INLINE uint traverse_child(global const KdNode *nodes, const StreamTraversal *traverse, uint i) {
  return nodes[traverse->node[i]].child[traverse->slot[i]];
}

// The two least of eight.
INLINE void two_least(int8 v, int *least, int *second) {
  int4 low = min(v.lo, v.hi), high = max(v.lo, v.hi);
  int4 a = min(low, low.zwxy), b = min(min(high, high.zwxy), max(low, low.zwxy));
  *least = min(a, a.yxwz).x;
  *second = min(min(b, b.yxwz), max(a, a.yxwz)).x;
}

// Goes to `child`, in `slot` of `node`, whose trail is given; with `inner` that is a node, where the ray is then.
INLINE void traverse_to(StreamTraversal *traverse, uint i, uint node, uint slot, uint child, uint inner, ulong trail, uint more) {
  traverse->node[i] = chosen(inner, child, node);
  traverse->slot[i] = slot;
  traverse->trail[i] = trail << (inner * 4u);
  traverse->more[i] = more << inner;
}

// Tests the node that ray i is at, and goes to the nearest child that it meets: *inner or *leaf, one of them 1, or both
// 0 where it meets none that is left.
INLINE void traverse_node(global const KdNode *nodes, StreamTraversal *traverse, uint i, uint *inner, uint *leaf) {
  const int8 lanes = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  uint index = traverse->node[i], more = traverse->more[i];
  ulong trail = traverse->trail[i];
  global const KdNode *node = nodes + index;
  float8 enter, leave;
  node_intervals(node, traverse_slab(traverse, i), &enter, &leave);
  int8 key = (as_int8(enter + leave) & ~7) | lanes;
  int8 did_hit = (enter <= leave) & (enter < traverse->t[i]);
  if (traverse->again[i]) {  // few are
    traverse->again[i] = 0;
    int keys[8];
    vstore8(key, 0, keys);
    did_hit &= key > keys[traverse->slot[i]];
  }
  uint left = lane_bits(did_hit), rest = left & (left - 1u);
  int nearest, second;
  two_least(did_hit ? key : INT_MAX, &nearest, &second);
  uint slot = (uint)nearest & 7u, child = node->child[slot];
  uint any = left != 0, is_leaf = child >> 31, two = rest != 0, three = (rest & (rest - 1u)) != 0;
  *inner = any & ~is_leaf;
  *leaf = any & is_leaf;
  trail = (trail & ~15ul) | ((TRAIL_NEXT | ((uint)second & 7u)) * two);
  traverse_to(traverse, i, index, slot, child, *inner, trail, (more & ~1u) | three);
}

// Meets ray i with eight triangles, as block_closest(). Returns 1 if there is a nearer hit.
INLINE uint traverse_block(global const TriangleBlock *blocks, uint index, StreamTraversal *traverse, uint i) {
  TriangleRay ray = traverse_triangle(traverse, i);
  float t_max = traverse->t[i];
  BlockCorners corners;
  block_corners(blocks + index, ray, &corners);
  float8 distance, weight_1, weight_2;
  int8 did_hit = block_hits(&corners, ray.scale_z, t_max, &distance, &weight_1, &weight_2);
  float8 t = did_hit ? distance : (float8)INFINITY;
  float nearest = min_lane(t), weights[16];
  uint found = nearest < t_max, lane = lowest_bit(lane_bits(t == nearest));
  vstore8(weight_1, 0, weights);
  vstore8(weight_2, 1, weights);
  traverse->t[i] = min(nearest, t_max);
  traverse->primitive[i] = chosen(found, index * 8u + lane, traverse->primitive[i]);
  traverse->u[i] = as_float(chosen(found, as_uint(weights[lane]), as_uint(traverse->u[i])));
  traverse->v[i] = as_float(chosen(found, as_uint(weights[8u + lane]), as_uint(traverse->v[i])));
  return found;
}

// Meets ray i with the leaf of triangles that it is at. Returns 1 if there is a nearer hit.
INLINE uint traverse_triangles(global const KdNode *nodes, global const TriangleBlock *blocks, StreamTraversal *traverse, uint i) {
  uint first = traverse_child(nodes, traverse, i) & KD_INDEX, count = nodes[traverse->node[i]].block_count[traverse->slot[i]];
  uint found = traverse_block(blocks, first, traverse, i);
  for (uint block = 1; block < count; ++block) found |= traverse_block(blocks, first + block, traverse, i);
  return found;
}

// The same for a leaf that holds other shapes too.
INLINE uint traverse_shapes(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                        global const float *curves, const RayArrays *rays, StreamTraversal *traverse, uint i) {
  Hit hit = traverse_hit(traverse, i);
  uint count = nodes[traverse->node[i]].block_count[traverse->slot[i]];
  TreeRay r = {arrays_ray(rays, i), traverse_triangle(traverse, i), traverse_slab(traverse, i)};
  bool found = leaf_closest(blocks, shapes, curves, traverse_child(nodes, traverse, i), count, &r, &hit);
  traverse_put_hit(traverse, i, hit);
  return found ? 1u : 0u;
}

// Goes to what the trail of ray i names next, which it does: *inner or *leaf as above. What must be tested again is
// *inner.
INLINE void backtrack(global const KdNode *nodes, StreamTraversal *traverse, uint i, uint *inner, uint *leaf) {
  uint index = traverse->node[i], more = traverse->more[i], slot = traverse->slot[i];
  ulong trail = traverse->trail[i];
  uint levels = (63u - (uint)clz(trail & -trail)) / 4u;
  trail >>= 4u * levels;
  more >>= levels;
  for (; levels != 0; --levels) {
    slot = nodes[index].slot;
    index = nodes[index].parent;
  }
  uint named = (uint)trail & 15u, again = named == TRAIL_RETEST;
  uint child = nodes[index].child[named & 7u];
  *leaf = (child >> 31) & ~again, *inner = *leaf ^ 1u;
  slot = chosen(again, slot, named & 7u);
  trail ^= chosen(again, 0, named ^ chosen(more & 1u, TRAIL_RETEST, TRAIL_DONE));
  traverse->again[i] = again;
  traverse_to(traverse, i, index, slot, child, *inner & ~again, trail, more);
}

// The nearest hits before rays->t of `count` rays, STREAM_CAPACITY at most. Reads them up to stream_padded(count). Writes
// their DIAGNOSTIC_* bits to `diagnostics`.
OUTLINE void kdtree_stream(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                         global const float *curves, const RayArrays *arrays, uint count, uint *diagnostics) {
  const RayArrays rays = *arrays;
  StreamTraversal traverse;
  uint padded = stream_padded(count);
#pragma clang loop vectorize(assume_safety)
  for (uint i = 0; i < padded; ++i) traverse_begin(nodes, &rays, &traverse, i);
  // The rays that are at a node or a leaf, that have found a hit there, and that are to go back.
  uint at_node[STREAM_CAPACITY], at_leaf[STREAM_CAPACITY], hits[STREAM_CAPACITY], back[STREAM_CAPACITY];
  uint node_count = nodes->child[0] == 0 ? 0 : count, leaf_count = 0;
  for (uint i = 0; i < count; ++i) at_node[i] = i;
  for (uint step = 0; node_count + leaf_count > 0 && step < KD_STEP_LIMIT; ++step) {
    uint still = 0, hit_count = 0, back_count = 0, inner, leaf;
    for (uint k = 0; k < node_count; ++k) {
      uint i = at_node[k];
      traverse_node(nodes, &traverse, i, &inner, &leaf);
      fetch_ahead((size_t)(nodes + traverse.node[i]));
      at_node[still] = i, still += inner;
      at_leaf[leaf_count] = i, leaf_count += leaf;
      back[back_count] = i, back_count += (1u - inner - leaf) & (traverse.trail[i] != 0);
    }
    node_count = still;
    for (uint k = 0; k < leaf_count; ++k) {
      size_t block = (size_t)(blocks + (traverse_child(nodes, &traverse, at_leaf[k]) & KD_INDEX));
      fetch_ahead(block);
      fetch_ahead(block + sizeof(TriangleBlock) - 256u);
    }
    for (uint k = 0; k < leaf_count; ++k) {
      uint i = at_leaf[k], found;
      if (HAS(EFFECTS_IN_SHAPE_LEAVES) && (traverse_child(nodes, &traverse, i) & KD_SHAPES))
        found = traverse_shapes(nodes, blocks, shapes, curves, &rays, &traverse, i);
      else
        found = HAS(EFFECT_TRIANGLES) ? traverse_triangles(nodes, blocks, &traverse, i) : 0;
      hits[hit_count] = i, hit_count += found;
      back[back_count] = i, back_count += ~found & (traverse.trail[i] != 0);
    }
    for (uint k = 0; k < hit_count; ++k) {
      uint i = hits[k];
      uint final = hit_is_final(nodes + traverse.node[i], traverse.slot[i], traverse_slab(&traverse, i), traverse.t[i]);
      back[back_count] = i, back_count += ~final & (traverse.trail[i] != 0);
    }
    leaf_count = 0;
    for (uint k = 0; k < back_count; ++k) {
      uint i = back[k];
      backtrack(nodes, &traverse, i, &inner, &leaf);
      fetch_ahead((size_t)(nodes + traverse.node[i]));
      at_node[node_count] = i, node_count += inner;
      at_leaf[leaf_count] = i, leaf_count += leaf;
    }
  }
  for (uint i = 0; i < count; ++i) {
    Hit hit = traverse_hit(&traverse, i);
    arrays_put_hit(&rays, i, hit);
    diagnostics[i] = hit.diagnostics;
  }
  for (uint k = 0; k < node_count; ++k) diagnostics[at_node[k]] |= DIAGNOSTIC_TRAVERSAL_BOUND;
  for (uint k = 0; k < leaf_count; ++k) diagnostics[at_leaf[k]] |= DIAGNOSTIC_TRAVERSAL_BOUND;
}
#endif
