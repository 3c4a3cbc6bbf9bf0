// One triangle against a packet of rays; a part of kdtree_packet.cl.
//
// The operations on each ray are those of block_intersect() of triangle_watertight.cl on each lane, in the same order,
// and so are the results to the bit. All rays have their largest component along the same axis.
#include "shapes/triangle.cl"

#if !defined(CAUSTICL_DOUBLE) && !defined(TRIANGLES_PRECOMPUTED)
#define PACKET_RAYS 16u

INLINE uint packet_bits(int16 m) { return lane_bits(m.lo) | lane_bits(m.hi) << 8; }

INLINE float packet_min(float16 v) {
  float8 a = min(v.lo, v.hi);
  float4 b = min(a.lo, a.hi);
  float2 c = min(b.lo, b.hi);
  return min(c.x, c.y);
}

INLINE float packet_max(float16 v) { return -packet_min(-v); }

// TriangleRay of every ray, and what bounds them all.
typedef struct {
  size_t x, y, z;
  float16 origin_x, origin_y, origin_z;
  float16 shear_x, shear_y, scale_z;
  bool one_origin;  // all rays start at `first`, so that the shears bound where they go
  float first_x, first_y, first_z;
  float low_x, high_x, low_y, high_y;
} PacketTriangleRays;

// `axis` is that along which all directions are largest.
INLINE PacketTriangleRays packet_triangle_rays(uint axis, float16 ox, float16 oy, float16 oz, float16 dx, float16 dy,
                                               float16 dz) {
  PacketTriangleRays p;
  if (axis == 0) {
    p.x = 8, p.y = 16, p.z = 0;
    p.origin_x = oy, p.origin_y = oz, p.origin_z = ox;
    p.shear_x = dy / dx, p.shear_y = dz / dx, p.scale_z = 1 / dx;
  } else if (axis == 1) {
    p.x = 16, p.y = 0, p.z = 8;
    p.origin_x = oz, p.origin_y = ox, p.origin_z = oy;
    p.shear_x = dz / dy, p.shear_y = dx / dy, p.scale_z = 1 / dy;
  } else {
    p.x = 0, p.y = 8, p.z = 16;
    p.origin_x = ox, p.origin_y = oy, p.origin_z = oz;
    p.shear_x = dx / dz, p.shear_y = dy / dz, p.scale_z = 1 / dz;
  }
  p.first_x = p.origin_x.s0, p.first_y = p.origin_y.s0, p.first_z = p.origin_z.s0;
  p.one_origin = packet_bits((p.origin_x != p.first_x) | (p.origin_y != p.first_y) | (p.origin_z != p.first_z)) == 0;
  p.low_x = packet_min(p.shear_x), p.high_x = packet_max(p.shear_x);
  p.low_y = packet_min(p.shear_y), p.high_y = packet_max(p.shear_y);
  return p;
}

// Heights of the corners of a block's triangles along the packet's axis, over the origin of its rays.
typedef struct {
  float8 a, b, c;
} CornerHeights;

// Least and greatest coordinates of a triangle's corners after the shears of all rays from one origin.
INLINE void packet_sheared(global const TriangleBlock *block, size_t row, float origin, float low_shear,
                           float high_shear, CornerHeights z, float8 *low, float8 *high) {
  float8 a = block_row(block, 0, row) - origin, b = block_row(block, 1, row) - origin,
         c = block_row(block, 2, row) - origin;
  float8 a_low = fma(-low_shear, z.a, a), a_high = fma(-high_shear, z.a, a);
  float8 b_low = fma(-low_shear, z.b, b), b_high = fma(-high_shear, z.b, b);
  float8 c_low = fma(-low_shear, z.c, c), c_high = fma(-high_shear, z.c, c);
  *low = min(min(min(a_low, a_high), min(b_low, b_high)), min(c_low, c_high));
  *high = max(max(max(a_low, a_high), max(b_low, b_high)), max(c_low, c_high));
}

// The lanes of a block with a triangle that some ray may meet, as bits. fma() rounds monotonically: between the least
// and the greatest shear lie the coordinates that packet_intersect() computes for every ray. Where they are all on one
// side of 0, no ray passes between the corners, and the edge functions, whose signs are exact, say so too; but not where
// products underflow, so that a corner may be nearly 0 on the wrong side.
INLINE uint packet_candidates(global const TriangleBlock *block, const PacketTriangleRays *p) {
  int8 kept = as_int8(*(global const uint8 *)block->primitive) >= 0;
  if (p->one_origin) {
    CornerHeights z = {block_row(block, 0, p->z) - p->first_z, block_row(block, 1, p->z) - p->first_z,
                       block_row(block, 2, p->z) - p->first_z};
    float8 low_x, high_x, low_y, high_y;
    packet_sheared(block, p->x, p->first_x, p->low_x, p->high_x, z, &low_x, &high_x);
    packet_sheared(block, p->y, p->first_y, p->low_y, p->high_y, z, &low_y, &high_y);
    kept &= (max(low_x, low_y) <= 1e-18f) & (min(high_x, high_y) >= -1e-18f);
  }
  return lane_bits(kept);
}

