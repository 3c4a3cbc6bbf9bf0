// Traversal of the tree by waves: the hits of rays that go different ways, as those of photons do.
//
// A ray alone mostly waits: each step for the last one, and for memory; and where steps differ from ray to ray no
// processor foresees its branches. Here all rays of a wave take a step of one kind before any takes the next: tests of
// nodes, then of the triangles in leaves, then the ways back. These steps have hardly a branch: what a ray does next it
// is told by lists, to whose ends every ray is written and where only those stay that are counted. So the steps of
// several rays overlap in the processor, and what the next ones read is fetched ahead. Every ray visits what it visits
// in kdtree_closest(), to the same hits to the bit; KD_STEP_LIMIT counts the steps of the wave. Shadow rays, most of
// which meet nothing on a way that they share, are faster alone.
//
// On devices that run the items of a work-group in turn; for float and the watertight test.
#include "traversal/kdtree.cl"
#include "core/vector.cl"
#include "core/stream_size.cl"

#if WAVE_CAPACITY > 1u && !defined(CAUSTICL_DOUBLE) && !defined(TRIANGLES_PRECOMPUTED)
#define KDTREE_WAVES
#endif

#ifdef KDTREE_WAVES
// Where each ray is in the tree, and what it has met so far.
typedef struct {
  float inverse[3][WAVE_CAPACITY], widening[3][WAVE_CAPACITY];  // these and the next two as in SlabRay
  float enter[3][WAVE_CAPACITY], leave[3][WAVE_CAPACITY];
  uint near[3][WAVE_CAPACITY], far[3][WAVE_CAPACITY];
  uint axis[3][WAVE_CAPACITY];  // these and the next line as in TriangleRay
  float sheared_origin[3][WAVE_CAPACITY], shear[2][WAVE_CAPACITY], scale_z[WAVE_CAPACITY];
  float origin[3][WAVE_CAPACITY], t[WAVE_CAPACITY], u[WAVE_CAPACITY], v[WAVE_CAPACITY];  // of ray and hit
  uint primitive[WAVE_CAPACITY], faults[WAVE_CAPACITY];
  uint node[WAVE_CAPACITY], slot[WAVE_CAPACITY];  // where it is, and the child that it is at or has just left
  uint again[WAVE_CAPACITY];  // 1 where the node is to be tested for children after `slot` alone
  uint more[WAVE_CAPACITY];   // as in kdtree_closest(), like the trail
  ulong trail[WAVE_CAPACITY];
} WaveWalk;

// The first where `use_first` is 1, the second where it is 0. By arithmetic, as all choices below: of others the
// compiler makes branches.
INLINE uint chosen(uint use_first, uint first, uint second) { return second ^ ((second ^ first) & -use_first); }

INLINE void walk_axis(WaveWalk *walk, uint k, uint i, float origin, SlabAxis s) {
  walk->origin[k][i] = origin;
  walk->inverse[k][i] = s.inverse, walk->widening[k][i] = s.widening;
  walk->enter[k][i] = s.enter, walk->leave[k][i] = s.leave;
  walk->near[k][i] = s.near, walk->far[k][i] = s.far;
}

INLINE void walk_begin(global const KdNode *root, const RayArrays *rays, WaveWalk *walk, uint i) {
  Ray ray = arrays_ray(rays, i);
  float x = ray.origin.x, y = ray.origin.y, z = ray.origin.z, farthest = farthest_in_tree(root, x, y, z);
  walk_axis(walk, 0, i, x, slab_axis(x, ray.direction.x, farthest, 0));
  walk_axis(walk, 1, i, y, slab_axis(y, ray.direction.y, farthest, 8));
  walk_axis(walk, 2, i, z, slab_axis(z, ray.direction.z, farthest, 16));
  TriangleRay t = triangle_ray(ray);
  walk->axis[0][i] = t.x, walk->axis[1][i] = t.y, walk->axis[2][i] = t.z;
  walk->sheared_origin[0][i] = t.origin_x, walk->sheared_origin[1][i] = t.origin_y;
  walk->sheared_origin[2][i] = t.origin_z;
  walk->shear[0][i] = t.shear_x, walk->shear[1][i] = t.shear_y, walk->scale_z[i] = t.scale_z;
  walk->t[i] = rays->t[i], walk->u[i] = rays->u[i], walk->v[i] = rays->v[i], walk->primitive[i] = rays->primitive[i];
  walk->faults[i] = 0;
  walk->node[i] = 0, walk->slot[i] = 0, walk->again[i] = 0, walk->more[i] = 0, walk->trail[i] = 0;
}

INLINE SlabRay walk_slab(const WaveWalk *walk, uint i) {
  SlabRay s;
  s.origin = (float3)(walk->origin[0][i], walk->origin[1][i], walk->origin[2][i]);
  s.inverse = (float3)(walk->inverse[0][i], walk->inverse[1][i], walk->inverse[2][i]);
  s.widening = (float3)(walk->widening[0][i], walk->widening[1][i], walk->widening[2][i]);
  s.enter = (float3)(walk->enter[0][i], walk->enter[1][i], walk->enter[2][i]);
  s.leave = (float3)(walk->leave[0][i], walk->leave[1][i], walk->leave[2][i]);
  s.near_x = walk->near[0][i], s.near_y = walk->near[1][i], s.near_z = walk->near[2][i];
  s.far_x = walk->far[0][i], s.far_y = walk->far[1][i], s.far_z = walk->far[2][i];
  return s;
}

