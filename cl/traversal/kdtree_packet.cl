// Traversal of the tree by packets: the nearest hits of sixteen rays that go much the same way, as those of
// neighbouring pixels do.
//
// The hits are those of kdtree_closest() to the bit. A node is tested once for all rays, by bounds of their origins and
// directions: the packet goes to every cell in which one of them can have a hit, and to some more. It needs no order,
// so a stack will do: nearer cells come first only to leave out what lies behind all hits. Where the order of a ray's
// own visits decides, which is between two triangles at the same distance, the ray is traced again on its own. So is a
// ray that comes near a shape, which would have to be met alone in any case.
//
// For float and the watertight test alone.
#include "traversal/kdtree.cl"
#include "traversal/triangle_packet.cl"

#if !defined(CAUSTICL_DOUBLE) && !defined(TRIANGLES_PRECOMPUTED)
// Fewer rays that go the same way go alone.
#define PACKET_LEAST 4u

// Rays, and their hits as Hit has them: first that up to which they are traced (hit_none() or what has been found
// elsewhere), then the nearest.
typedef struct {
  float origin[3][PACKET_RAYS];
  float direction[3][PACKET_RAYS];
  float t[PACKET_RAYS], u[PACKET_RAYS], v[PACKET_RAYS];
  uint primitive[PACKET_RAYS], diagnostics[PACKET_RAYS];
} RayPacket;

INLINE void packet_set(RayPacket *rays, uint i, Ray ray, Hit hit) {
  rays->origin[0][i] = ray.origin.x, rays->origin[1][i] = ray.origin.y, rays->origin[2][i] = ray.origin.z;
  rays->direction[0][i] = ray.direction.x, rays->direction[1][i] = ray.direction.y;
  rays->direction[2][i] = ray.direction.z;
  rays->t[i] = hit.t, rays->u[i] = hit.u, rays->v[i] = hit.v;
  rays->primitive[i] = hit.primitive, rays->diagnostics[i] = hit.diagnostics;
}

INLINE Ray packet_ray(const RayPacket *rays, uint i) {
  Ray ray = {(float3)(rays->origin[0][i], rays->origin[1][i], rays->origin[2][i]),
             (float3)(rays->direction[0][i], rays->direction[1][i], rays->direction[2][i])};
  return ray;
}

INLINE Hit packet_hit(const RayPacket *rays, uint i) {
  Hit hit = {rays->t[i], rays->primitive[i], rays->u[i], rays->v[i], rays->diagnostics[i]};
  return hit;
}

// SlabRay of every ray.
typedef struct {
  float16 inverse_x, inverse_y, inverse_z;
  float16 enter_x, enter_y, enter_z, leave_x, leave_y, leave_z;
  float16 widening_x, widening_y, widening_z;
} PacketSlabs;

INLINE void packet_slab(float16 o, float16 d, float16 farthest, float16 *inverse, float16 *widening, float16 *enter,
                        float16 *leave) {
  *inverse = copysign(1 / fmax(fabs(d), (float16)1e-18f), d);
  *widening = fabs(*inverse) * ((8 * UNIT) * farthest + (2 * UNIT) * fabs(o));
  *enter = -o * *inverse - *widening;
  *leave = -o * *inverse + *widening;
}

INLINE PacketSlabs packet_slabs(global const KdNode *root, float16 ox, float16 oy, float16 oz, float16 dx, float16 dy,
                                float16 dz) {
  PacketSlabs s;
  float16 farthest = max(fabs(ox - root->bounds[0][0]), max(fabs(oy - root->bounds[1][0]), fabs(oz - root->bounds[2][0])));
  farthest += root->extent;
  packet_slab(ox, dx, farthest, &s.inverse_x, &s.widening_x, &s.enter_x, &s.leave_x);
  packet_slab(oy, dy, farthest, &s.inverse_y, &s.widening_y, &s.enter_y, &s.leave_y);
  packet_slab(oz, dz, farthest, &s.inverse_z, &s.widening_z, &s.enter_z, &s.leave_z);
  return s;
}

// Bounds of all rays, whose directions have the same signs: the origins from which the first ray enters and the last
// one leaves, along each axis. The widening is that of slab_ray() and two roundings of the distance more, since there
// a plane takes one fma() and here a difference, a product and a sum.
typedef struct {
  float3 near_origin, far_origin;
  float3 low_inverse, high_inverse;
  float3 widening;
  size_t near_x, near_y, near_z, far_x, far_y, far_z;  // as SlabRay has them
} PacketBounds;

