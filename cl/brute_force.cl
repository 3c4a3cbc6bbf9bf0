// Nearest hits where there are few primitives: sixteen rays at a time, which may go any way, meet every one of them.
// That takes neither nodes nor branches on which rays differ, of which a walk through the tree mostly consists where the
// tree is small. On devices that run a work-item's float16 as vectors, as PoCL's do.
//
// The hits are those of kdtree_closest() to the bit. A ray that meets two primitives at the same distance is traced again
// on its own, since then the order in which it comes to them decides; so is one that comes near a disk.
//
// For float, the watertight test, and a tree of triangles, spheres and disks, BRUTE_FORCE_PRIMITIVES at most.
#include "kdtree_packet.cl"

// Rays, and up to where they are traced or what they have met so far, as Ray and Hit have them. All arrays hold whole
// packets.
typedef struct {
  const float *origin[3], *direction[3];
  float *t, *u, *v;
  uint *primitive;
} RayArrays;

// Sixteen of them. Their largest components may lie along different axes: the order of axes that TriangleRay has for
// each is a choice between coordinates.
typedef struct {
  float16 origin_x, origin_y, origin_z;
  float16 direction_x, direction_y, direction_z;
  int16 along_x, along_y;  // whether the largest component does; else that along z
  float16 shear_x, shear_y, scale_z;
} RaySixteen;

INLINE float16 along_axis(const RaySixteen *r, float16 x, float16 y, float16 z) {
  return r->along_x ? x : (r->along_y ? y : z);
}

INLINE RaySixteen ray_sixteen(const RayArrays *rays, uint first) {
  RaySixteen r;
  r.origin_x = vload16(0, rays->origin[0] + first), r.direction_x = vload16(0, rays->direction[0] + first);
  r.origin_y = vload16(0, rays->origin[1] + first), r.direction_y = vload16(0, rays->direction[1] + first);
  r.origin_z = vload16(0, rays->origin[2] + first), r.direction_z = vload16(0, rays->direction[2] + first);
  float16 x = r.direction_x, y = r.direction_y, z = r.direction_z;
  r.along_x = (fabs(x) >= fabs(y)) & (fabs(x) >= fabs(z));
  r.along_y = fabs(y) >= fabs(z);
  float16 largest = along_axis(&r, x, y, z);
  r.shear_x = along_axis(&r, y, z, x) / largest;
  r.shear_y = along_axis(&r, z, x, y) / largest;
  r.scale_z = 1 / largest;
  return r;
}

INLINE void corner_of_sixteen(global const TriangleBlock *block, uint vertex, uint lane, const RaySixteen *r, float16 *x,
                              float16 *y, float16 *z) {
  float16 from_x = block->position[vertex][0][lane] - r->origin_x;
  float16 from_y = block->position[vertex][1][lane] - r->origin_y;
  float16 from_z = block->position[vertex][2][lane] - r->origin_z;
  *z = along_axis(r, from_x, from_y, from_z);
  *x = fma(-r->shear_x, *z, along_axis(r, from_y, from_z, from_x));
  *y = fma(-r->shear_y, *z, along_axis(r, from_z, from_x, from_y));
}

INLINE void triangle_of_sixteen(global const TriangleBlock *blocks, uint index, uint lane, const RaySixteen *r,
                                PacketHits *hits) {
  PacketCorners c;
  corner_of_sixteen(blocks + index, 0, lane, r, &c.ax, &c.ay, &c.az);
  corner_of_sixteen(blocks + index, 1, lane, r, &c.bx, &c.by, &c.bz);
  corner_of_sixteen(blocks + index, 2, lane, r, &c.cx, &c.cy, &c.cz);
  packet_take_triangle(blocks, index, lane, &c, r->scale_z, hits);
}

// shape_closest() of a sphere, with the operations of sphere_intersect() in the same order.
INLINE void sphere_of_sixteen(global const Shape *shape, uint index, const RaySixteen *r, PacketHits *hits) {
  float radius = shape->sphere.w;
  float16 dx = r->direction_x, dy = r->direction_y, dz = r->direction_z;
  float16 fx = r->origin_x - shape->sphere.x, fy = r->origin_y - shape->sphere.y, fz = r->origin_z - shape->sphere.z;
  float16 b = -(fx * dx + fy * dy + fz * dz);
  float16 ax = fma(b, dx, fx), ay = fma(b, dy, fy), az = fma(b, dz, fz);
  float16 rest = ax * dx + ay * dy + az * dz;
  b -= rest;
  ax = fma(-rest, dx, ax), ay = fma(-rest, dy, ay), az = fma(-rest, dz, az);
  float16 discriminant = radius * radius - (ax * ax + ay * ay + az * az);
  int16 met = discriminant >= 0;
  if (packet_bits(met) == 0) return;
  float16 root = copysign(sqrt(discriminant), b), q = b + root;
  float16 c = fx * fx + fy * fy + fz * fz - radius * radius;
  float16 other = c > 3 * radius * radius ? b - root : clamp(c / q, -fabs(q), fabs(q));
  float16 near = min(q, other), far = max(q, other);
  float16 t = near > 0 ? near : far;
  met &= (t > 0) & (t <= hits->t);
  hits->again |= packet_bits(met & (t == hits->t));
  hits->t = met ? t : hits->t;
  hits->u = met ? (float16)0 : hits->u;
  hits->v = met ? (float16)0 : hits->v;
  hits->primitive = met ? (uint16)(HIT_SHAPE | index) : hits->primitive;
  hits->triangle = met ? (uint16)HIT_NONE : hits->triangle;
}