INLINE TriangleRay walk_triangle(const WaveWalk *walk, uint i) {
  TriangleRay t;
  t.x = walk->axis[0][i], t.y = walk->axis[1][i], t.z = walk->axis[2][i];
  t.origin_x = walk->sheared_origin[0][i], t.origin_y = walk->sheared_origin[1][i];
  t.origin_z = walk->sheared_origin[2][i];
  t.shear_x = walk->shear[0][i], t.shear_y = walk->shear[1][i], t.scale_z = walk->scale_z[i];
  return t;
}

INLINE uint walk_child(global const KdNode *nodes, const WaveWalk *walk, uint i) {
  return nodes[walk->node[i]].child[walk->slot[i]];
}

// The two least of eight.
INLINE void two_least(int8 v, int *least, int *second) {
  int4 low = min(v.lo, v.hi), high = max(v.lo, v.hi);
  int4 a = min(low, low.zwxy), b = min(min(high, high.zwxy), max(low, low.zwxy));
  *least = min(a, a.yxwz).x;
  *second = min(min(b, b.yxwz), max(a, a.yxwz)).x;
}

// Goes to `child`, in `slot` of `node`, whose trail is given; with `inner` that is a node, where the ray is then.
INLINE void walk_to(WaveWalk *walk, uint i, uint node, uint slot, uint child, uint inner, ulong trail, uint more) {
  walk->node[i] = chosen(inner, child, node);
  walk->slot[i] = slot;
  walk->trail[i] = trail << (inner * 4u);
  walk->more[i] = more << inner;
}

// Tests the node that ray i is at, and goes to the nearest child that it meets: *inner or *leaf, one of them 1, or both
// 0 where it meets none that is left.
INLINE void walk_node(global const KdNode *nodes, WaveWalk *walk, uint i, uint *inner, uint *leaf) {
  const int8 lanes = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  uint index = walk->node[i], more = walk->more[i];
  ulong trail = walk->trail[i];
  global const KdNode *node = nodes + index;
  float8 enter, leave;
  node_intervals(node, walk_slab(walk, i), &enter, &leave);
  int8 key = (as_int8(enter + leave) & ~7) | lanes;
  int8 met = (enter <= leave) & (enter < walk->t[i]);
  if (walk->again[i]) {  // few are
    walk->again[i] = 0;
    int keys[8];
    vstore8(key, 0, keys);
    met &= key > keys[walk->slot[i]];
  }
  uint left = lane_bits(met), rest = left & (left - 1u);
  int nearest, second;
  two_least(met ? key : INT_MAX, &nearest, &second);
  uint slot = (uint)nearest & 7u, child = node->child[slot];
  uint any = left != 0, is_leaf = child >> 31, two = rest != 0, three = (rest & (rest - 1u)) != 0;
  *inner = any & ~is_leaf;
  *leaf = any & is_leaf;
  trail = (trail & ~15ul) | ((TRAIL_NEXT | ((uint)second & 7u)) * two);
  walk_to(walk, i, index, slot, child, *inner, trail, (more & ~1u) | three);
}

// Meets ray i with eight triangles, as block_closest(). Returns 1 if there is a nearer hit.
INLINE uint walk_block(global const TriangleBlock *blocks, uint index, WaveWalk *walk, uint i) {
  TriangleRay ray = walk_triangle(walk, i);
  float t_max = walk->t[i];
  BlockCorners corners;
  block_corners(blocks + index, ray, &corners);
  float8 distance, weight_1, weight_2;
  int8 met = block_meets(&corners, ray.scale_z, t_max, &distance, &weight_1, &weight_2);
  float8 t = met ? distance : (float8)INFINITY;
  float nearest = min_lane(t), weights[16];
  uint found = nearest < t_max, lane = lowest_bit(lane_bits(t == nearest));
  vstore8(weight_1, 0, weights);
  vstore8(weight_2, 1, weights);
  walk->t[i] = min(nearest, t_max);
  walk->primitive[i] = chosen(found, index * 8u + lane, walk->primitive[i]);
  walk->u[i] = as_float(chosen(found, as_uint(weights[lane]), as_uint(walk->u[i])));
  walk->v[i] = as_float(chosen(found, as_uint(weights[8u + lane]), as_uint(walk->v[i])));
  return found;
}

// Meets ray i with the leaf of triangles that it is at. Returns 1 if there is a nearer hit.
INLINE uint walk_triangles(global const KdNode *nodes, global const TriangleBlock *blocks, WaveWalk *walk, uint i) {
  uint first = walk_child(nodes, walk, i) & KD_INDEX, count = nodes[walk->node[i]].block_count[walk->slot[i]];
  uint found = walk_block(blocks, first, walk, i);
  for (uint block = 1; block < count; ++block) found |= walk_block(blocks, first + block, walk, i);
  return found;
}

