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
#include "core/vector.cl"
#include "core/stream_size.cl"

#if STREAM_CAPACITY > 1u && !defined(CAUSTICL_DOUBLE) && !defined(TRIANGLES_PRECOMPUTED)
#define KDTREE_STREAMS
#endif

#ifdef KDTREE_STREAMS
// Where each ray is in the tree, and what it has met so far.
typedef struct {
  float inverse[3][STREAM_CAPACITY], widening[3][STREAM_CAPACITY];  // these and the next two as in SlabRay
  float enter[3][STREAM_CAPACITY], leave[3][STREAM_CAPACITY];
  uint near[3][STREAM_CAPACITY], far[3][STREAM_CAPACITY];
  uint axis[3][STREAM_CAPACITY];  // these and the next line as in TriangleRay
  float sheared_origin[3][STREAM_CAPACITY], shear[2][STREAM_CAPACITY], scale_z[STREAM_CAPACITY];
  float origin[3][STREAM_CAPACITY], t[STREAM_CAPACITY], u[STREAM_CAPACITY], v[STREAM_CAPACITY];  // of ray and hit
  uint primitive[STREAM_CAPACITY], diagnostics[STREAM_CAPACITY];
  uint node[STREAM_CAPACITY], slot[STREAM_CAPACITY];  // where it is, and the child that it is at or has just left
  uint again[STREAM_CAPACITY];  // 1 where the node is to be tested for children after `slot` alone
  uint more[STREAM_CAPACITY];   // as in kdtree_closest(), like the trail
  ulong trail[STREAM_CAPACITY];
} StreamTraversal;

// The first where `use_first` is 1, the second where it is 0. By arithmetic, as all choices below: of others the
// compiler makes branches.
INLINE uint chosen(uint use_first, uint first, uint second) { return second ^ ((second ^ first) & -use_first); }

INLINE void traverse_axis(StreamTraversal *traverse, uint k, uint i, float origin, SlabAxis s) {
  traverse->origin[k][i] = origin;
  traverse->inverse[k][i] = s.inverse, traverse->widening[k][i] = s.widening;
  traverse->enter[k][i] = s.enter, traverse->leave[k][i] = s.leave;
  traverse->near[k][i] = s.near, traverse->far[k][i] = s.far;
}

INLINE void traverse_begin(global const KdNode *root, const RayArrays *rays, StreamTraversal *traverse, uint i) {
  Ray ray = arrays_ray(rays, i);
  float x = ray.origin.x, y = ray.origin.y, z = ray.origin.z, farthest = farthest_in_tree(root, x, y, z);
  traverse_axis(traverse, 0, i, x, slab_axis(x, ray.direction.x, farthest, 0));
  traverse_axis(traverse, 1, i, y, slab_axis(y, ray.direction.y, farthest, 8));
  traverse_axis(traverse, 2, i, z, slab_axis(z, ray.direction.z, farthest, 16));
  TriangleRay t = triangle_ray(ray);
  traverse->axis[0][i] = t.x, traverse->axis[1][i] = t.y, traverse->axis[2][i] = t.z;
  traverse->sheared_origin[0][i] = t.origin_x, traverse->sheared_origin[1][i] = t.origin_y;
  traverse->sheared_origin[2][i] = t.origin_z;
  traverse->shear[0][i] = t.shear_x, traverse->shear[1][i] = t.shear_y, traverse->scale_z[i] = t.scale_z;
  traverse->t[i] = rays->t[i], traverse->u[i] = rays->u[i], traverse->v[i] = rays->v[i], traverse->primitive[i] = rays->primitive[i];
  traverse->diagnostics[i] = 0;
  traverse->node[i] = 0, traverse->slot[i] = 0, traverse->again[i] = 0, traverse->more[i] = 0, traverse->trail[i] = 0;
}

INLINE SlabRay traverse_slab(const StreamTraversal *traverse, uint i) {
  SlabRay s;
  s.origin = (float3)(traverse->origin[0][i], traverse->origin[1][i], traverse->origin[2][i]);
  s.inverse = (float3)(traverse->inverse[0][i], traverse->inverse[1][i], traverse->inverse[2][i]);
  s.widening = (float3)(traverse->widening[0][i], traverse->widening[1][i], traverse->widening[2][i]);
  s.enter = (float3)(traverse->enter[0][i], traverse->enter[1][i], traverse->enter[2][i]);
  s.leave = (float3)(traverse->leave[0][i], traverse->leave[1][i], traverse->leave[2][i]);
  s.near_x = traverse->near[0][i], s.near_y = traverse->near[1][i], s.near_z = traverse->near[2][i];
  s.far_x = traverse->far[0][i], s.far_y = traverse->far[1][i], s.far_z = traverse->far[2][i];
  return s;
}

INLINE TriangleRay traverse_triangle(const StreamTraversal *traverse, uint i) {
  TriangleRay t;
  t.x = traverse->axis[0][i], t.y = traverse->axis[1][i], t.z = traverse->axis[2][i];
  t.origin_x = traverse->sheared_origin[0][i], t.origin_y = traverse->sheared_origin[1][i];
  t.origin_z = traverse->sheared_origin[2][i];
  t.shear_x = traverse->shear[0][i], t.shear_y = traverse->shear[1][i], t.scale_z = traverse->scale_z[i];
  return t;
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
  Hit hit = {traverse->t[i], traverse->primitive[i], traverse->u[i], traverse->v[i], traverse->diagnostics[i]};
  uint count = nodes[traverse->node[i]].block_count[traverse->slot[i]];
  TreeRay r = {arrays_ray(rays, i), traverse_triangle(traverse, i), traverse_slab(traverse, i)};
  bool found = leaf_closest(blocks, shapes, curves, traverse_child(nodes, traverse, i), count, &r, &hit);
  traverse->t[i] = hit.t, traverse->primitive[i] = hit.primitive, traverse->u[i] = hit.u, traverse->v[i] = hit.v;
  traverse->diagnostics[i] = hit.diagnostics;
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
    rays.t[i] = traverse.t[i], rays.u[i] = traverse.u[i], rays.v[i] = traverse.v[i], rays.primitive[i] = traverse.primitive[i];
    diagnostics[i] = traverse.diagnostics[i];
  }
  for (uint k = 0; k < node_count; ++k) diagnostics[at_node[k]] |= DIAGNOSTIC_TRAVERSAL_BOUND;
  for (uint k = 0; k < leaf_count; ++k) diagnostics[at_leaf[k]] |= DIAGNOSTIC_TRAVERSAL_BOUND;
}
#endif
