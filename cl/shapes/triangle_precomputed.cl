// Ray-triangle intersection by precomputed transforms, eight triangles at once; a part of triangle.cl.
//
// The test of Baldwin and Weber ("Fast Ray-Triangle Intersections by Coordinate Transformation", JCGT 2016): every
// triangle carries the affine map that takes it to (0, 0), (1, 0), (0, 1) in the plane z = 0, where what is left to
// do is little. Each triangle rounds its own map, so two neighbours do not agree on the edge between them: some rays
// pass through, which is why this test is not the default. It is here to be compared with.
#include "shapes/ray.cl"
#include "shapes/triangle_lanes.cl"
#include "shared/types.h"

#ifdef TRIANGLES_PRECOMPUTED
// After each block of triangles comes the block of their transforms.
#define BLOCK_STRIDE 2u

typedef Ray TriangleRay;

INLINE TriangleRay triangle_ray(Ray ray) { return ray; }

// Distances t at which the ray meets the triangles of a block; INFINITY in the lanes that it misses (also for
// t <= 0 and t >= t_max), and the weights of vertices 1 and 2. False if it misses all; then nothing is written.
INLINE bool block_intersect(global const TriangleBlock *block, TriangleRay ray, real t_max, real8 *t, real8 *weight_1,
                            real8 *weight_2) {
  global const TriangleTransforms *map = (global const TriangleTransforms *)(block + 1);
  real8 m[3][3];
  for (uint row = 0; row < 3; ++row)
    for (uint column = 0; column < 3; ++column)
      m[row][column] = convert_real8(*(global const float8 *)map->row[row][column]);

  // The coordinates along the axis nearest to each triangle's normal (z) and along the two that follow it.
  real8 axis = convert_real8(*(global const float8 *)map->axis);
  mask8 is_x = axis == 0, is_y = axis == 1;
  real3 o = ray.origin, d = ray.direction;
  real8 ox = is_x ? (real8)o.y : (is_y ? (real8)o.z : (real8)o.x);
  real8 oy = is_x ? (real8)o.z : (is_y ? (real8)o.x : (real8)o.y);
  real8 oz = is_x ? (real8)o.x : (is_y ? (real8)o.y : (real8)o.z);
  real8 dx = is_x ? (real8)d.y : (is_y ? (real8)d.z : (real8)d.x);
  real8 dy = is_x ? (real8)d.z : (is_y ? (real8)d.x : (real8)d.y);
  real8 dz = is_x ? (real8)d.x : (is_y ? (real8)d.y : (real8)d.z);

  // Empty lanes and those of shapes have NaN in their maps, and every comparison with it is false.
  real8 height = fma(m[2][0], ox, fma(m[2][1], oy, oz + m[2][2]));
  real8 distance = -height / fma(m[2][0], dx, fma(m[2][1], dy, dz));
  mask8 did_hit = (distance > 0) & (distance < t_max);
  if (!any_lane(did_hit)) return false;
  real8 x = fma(distance, dx, ox), y = fma(distance, dy, oy);
  real8 u = fma(m[0][0], x, fma(m[0][1], y, m[0][2]));
  real8 v = fma(m[1][0], x, fma(m[1][1], y, m[1][2]));
  did_hit &= (u >= 0) & (v >= 0) & (u + v <= 1);
  if (!any_lane(did_hit)) return false;
  *t = did_hit ? distance : (real8)INFINITY;
  *weight_1 = u;
  *weight_2 = v;
  return true;
}
#endif
