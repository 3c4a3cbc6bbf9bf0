// Watertight ray-triangle intersection, eight triangles at once; a part of triangle.cl.
//
// The test of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT 2013): vertices are moved to
// the ray's origin and sheared so that the ray runs along +z; the signs of the three edge functions then decide.
// An edge gives the two triangles beside it the same number with opposite sign, so a ray cannot pass between.
// The paper falls back to double precision where an edge function vanishes; here the rounding errors of its two
// products, which fma() yields exactly, are added back, which gives the exact sign in the same precision.
#include "shapes/ray.cl"
#include "shapes/triangle_lanes.cl"
#include "shared/types.h"

#ifndef TRIANGLES_PRECOMPUTED
#define BLOCK_STRIDE 1u

// The ray in the order of axes that the shear wants: z is the axis along which the direction is largest.
typedef struct {
  size_t x, y, z;  // offsets of the axes' rows in a block's vertex, in floats
  real origin_x, origin_y, origin_z;
  real shear_x, shear_y, scale_z;
} TriangleRay;

INLINE TriangleRay triangle_ray(Ray ray) {
  real3 d = ray.direction, o = ray.origin;
  bool along_x = fabs(d.x) >= fabs(d.y) && fabs(d.x) >= fabs(d.z), along_y = fabs(d.y) >= fabs(d.z);
  real x = along_x ? d.y : (along_y ? d.z : d.x), y = along_x ? d.z : (along_y ? d.x : d.y);
  real z = along_x ? d.x : (along_y ? d.y : d.z);
  TriangleRay s;
  s.x = along_x ? 8 : (along_y ? 16 : 0);
  s.y = along_x ? 16 : (along_y ? 0 : 8);
  s.z = along_x ? 0 : (along_y ? 8 : 16);
  s.origin_x = along_x ? o.y : (along_y ? o.z : o.x);
  s.origin_y = along_x ? o.z : (along_y ? o.x : o.y);
  s.origin_z = along_x ? o.x : (along_y ? o.y : o.z);
  s.shear_x = x / z, s.shear_y = y / z, s.scale_z = 1 / z;
  return s;
}

INLINE real8 block_row(global const TriangleBlock *block, uint vertex, size_t row) {
  return convert_real8(*(global const float8 *)(block->position[vertex][0] + row));
}

// a b - c d with the sign of the exact value.
INLINE real8 signed_difference(real8 a, real8 b, real8 c, real8 d) {
  real8 p = a * b, q = c * d;
  return (p - q) + (fma(a, b, -p) - fma(c, d, -q));
}

// The corners of a block's triangles, moved to the ray's origin and sheared.
typedef struct {
  real8 ax, ay, az, bx, by, bz, cx, cy, cz;
} BlockCorners;

// Finds the corners. False if the ray misses all triangles of the block.
INLINE bool block_corners(global const TriangleBlock *block, TriangleRay ray, BlockCorners *c) {
  c->az = block_row(block, 0, ray.z) - ray.origin_z;
  c->bz = block_row(block, 1, ray.z) - ray.origin_z;
  c->cz = block_row(block, 2, ray.z) - ray.origin_z;
  c->ax = fma(-ray.shear_x, c->az, block_row(block, 0, ray.x) - ray.origin_x);
  c->ay = fma(-ray.shear_y, c->az, block_row(block, 0, ray.y) - ray.origin_y);
  c->bx = fma(-ray.shear_x, c->bz, block_row(block, 1, ray.x) - ray.origin_x);
  c->by = fma(-ray.shear_y, c->bz, block_row(block, 1, ray.y) - ray.origin_y);
  c->cx = fma(-ray.shear_x, c->cz, block_row(block, 2, ray.x) - ray.origin_x);
  c->cy = fma(-ray.shear_y, c->cz, block_row(block, 2, ray.y) - ray.origin_y);

  // Rounding is monotone: the sign of a difference of rounded products is right or it is zero. Zero counts as
  // inside, so these lanes include every triangle that the ray meets.
  real8 u = c->cx * c->by - c->cy * c->bx;
  real8 v = c->ax * c->cy - c->ay * c->cx;
  real8 w = c->bx * c->ay - c->by * c->ax;
  // Where vertex 2 is NaN, u and v are, and both selections below keep the NaN of the first.
  real8 low = v < u ? v : u, high = v > u ? v : u;
  low = w < low ? w : low;
  high = w > high ? w : high;
  return any_lane((low >= 0) | (high <= 0));
}

// The triangles of a block that the ray meets for 0 < t < t_max, by their corners, and for these the distances and the
// weights of vertices 1 and 2.
INLINE mask8 block_hits(const BlockCorners *c, real scale_z, real t_max, real8 *t, real8 *weight_1, real8 *weight_2) {
  real8 u = signed_difference(c->cx, c->by, c->cy, c->bx);
  real8 v = signed_difference(c->ax, c->cy, c->ay, c->cx);
  real8 w = signed_difference(c->bx, c->ay, c->by, c->ax);
  real8 determinant = u + v + w;
  real8 inverse = 1 / determinant;
  *t = (u * c->az + v * c->bz + w * c->cz) * (scale_z * inverse);
  *weight_1 = v * inverse;
  *weight_2 = w * inverse;
  mask8 inside = ((u >= 0) & (v >= 0) & (w >= 0)) | ((u <= 0) & (v <= 0) & (w <= 0));
  return inside & (determinant != 0) & (*t > 0) & (*t < t_max);
}

// Distances t at which the ray meets the triangles of a block; INFINITY in the lanes that it misses (also for
// t <= 0 and t >= t_max), and the weights of vertices 1 and 2. False if it misses all.
INLINE bool block_intersect(global const TriangleBlock *block, TriangleRay ray, real t_max, real8 *t, real8 *weight_1,
                            real8 *weight_2) {
  BlockCorners corners;
  real8 distance;
  if (!block_corners(block, ray, &corners)) return false;
  mask8 did_hit = block_hits(&corners, ray.scale_z, t_max, &distance, weight_1, weight_2);
  if (!any_lane(did_hit)) return false;
  *t = did_hit ? distance : (real8)INFINITY;
  return true;
}
#endif
