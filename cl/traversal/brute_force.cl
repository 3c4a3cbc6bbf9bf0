// Nearest hits where there are few primitives: incoherent rays, sixteen to a packet, meet every one of them. That takes
// neither nodes nor branches on which rays differ, of which a walk through the tree mostly consists where the tree is
// small. On devices that run a work-item's float16 as vectors, as PoCL's do.
//
// The hits are those of kdtree_closest() to the bit. A ray that meets two primitives at the same distance is traced again
// on its own, since then the order in which it comes to them decides.
//
// For float, the watertight test, and a tree of triangles, spheres and disks, BRUTE_FORCE_PRIMITIVES at most. Arrays of
// rays hold whole packets.
#include "shapes/primitives/plane.cl"
#include "shapes/ray_components.cl"
#include "traversal/kdtree.cl"
#include "traversal/triangle_packet.cl"

#if !defined(CAUSTICL_DOUBLE) && !defined(TRIANGLES_PRECOMPUTED)
// A packet of rays. Their largest components may lie along different axes: the order of axes that TriangleRay has for
// each is a choice between coordinates.
typedef struct {
  float16 origin_x, origin_y, origin_z;
  float16 direction_x, direction_y, direction_z;
  int16 along_x, along_y;  // whether the largest component does; else that along z
  float16 shear_x, shear_y, scale_z;
} IncoherentRays;

INLINE float16 along_axis(const IncoherentRays *r, float16 x, float16 y, float16 z) {
  return r->along_x ? x : (r->along_y ? y : z);
}

