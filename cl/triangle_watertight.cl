// Watertight ray-triangle intersection, eight triangles at once; a part of triangle.cl.
//
// The test of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT 2013): vertices are moved to
// the ray's origin and sheared so that the ray runs along +z; the signs of the three edge functions then decide.
// An edge gives the two triangles beside it the same number with opposite sign, so a ray cannot pass between.
// The paper falls back to double precision where an edge function vanishes; here the rounding errors of its two
// products, which fma() yields exactly, are added back, which gives the exact sign in the same precision.

#define BLOCK_STRIDE 1u

// The ray in the order of axes that the shear wants: z is the axis along which the direction is largest.
typedef struct {
  size_t x, y, z;  // offsets of the axes' rows in a block's vertex, in floats
  real origin_x, origin_y, origin_z;
  real shear_x, shear_y, scale_z;
} TriangleRay;

INLINE TriangleRay triangle_ray(Ray ray) {
  real3 d = ray.direction, o = ray.origin, a = fabs(d);
  TriangleRay s;
  if (a.x >= a.y && a.x >= a.z) {
    s.x = 8, s.y = 16, s.z = 0;
    d = d.yzx, o = o.yzx;
  } else if (a.y >= a.z) {
    s.x = 16, s.y = 0, s.z = 8;
    d = d.zxy, o = o.zxy;
  } else {
    s.x = 0, s.y = 8, s.z = 16;
  }
  s.origin_x = o.x, s.origin_y = o.y, s.origin_z = o.z;
  s.shear_x = d.x / d.z, s.shear_y = d.y / d.z, s.scale_z = 1 / d.z;
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

// Distances t at which the ray meets the triangles of a block; INFINITY in the lanes that it misses (also for
// t <= 0 and t >= t_max), and the weights of vertices 1 and 2. False if it misses all; then nothing is written.
INLINE bool block_intersect(global const TriangleBlock *block, TriangleRay ray, real t_max, real8 *t, real8 *weight_1,
                            real8 *weight_2) {
  real8 az = block_row(block, 0, ray.z) - ray.origin_z;
  real8 bz = block_row(block, 1, ray.z) - ray.origin_z;
  real8 cz = block_row(block, 2, ray.z) - ray.origin_z;
  real8 ax = fma(-ray.shear_x, az, block_row(block, 0, ray.x) - ray.origin_x);
  real8 ay = fma(-ray.shear_y, az, block_row(block, 0, ray.y) - ray.origin_y);
  real8 bx = fma(-ray.shear_x, bz, block_row(block, 1, ray.x) - ray.origin_x);
  real8 by = fma(-ray.shear_y, bz, block_row(block, 1, ray.y) - ray.origin_y);
  real8 cx = fma(-ray.shear_x, cz, block_row(block, 2, ray.x) - ray.origin_x);
  real8 cy = fma(-ray.shear_y, cz, block_row(block, 2, ray.y) - ray.origin_y);

  // Rounding is monotone: the sign of a difference of rounded products is right or it is zero. Zero counts as
  // inside, so these lanes include every triangle that the ray meets.
  real8 u = cx * by - cy * bx;
  real8 v = ax * cy - ay * cx;
  real8 w = bx * ay - by * ax;
  // Where vertex 2 is NaN, u and v are, and both selections below keep the NaN of the first.
  real8 low = v < u ? v : u, high = v > u ? v : u;
  low = w < low ? w : low;
  high = w > high ? w : high;
  if (!any_lane((low >= 0) | (high <= 0))) return false;

  u = signed_difference(cx, by, cy, bx);
  v = signed_difference(ax, cy, ay, cx);
  w = signed_difference(bx, ay, by, ax);
  real8 determinant = u + v + w;
  real8 inverse = 1 / determinant;
  real8 distance = (u * az + v * bz + w * cz) * (ray.scale_z * inverse);
  mask8 inside = ((u >= 0) & (v >= 0) & (w >= 0)) | ((u <= 0) & (v <= 0) & (w <= 0));
  mask8 met = inside & (determinant != 0) & (distance > 0) & (distance < t_max);
  if (!any_lane(met)) return false;
  *t = met ? distance : (real8)INFINITY;
  *weight_1 = v * inverse;
  *weight_2 = w * inverse;
  return true;
}