INLINE PacketBounds packet_bounds(const PacketSlabs *s, uint signs, float16 ox, float16 oy, float16 oz) {
  PacketBounds b;
  float3 low = (float3)(packet_min(ox), packet_min(oy), packet_min(oz));
  float3 high = (float3)(packet_max(ox), packet_max(oy), packet_max(oz));
  int3 down = (int3)(signs & 1u, signs & 2u, signs & 4u) != 0;
  b.near_origin = down ? low : high;
  b.far_origin = down ? high : low;
  b.low_inverse = (float3)(packet_min(s->inverse_x), packet_min(s->inverse_y), packet_min(s->inverse_z));
  b.high_inverse = (float3)(packet_max(s->inverse_x), packet_max(s->inverse_y), packet_max(s->inverse_z));
  b.widening = 1.25f * (float3)(packet_max(s->widening_x), packet_max(s->widening_y), packet_max(s->widening_z));
  size_t x = signs & 1u ? 24 : 0, y = signs & 2u ? 24 : 0, z = signs & 4u ? 24 : 0;
  b.near_x = x, b.near_y = 8 + y, b.near_z = 16 + z;
  b.far_x = 24 - x, b.far_y = 32 - y, b.far_z = 40 - z;
  return b;
}

INLINE float8 packet_enter(float8 planes, float origin, float low_inverse, float high_inverse, float widening) {
  float8 distance = planes - origin;
  return min(distance * low_inverse, distance * high_inverse) - widening;
}

INLINE float8 packet_leave(float8 planes, float origin, float low_inverse, float high_inverse, float widening) {
  float8 distance = planes - origin;
  return max(distance * low_inverse, distance * high_inverse) + widening;
}

// Where the first ray enters and the last one leaves each child's cell, at most.
INLINE void packet_intervals(global const KdNode *node, const PacketBounds *b, float8 *enter, float8 *leave) {
  float3 low = b->low_inverse, high = b->high_inverse, w = b->widening;
  float8 near_x = packet_enter(slab_planes(node, b->near_x), b->near_origin.x, low.x, high.x, w.x);
  float8 near_y = packet_enter(slab_planes(node, b->near_y), b->near_origin.y, low.y, high.y, w.y);
  float8 near_z = packet_enter(slab_planes(node, b->near_z), b->near_origin.z, low.z, high.z, w.z);
  float8 far_x = packet_leave(slab_planes(node, b->far_x), b->far_origin.x, low.x, high.x, w.x);
  float8 far_y = packet_leave(slab_planes(node, b->far_y), b->far_origin.y, low.y, high.y, w.y);
  float8 far_z = packet_leave(slab_planes(node, b->far_z), b->far_origin.z, low.z, high.z, w.z);
  *enter = max(max(near_x, near_y), max(near_z, (float8)0));
  *leave = min(min(far_x, far_y), far_z);
}

// The rays that meet a box before their hits. `planes` points to the lane of a node, or of a block with a shape.
INLINE int16 packet_hits_box(global const float *planes, const PacketBounds *b, const PacketSlabs *s, float16 t) {
  float16 near_x = fma((float16)planes[b->near_x], s->inverse_x, s->enter_x);
  float16 near_y = fma((float16)planes[b->near_y], s->inverse_y, s->enter_y);
  float16 near_z = fma((float16)planes[b->near_z], s->inverse_z, s->enter_z);
  float16 far_x = fma((float16)planes[b->far_x], s->inverse_x, s->leave_x);
  float16 far_y = fma((float16)planes[b->far_y], s->inverse_y, s->leave_y);
  float16 far_z = fma((float16)planes[b->far_z], s->inverse_z, s->leave_z);
  float16 enter = max(max(near_x, near_y), max(near_z, (float16)0));
  return enter <= min(min(far_x, far_y), min(far_z, t));
}

// True if a hit was changed. Rays that meet the bounds of a shape are traced again, and here no further.
INLINE bool packet_leaf(global const TriangleBlock *blocks, uint child, uint count, const PacketBounds *b,
                        const PacketSlabs *s, const PacketTriangleRays *triangle, PacketHits *hits) {
  bool changed = false;
  uint first = child & KD_INDEX;
  for (uint i = first; i < first + count * BLOCK_STRIDE; i += BLOCK_STRIDE) {
    for (uint left = packet_candidates(blocks + i, triangle); left != 0; left &= left - 1u)
      changed |= packet_intersect(blocks, i, lowest_bit(left), triangle, hits);
    if (HAS(EFFECTS_IN_SHAPE_LEAVES) && (child & KD_SHAPES)) {
      int8 primitive = as_int8(*(global const uint8 *)blocks[i].primitive);
      for (uint left = lane_bits((primitive < 0) & (primitive != -1)); left != 0; left &= left - 1u) {
        int16 near = packet_hits_box(blocks[i].position[0][0] + lowest_bit(left), b, s, hits->t);
        hits->again |= packet_bits(near);
        hits->t = near ? (float16)-INFINITY : hits->t;
        changed = true;
      }
    }
  }
  return changed;
}