// The nearest hits so far.
typedef struct {
  float16 t, u, v;
  uint16 primitive;  // as Hit has it
  uint16 triangle;   // of the scene
  uint again;        // bits of the rays that must be traced on their own
} PacketHits;

INLINE float16 packet_signed_difference(float16 a, float16 b, float16 c, float16 d) {
  float16 p = a * b, q = c * d;
  return (p - q) + (fma(a, b, -p) - fma(c, d, -q));
}

// Takes `primitive` into the hits of the rays that meet it: at `t`, which is no farther than what they have. A ray that has
// met something else at the same distance must be traced on its own, since the first that it comes to is to count;
// `triangle`, which may have come before, from another cell, is that of the scene, HIT_NONE for a shape.
INLINE void packet_take(int16 did_hit, float16 t, float16 u, float16 v, uint primitive, uint triangle, PacketHits *hits) {
  int16 other = triangle == HIT_NONE ? (int16)-1 : hits->triangle != triangle;
  hits->again |= packet_bits(did_hit & (t == hits->t) & other);
  hits->t = did_hit ? t : hits->t;
  hits->u = did_hit ? u : hits->u;
  hits->v = did_hit ? v : hits->v;
  hits->primitive = did_hit ? (uint16)primitive : hits->primitive;
  hits->triangle = did_hit ? (uint16)triangle : hits->triangle;
}

// Stores the hits of the rays in `stays` for which none must be traced again; the arrays keep what they hold of others.
INLINE void packet_store(const PacketHits *hits, int16 stays, float *t, float *u, float *v, uint *primitive) {
  const int16 bits = (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
  stays &= ((int16)(int)hits->again & bits) == 0;
  vstore16(stays ? hits->t : vload16(0, t), 0, t);
  vstore16(stays ? hits->u : vload16(0, u), 0, u);
  vstore16(stays ? hits->v : vload16(0, v), 0, v);
  vstore16(stays ? hits->primitive : vload16(0, primitive), 0, primitive);
}

// The corners of a triangle, moved to the origin of each ray and sheared along it: see block_intersect().
typedef struct {
  float16 ax, ay, az, bx, by, bz, cx, cy, cz;
} PacketCorners;

// Where rays meet a triangle no farther than `t_max`, and the weights of vertices 1 and 2 there.
INLINE int16 packet_hits(const PacketCorners *p, float16 scale_z, float16 t_max, float16 *t, float16 *weight_1,
                          float16 *weight_2) {
  float16 u = packet_signed_difference(p->cx, p->by, p->cy, p->bx);
  float16 v = packet_signed_difference(p->ax, p->cy, p->ay, p->cx);
  float16 w = packet_signed_difference(p->bx, p->ay, p->by, p->ax);
  float16 determinant = u + v + w;
  float16 inverse = 1 / determinant;
  *t = (u * p->az + v * p->bz + w * p->cz) * (scale_z * inverse);
  *weight_1 = v * inverse;
  *weight_2 = w * inverse;
  int16 inside = ((u >= 0) & (v >= 0) & (w >= 0)) | ((u <= 0) & (v <= 0) & (w <= 0));
  return inside & (determinant != 0) & (*t > 0) & (*t <= t_max);
}

// Takes triangle `lane` of block `index` into the hits of rays whose largest components lie along one axis. True if a hit
// was changed.
INLINE bool packet_intersect(global const TriangleBlock *blocks, uint index, uint lane, const PacketTriangleRays *p,
                             PacketHits *hits) {
  global const TriangleBlock *block = blocks + index;
  global const float *a = block->position[0][0] + lane, *b = block->position[1][0] + lane,
                     *c = block->position[2][0] + lane;
  PacketCorners corners;
  corners.az = a[p->z] - p->origin_z, corners.bz = b[p->z] - p->origin_z, corners.cz = c[p->z] - p->origin_z;
  corners.ax = fma(-p->shear_x, corners.az, a[p->x] - p->origin_x);
  corners.ay = fma(-p->shear_y, corners.az, a[p->y] - p->origin_y);
  corners.bx = fma(-p->shear_x, corners.bz, b[p->x] - p->origin_x);
  corners.by = fma(-p->shear_y, corners.bz, b[p->y] - p->origin_y);
  corners.cx = fma(-p->shear_x, corners.cz, c[p->x] - p->origin_x);
  corners.cy = fma(-p->shear_y, corners.cz, c[p->y] - p->origin_y);

  float16 u = corners.cx * corners.by - corners.cy * corners.bx;
  float16 v = corners.ax * corners.cy - corners.ay * corners.cx;
  float16 w = corners.bx * corners.ay - corners.by * corners.ax;
  float16 low = min(min(u, v), w), high = max(max(u, v), w);
  if (packet_bits((low >= 0) | (high <= 0)) == 0) return false;
  float16 t, weight_1, weight_2;
  int16 did_hit = packet_hits(&corners, p->scale_z, hits->t, &t, &weight_1, &weight_2);
  if (packet_bits(did_hit) == 0) return false;
  packet_take(did_hit, t, weight_1, weight_2, index * 8u + lane, block->primitive[lane], hits);
  return true;
}
#endif