// Lets the rays that meet the bounds of a shape before their hits be traced again, and here no further.
INLINE void other_shape_of_sixteen(global const KdNode *root, global const TriangleBlock *block, uint lane,
                                   const RaySixteen *r, PacketHits *hits) {
  PacketSlabs s = packet_slabs(root, r->origin_x, r->origin_y, r->origin_z, r->direction_x, r->direction_y, r->direction_z);
  float16 low_x = block->position[0][0][lane], high_x = block->position[1][0][lane];
  float16 low_y = block->position[0][1][lane], high_y = block->position[1][1][lane];
  float16 low_z = block->position[0][2][lane], high_z = block->position[1][2][lane];
  int16 down_x = s.inverse_x < 0, down_y = s.inverse_y < 0, down_z = s.inverse_z < 0;
  float16 near_x = fma(down_x ? high_x : low_x, s.inverse_x, s.enter_x);
  float16 near_y = fma(down_y ? high_y : low_y, s.inverse_y, s.enter_y);
  float16 near_z = fma(down_z ? high_z : low_z, s.inverse_z, s.enter_z);
  float16 far_x = fma(down_x ? low_x : high_x, s.inverse_x, s.leave_x);
  float16 far_y = fma(down_y ? low_y : high_y, s.inverse_y, s.leave_y);
  float16 far_z = fma(down_z ? low_z : high_z, s.inverse_z, s.leave_z);
  float16 enter = max(max(near_x, near_y), max(near_z, (float16)0));
  int16 near = enter <= min(min(far_x, far_y), min(far_z, hits->t));
  hits->again |= packet_bits(near);
  hits->t = near ? (float16)-INFINITY : hits->t;
}

// Takes what the tree holds into the hits, each primitive once: cells may share some. `first_shape` is the least index
// that one of its shapes may have. The nodes of a tree lie in one piece, a node before its children.
INLINE void meet_all(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                     uint first_shape, const RaySixteen *r, PacketHits *hits) {
  ulong triangles_met = 0, shapes_met = 0;
  uint last = 0;
  for (uint index = 0; index <= last; ++index) {
    for (uint slot = 0; slot < 8u && nodes[index].child[slot] != 0; ++slot) {
      uint child = nodes[index].child[slot];
      if (!(child & KD_LEAF)) {
        last = max(last, child);
        continue;
      }
      uint block = child & KD_INDEX, end = block + nodes[index].block_count[slot] * BLOCK_STRIDE;
      for (; block < end; block += BLOCK_STRIDE) {
        for (uint lane = 0; lane < 8u && blocks[block].primitive[lane] != BLOCK_EMPTY; ++lane) {
          uint primitive = blocks[block].primitive[lane];
          if (HAS(EFFECT_SPHERES | EFFECT_DISKS) && (primitive & BLOCK_SHAPE)) {
            uint shape = primitive & ~BLOCK_SHAPE;
            ulong bit = 1ul << (shape - first_shape);
            if (shapes_met & bit) continue;
            shapes_met |= bit;
            if (!HAS(EFFECT_DISKS) || shapes[shape].type == SHAPE_SPHERE)
              sphere_of_sixteen(shapes + shape, shape, r, hits);
            else
              other_shape_of_sixteen(nodes, blocks + block, lane, r, hits);
          } else if (HAS(EFFECT_TRIANGLES)) {
            ulong bit = 1ul << primitive;
            if (!(triangles_met & bit)) triangle_of_sixteen(blocks, block, lane, r, hits);
            triangles_met |= bit;
          }
        }
      }
    }
  }
}

// kdtree_closest() of the first `count` rays. Returns FAULT_* bits of all.
INLINE uint brute_force_closest(global const KdNode *nodes, global const TriangleBlock *blocks,
                                global const Shape *shapes, global const float *curves, uint first_shape, uint count,
                                const RayArrays *rays) {
  const uint16 lanes = (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const int16 bits = (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
  uint faults = 0;
  for (uint first = 0; first < count; first += PACKET_RAYS) {
    RaySixteen r = ray_sixteen(rays, first);
    float16 t = vload16(0, rays->t + first), u = vload16(0, rays->u + first), v = vload16(0, rays->v + first);
    uint16 primitive = vload16(0, rays->primitive + first);
    int16 member = lanes + first < count;
    PacketHits hits = {member ? t : (float16)-INFINITY, u, v, primitive, (uint16)HIT_NONE, 0};
    meet_all(nodes, blocks, shapes, first_shape, &r, &hits);
    int16 stays = member & (((int16)(int)hits.again & bits) == 0);
    vstore16(stays ? hits.t : t, 0, rays->t + first);
    vstore16(stays ? hits.u : u, 0, rays->u + first);
    vstore16(stays ? hits.v : v, 0, rays->v + first);
    vstore16(stays ? hits.primitive : primitive, 0, rays->primitive + first);
    for (uint again = hits.again; again != 0; again &= again - 1u) {
      uint i = first + lowest_bit(again);
      Ray ray = {(float3)(rays->origin[0][i], rays->origin[1][i], rays->origin[2][i]),
                 (float3)(rays->direction[0][i], rays->direction[1][i], rays->direction[2][i])};
      Hit hit = {rays->t[i], rays->primitive[i], rays->u[i], rays->v[i], 0};
      kdtree_closest(nodes, blocks, shapes, curves, ray, &hit);
      faults |= hit.faults;
      rays->t[i] = hit.t, rays->u[i] = hit.u, rays->v[i] = hit.v, rays->primitive[i] = hit.primitive;
    }
  }
  return faults;
}