INLINE void packet_traverse(global const KdNode *nodes, global const TriangleBlock *blocks, const PacketBounds *b,
                        const PacketSlabs *s, const PacketTriangleRays *triangle, PacketHits *hits) {
  const int8 lanes = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  uint cells[7 * KD_LEVELS + 1];  // 8 * node + slot
  float entries[7 * KD_LEVELS + 1];
  uint size = 0, index = 0;
  float farthest = packet_max(hits->t);
  for (;;) {
    float8 enter, leave;
    packet_intervals(nodes + index, b, &enter, &leave);
    int8 did_hit = (enter <= leave) & (enter < farthest);
    // The children met, the farthest first, so that the nearest is taken next. Rounded down, an entry stays a bound.
    int8 key = did_hit ? (as_int8(enter) & 0x7ffffff8) | lanes : -1;
    for (uint left = lane_bits(did_hit); left != 0; left &= left - 1u) {
      int last = ~min_lane_int(~key);
      key = key == last ? -1 : key;
      cells[size] = index * 8u + ((uint)last & 7u);
      entries[size] = as_float(last & ~7);
      ++size;
    }
    for (;;) {
      if (size == 0) return;
      --size;
      if (entries[size] >= farthest) continue;
      uint slot = cells[size] & 7u;
      global const KdNode *node = nodes + cells[size] / 8u;
      uint child = node->child[slot];
      if (!(child & KD_LEAF)) {
        index = child;
        break;
      }
      if (packet_bits(packet_hits_box(node->bounds[0] + slot, b, s, hits->t)) == 0) continue;
      if (packet_leaf(blocks, child, node->block_count[slot], b, s, triangle, hits)) farthest = packet_max(hits->t);
    }
  }
}

// The rays of `left` that go the way of the first of them: their directions have the same signs and the same largest
// component. Stores their nearest hits, but for those that it adds to *again, which are as they were.
INLINE uint packet_closest(global const KdNode *nodes, global const TriangleBlock *blocks, RayPacket *rays, uint left,
                           uint *again) {
  float16 dx = vload16(0, rays->direction[0]), dy = vload16(0, rays->direction[1]), dz = vload16(0, rays->direction[2]);
  float16 ox = vload16(0, rays->origin[0]), oy = vload16(0, rays->origin[1]), oz = vload16(0, rays->origin[2]);
  float16 size_x = fabs(dx), size_y = fabs(dy), size_z = fabs(dz);
  int16 along_x = (size_x >= size_y) & (size_x >= size_z), along_y = size_y >= size_z;
  int16 way = (as_int16(dx) >> 31 & 1) | (as_int16(dy) >> 31 & 2) | (as_int16(dz) >> 31 & 4) |
              (along_x ? (int16)0 : (along_y ? (int16)8 : (int16)16));
  int ways[PACKET_RAYS];
  vstore16(way, 0, ways);
  uint first = lowest_bit(left);
  int own = ways[first];
  // NaN and infinity would be in the bounds of all.
  float16 sum = dx + dy + dz + ox + oy + oz;
  const int16 bits = (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
  int16 member = (way == own) & (((int16)(int)left & bits) != 0) & (sum - sum == 0);
  uint members = packet_bits(member);
  if (popcount(members) < PACKET_LEAST) {
    *again |= members | 1u << first;
    return members | 1u << first;
  }
  // The others become copies of one of these that nothing can hit.
  first = lowest_bit(members);
  dx = member ? dx : (float16)rays->direction[0][first], dy = member ? dy : (float16)rays->direction[1][first];
  dz = member ? dz : (float16)rays->direction[2][first], ox = member ? ox : (float16)rays->origin[0][first];
  oy = member ? oy : (float16)rays->origin[1][first], oz = member ? oz : (float16)rays->origin[2][first];
  float16 t = vload16(0, rays->t), u = vload16(0, rays->u), v = vload16(0, rays->v);
  uint16 primitive = vload16(0, rays->primitive);
  PacketHits hits = {member ? t : (float16)-INFINITY, u, v, primitive, (uint16)HIT_NONE, 0};

  PacketSlabs slabs = packet_slabs(nodes, ox, oy, oz, dx, dy, dz);
  PacketBounds bounds = packet_bounds(&slabs, (uint)own, ox, oy, oz);
  PacketTriangleRays triangle = packet_triangle_rays((uint)own / 8u, ox, oy, oz, dx, dy, dz);
  packet_traverse(nodes, blocks, &bounds, &slabs, &triangle, &hits);

  *again |= hits.again & members;
  packet_store(&hits, member, rays->t, rays->u, rays->v, rays->primitive);
  return members;
}

// kdtree_closest() of the rays whose bits are in `left`.
INLINE void kdtree_closest_packet(global const KdNode *nodes, global const TriangleBlock *blocks,
                                  global const Shape *shapes, global const float *curves, RayPacket *rays, uint left) {
  if (nodes->child[0] == 0) return;
  uint again = 0;
  while (left != 0) left &= ~packet_closest(nodes, blocks, rays, left, &again);
  for (; again != 0; again &= again - 1u) {
    uint i = lowest_bit(again);
    Ray ray = packet_ray(rays, i);
    Hit hit = packet_hit(rays, i);
    kdtree_closest(nodes, blocks, shapes, curves, ray, &hit);
    packet_set(rays, i, ray, hit);
  }
}
#endif
