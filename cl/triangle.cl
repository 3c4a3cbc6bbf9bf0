// Watertight ray-triangle intersection, eight triangles at once, and the surface at a hit.
//
// The test of Woop, Benthin and Wald ("Watertight Ray/Triangle Intersection", JCGT 2013): vertices are moved to
// the ray's origin and sheared so that the ray runs along +z; the signs of the three edge functions then decide.
// An edge gives the two triangles beside it the same number with opposite sign, so a ray cannot pass between.
// The paper falls back to double precision where an edge function vanishes; here the rounding errors of its two
// products, which fma() yields exactly, are added back, which gives the exact sign in the same precision.
#include "ray.cl"
#include "types.h"

// The ray in the order of axes that the shear wants: z is the axis along which the direction is largest.
typedef struct {
  size_t x, y, z;  // offsets of the axes' rows in a block's vertex, in floats
  real origin_x, origin_y, origin_z;
  real shear_x, shear_y, scale_z;
} ShearedRay;

INLINE ShearedRay sheared_ray(Ray ray) {
  real3 d = ray.direction, o = ray.origin, a = fabs(d);
  ShearedRay s;
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

// The lanes of a comparison's result, one bit each. Written out by lanes the compilers make a dozen shuffles of it
// where x86 has one instruction.
INLINE uint lane_bits(int8 m) {
#ifdef __AVX__
  return (uint)__builtin_ia32_movmskps256(as_float8(m));
#else
  int8 bits = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  int4 a = bits.lo | bits.hi;
  int2 b = a.lo | a.hi;
  return (uint)(b.x | b.y);
#endif
}

INLINE bool any_lane(mask8 m) { return lane_bits(mask_lanes(m)) != 0; }

INLINE uint lowest_bit(uint bits) { return 31u - clz(bits & -bits); }

INLINE real min_lane(real8 v) {
  real4 a = min(v.lo, v.hi);
  real2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}

INLINE int min_lane_int(int8 v) {
  int4 a = min(v.lo, v.hi);
  int2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
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
INLINE bool block_intersect(global const TriangleBlock *block, ShearedRay ray, real t_max, real8 *t, real8 *weight_1,
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

// Takes the nearest triangle of block `index` into `hit` if it is nearer than hit->t.
INLINE bool block_closest(global const TriangleBlock *blocks, uint index, ShearedRay ray, Hit *hit) {
  real8 t, weight_1, weight_2;
  if (!block_intersect(blocks + index, ray, hit->t, &t, &weight_1, &weight_2)) return false;
  const int8 lanes = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  real nearest = min_lane(t);
  int lane = min_lane_int(select((int8)8, lanes, mask_lanes(t == nearest)));
  real weights[16];
  vstore8(weight_1, 0, weights);
  vstore8(weight_2, 1, weights);
  hit->t = nearest;
  hit->primitive = index * 8u + (uint)lane;
  hit->u = weights[lane];
  hit->v = weights[8 + lane];
  return true;
}

// A unit vector from two 16-bit coordinates on the octahedron (Cigolle et al., JCGT 2014).
INLINE real3 normal_from_octahedral(uint bits) {
  real x = (real)(bits & 0xffffu) * ((real)2 / 65535) - 1, y = (real)(bits >> 16u) * ((real)2 / 65535) - 1;
  real z = 1 - fabs(x) - fabs(y);
  real fold = max(-z, (real)0);
  x += x < 0 ? fold : -fold;
  y += y < 0 ? fold : -fold;
  return normalize((real3)(x, y, z));
}

INLINE real3 block_vertex(global const TriangleBlock *block, uint vertex, uint lane) {
  return (real3)(block->position[vertex][0][lane], block->position[vertex][1][lane],
                 block->position[vertex][2][lane]);
}

// The unit normal of a triangle by its winding; the edges are scaled first, since the squared area of a triangle
// of 1e-10 underflows.
INLINE real3 triangle_normal(real3 a, real3 b, real3 c) {
  real3 e = b - a, f = c - a;
  real scale = 1 / max(max_component(fabs(e)), max_component(fabs(f)));
  return normalize(cross(e * scale, f * scale));
}

// The surface at a hit on a triangle. The position is interpolated, which is far more exact than o + t d; its
// error is bounded as in Pharr, Jakob, Humphreys, PBR section 6.8.5.
INLINE void triangle_surface(global const TriangleBlock *blocks, global const TriangleAttributes *attributes, Hit hit,
                             Surface *surface) {
  global const TriangleBlock *block = blocks + hit.primitive / 8u;
  uint lane = hit.primitive % 8u;
  global const TriangleAttributes *attribute = attributes + block->primitive[lane];
  real3 a = block_vertex(block, 0, lane), b = block_vertex(block, 1, lane), c = block_vertex(block, 2, lane);
  real weight_0 = 1 - hit.u - hit.v;
  surface->position = weight_0 * a + hit.u * b + hit.v * c;
  surface->error = (real)GAMMA(7) * max_component(fabs(weight_0 * a) + fabs(hit.u * b) + fabs(hit.v * c));
  surface->geometric_normal = triangle_normal(a, b, c);
  surface->shading_normal = surface->geometric_normal;
  surface->material = attribute->material & ~TRIANGLE_SMOOTH;
  if (attribute->material & TRIANGLE_SMOOTH) {
    real3 n = weight_0 * normal_from_octahedral(attribute->normal[0]) +
              hit.u * normal_from_octahedral(attribute->normal[1]) +
              hit.v * normal_from_octahedral(attribute->normal[2]);
    real squared = dot(n, n);
    if (squared > (real)1e-12) {
      n *= rsqrt(squared);
      surface->shading_normal = dot(n, surface->geometric_normal) < 0 ? -n : n;
    }
  }
  surface->uv = weight_0 * convert_real2(attribute->uv[0]) + hit.u * convert_real2(attribute->uv[1]) +
                hit.v * convert_real2(attribute->uv[2]);
}