INLINE IncoherentRays incoherent_rays(const RayArrays *rays, uint first) {
  IncoherentRays r;
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

INLINE void incoherent_corner(global const TriangleBlock *block, uint vertex, uint lane, const IncoherentRays *r,
                              float16 *x, float16 *y, float16 *z) {
  float16 from_x = block->position[vertex][0][lane] - r->origin_x;
  float16 from_y = block->position[vertex][1][lane] - r->origin_y;
  float16 from_z = block->position[vertex][2][lane] - r->origin_z;
  *z = along_axis(r, from_x, from_y, from_z);
  *x = fma(-r->shear_x, *z, along_axis(r, from_y, from_z, from_x));
  *y = fma(-r->shear_y, *z, along_axis(r, from_z, from_x, from_y));
}

INLINE void incoherent_triangle(global const TriangleBlock *blocks, uint index, uint lane, const IncoherentRays *r,
                                PacketHits *hits) {
  PacketCorners c;
  incoherent_corner(blocks + index, 0, lane, r, &c.ax, &c.ay, &c.az);
  incoherent_corner(blocks + index, 1, lane, r, &c.bx, &c.by, &c.bz);
  incoherent_corner(blocks + index, 2, lane, r, &c.cx, &c.cy, &c.cz);
  float16 t, weight_1, weight_2;
  int16 did_hit = packet_hits(&c, r->scale_z, hits->t, &t, &weight_1, &weight_2);
  packet_take(did_hit, t, weight_1, weight_2, index * 8u + lane, blocks[index].primitive[lane], hits);
}

// shape_closest() of a sphere, with the operations of sphere_intersect() in the same order.
INLINE void incoherent_sphere(global const Shape *shape, uint index, const IncoherentRays *r, PacketHits *hits) {
  float radius = shape->sphere.w;
  float16 dx = r->direction_x, dy = r->direction_y, dz = r->direction_z;
  float16 fx = r->origin_x - shape->sphere.x, fy = r->origin_y - shape->sphere.y, fz = r->origin_z - shape->sphere.z;
  float16 b = -(fx * dx + fy * dy + fz * dz);
  float16 ax = fma(b, dx, fx), ay = fma(b, dy, fy), az = fma(b, dz, fz);
  float16 rest = ax * dx + ay * dy + az * dz;
  b -= rest;
  ax = fma(-rest, dx, ax), ay = fma(-rest, dy, ay), az = fma(-rest, dz, az);
  float16 discriminant = radius * radius - (ax * ax + ay * ay + az * az);
  int16 did_hit = discriminant >= 0;
  if (packet_bits(did_hit) == 0) return;
  float16 root = copysign(sqrt(discriminant), b), q = b + root;
  float16 c = fx * fx + fy * fy + fz * fz - radius * radius;
  float16 other = c > 3 * radius * radius ? b - root : clamp(c / q, -fabs(q), fabs(q));
  float16 near = min(q, other), far = max(q, other);
  float16 t = near > 0 ? near : far;
  packet_take(did_hit & (t > 0) & (t <= hits->t), t, (float16)0, (float16)0, HIT_SHAPE | index, HIT_NONE, hits);
}

// shape_closest() of a disk, as disk_intersect() has it.
INLINE void incoherent_disk(global const Shape *shape, uint index, const IncoherentRays *r, PacketHits *hits) {
  float3 centre = plane_centre(shape);
  float4 x = shape->to_local[0], y = shape->to_local[1], z = shape->to_local[2];
  float16 dx = r->direction_x, dy = r->direction_y, dz = r->direction_z;
  float16 t = (z.x * (centre.x - r->origin_x) + z.y * (centre.y - r->origin_y) + z.z * (centre.z - r->origin_z)) /
              (z.x * dx + z.y * dy + z.z * dz);
  float16 fx = fma(t, dx, r->origin_x - centre.x), fy = fma(t, dy, r->origin_y - centre.y),
          fz = fma(t, dz, r->origin_z - centre.z);
  float16 px = x.x * fx + x.y * fy + x.z * fz, py = y.x * fx + y.y * fy + y.z * fz;
  packet_take((px * px + py * py <= 1) & (t > 0) & (t <= hits->t), t, (float16)0, (float16)0, HIT_SHAPE | index, HIT_NONE,
              hits);
}

// Effects of shapes that it meets. A shape that is in leaves and that this file does not know has SCALAR_HITS in its row.
#define BRUTE_FORCE_SHAPES (EFFECTS_IN_SHAPE_LEAVES & ~EFFECTS_NOT_BATCHED(SCALAR_HITS))
typedef char brute_force_knows_its_shapes[BRUTE_FORCE_SHAPES == (EFFECT_SPHERES | EFFECT_DISKS) ? 1 : -1];

// Takes what the tree holds into the hits, each primitive once: cells may share some. `first_shape` is the least index
// that one of its shapes may have. The nodes of a tree lie in one piece, a node before its children.
INLINE void intersect_all(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                     uint first_shape, const IncoherentRays *r, PacketHits *hits) {
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
          if (HAS(BRUTE_FORCE_SHAPES) && (primitive & BLOCK_SHAPE)) {
            uint shape = primitive & ~BLOCK_SHAPE;
            ulong bit = 1ul << (shape - first_shape);
            if (shapes_met & bit) continue;
            shapes_met |= bit;
            if (HAS(EFFECT_DISKS) && shapes[shape].type == SHAPE_DISK)
              incoherent_disk(shapes + shape, shape, r, hits);
            else
              incoherent_sphere(shapes + shape, shape, r, hits);
          } else if (HAS(EFFECT_TRIANGLES)) {
            ulong bit = 1ul << primitive;
            if (!(triangles_met & bit)) incoherent_triangle(blocks, block, lane, r, hits);
            triangles_met |= bit;
          }
        }
      }
    }
  }
}

// kdtree_closest() of the first `count` rays. Returns how many of these were traced again and cut short
// (DIAGNOSTIC_TRAVERSAL_BOUND).
INLINE uint brute_force_closest(global const KdNode *nodes, global const TriangleBlock *blocks,
                                global const Shape *shapes, global const float *curves, uint first_shape, uint count,
                                const RayArrays *rays) {
  uint cut_short = 0;
  const uint16 lanes = (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (uint first = 0; first < count; first += PACKET_RAYS) {
    IncoherentRays r = incoherent_rays(rays, first);
    int16 member = lanes + first < count;
    PacketHits hits = {member ? vload16(0, rays->t + first) : (float16)-INFINITY, vload16(0, rays->u + first),
                       vload16(0, rays->v + first), vload16(0, rays->primitive + first), (uint16)HIT_NONE, 0};
    intersect_all(nodes, blocks, shapes, first_shape, &r, &hits);
    packet_store(&hits, member, rays->t + first, rays->u + first, rays->v + first, rays->primitive + first);
    for (uint again = hits.again; again != 0; again &= again - 1u) {
      uint i = first + lowest_bit(again);
      Hit hit = arrays_hit(rays, i);
      kdtree_closest(nodes, blocks, shapes, curves, arrays_ray(rays, i), &hit);
      cut_short += (hit.diagnostics & DIAGNOSTIC_TRAVERSAL_BOUND) ? 1u : 0u;
      arrays_put_hit(rays, i, hit);
    }
  }
  return cut_short;
}
#endif