// The same for a leaf that holds other shapes too.
INLINE uint walk_shapes(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                        global const float *curves, const RayArrays *rays, WaveWalk *walk, uint i) {
  Hit hit = {walk->t[i], walk->primitive[i], walk->u[i], walk->v[i], walk->faults[i]};
  uint count = nodes[walk->node[i]].block_count[walk->slot[i]];
  bool found = leaf_closest(blocks, shapes, curves, walk_child(nodes, walk, i), count, arrays_ray(rays, i),
                            walk_triangle(walk, i), walk_slab(walk, i), &hit);
  walk->t[i] = hit.t, walk->primitive[i] = hit.primitive, walk->u[i] = hit.u, walk->v[i] = hit.v;
  walk->faults[i] = hit.faults;
  return found ? 1u : 0u;
}

// Goes to what the trail of ray i names next, which it does: *inner or *leaf as above. What must be tested again is
// *inner.
INLINE void walk_back(global const KdNode *nodes, WaveWalk *walk, uint i, uint *inner, uint *leaf) {
  uint index = walk->node[i], more = walk->more[i], slot = walk->slot[i];
  ulong trail = walk->trail[i];
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
  walk->again[i] = again;
  walk_to(walk, i, index, slot, child, *inner & ~again, trail, more);
}

// The nearest hits before rays->t of `count` rays, WAVE_CAPACITY at most. Reads them up to wave_padded(count). Writes
// their FAULT_* bits to `faults`.
OUTLINE void kdtree_wave(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                         global const float *curves, const RayArrays *arrays, uint count, uint *faults) {
  const RayArrays rays = *arrays;
  WaveWalk walk;
  uint padded = wave_padded(count);
#pragma clang loop vectorize(assume_safety)
  for (uint i = 0; i < padded; ++i) walk_begin(nodes, &rays, &walk, i);
  // The rays that are at a node or a leaf, that have found a hit there, and that are to go back.
  uint at_node[WAVE_CAPACITY], at_leaf[WAVE_CAPACITY], hits[WAVE_CAPACITY], back[WAVE_CAPACITY];
  uint node_count = nodes->child[0] == 0 ? 0 : count, leaf_count = 0;
  for (uint i = 0; i < count; ++i) at_node[i] = i;
  for (uint step = 0; node_count + leaf_count > 0 && step < KD_STEP_LIMIT; ++step) {
    uint still = 0, hit_count = 0, back_count = 0, inner, leaf;
    for (uint k = 0; k < node_count; ++k) {
      uint i = at_node[k];
      walk_node(nodes, &walk, i, &inner, &leaf);
      fetch_ahead((size_t)(nodes + walk.node[i]));
      at_node[still] = i, still += inner;
      at_leaf[leaf_count] = i, leaf_count += leaf;
      back[back_count] = i, back_count += (1u - inner - leaf) & (walk.trail[i] != 0);
    }
    node_count = still;
    for (uint k = 0; k < leaf_count; ++k) {
      size_t block = (size_t)(blocks + (walk_child(nodes, &walk, at_leaf[k]) & KD_INDEX));
      fetch_ahead(block);
      fetch_ahead(block + sizeof(TriangleBlock) - 256u);
    }
    for (uint k = 0; k < leaf_count; ++k) {
      uint i = at_leaf[k], found;
      if (HAS(EFFECT_SPHERES | EFFECT_DISKS | EFFECT_BEZIER) && (walk_child(nodes, &walk, i) & KD_SHAPES))
        found = walk_shapes(nodes, blocks, shapes, curves, &rays, &walk, i);
      else
        found = HAS(EFFECT_TRIANGLES) ? walk_triangles(nodes, blocks, &walk, i) : 0;
      hits[hit_count] = i, hit_count += found;
      back[back_count] = i, back_count += ~found & (walk.trail[i] != 0);
    }
    for (uint k = 0; k < hit_count; ++k) {
      uint i = hits[k];
      uint final = hit_is_final(nodes + walk.node[i], walk.slot[i], walk_slab(&walk, i), walk.t[i]);
      back[back_count] = i, back_count += ~final & (walk.trail[i] != 0);
    }
    leaf_count = 0;
    for (uint k = 0; k < back_count; ++k) {
      uint i = back[k];
      walk_back(nodes, &walk, i, &inner, &leaf);
      fetch_ahead((size_t)(nodes + walk.node[i]));
      at_node[node_count] = i, node_count += inner;
      at_leaf[leaf_count] = i, leaf_count += leaf;
    }
  }
  for (uint i = 0; i < count; ++i) {
    rays.t[i] = walk.t[i], rays.u[i] = walk.u[i], rays.v[i] = walk.v[i], rays.primitive[i] = walk.primitive[i];
    faults[i] = walk.faults[i];
  }
  for (uint k = 0; k < node_count; ++k) faults[at_node[k]] |= FAULT_TRAVERSAL_BOUND;
  for (uint k = 0; k < leaf_count; ++k) faults[at_leaf[k]] |= FAULT_TRAVERSAL_BOUND;
}
#endif
