// Eight triangles at once against a ray, and the surface at a hit.
//
// Two tests are to choose from, by `render --triangle-test`: each defines what it keeps of a ray (TriangleRay,
// triangle_ray()), block_intersect(), and how many blocks a leaf holds for eight triangles (BLOCK_STRIDE).
#include "ray.cl"
#include "types.h"

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

#ifdef TRIANGLES_PRECOMPUTED
#include "triangle_precomputed.cl"
#else
#include "triangle_watertight.cl"
#endif

// Takes the nearest triangle of block `index` into `hit` if it is nearer than hit->t.
INLINE bool block_closest(global const TriangleBlock *blocks, uint index, TriangleRay ray, Hit *hit) {
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

// a - b is the result plus what is added to `low`, exactly (Knuth's TwoSum).
INLINE real3 exact_difference(real3 a, real3 b, real3 *low) {
  real3 d = a - b, c = a - d;
  *low = (a - (d + c)) + (c - b);
  return d;
}

// The unit normal of a triangle by its winding; the edges are scaled first, since the squared area of a triangle
// of 1e-10 underflows. A needle's normal is what is left when long products cancel, so there the roundings of edges
// and products are added back: without, one of 1 : 10^6 is off by some per cent and one of 1 : 10^8 arbitrary.
INLINE real3 triangle_normal(real3 a, real3 b, real3 c) {
  real3 e = b - a, f = c - a;
  real size = max(max_component(fabs(e)), max_component(fabs(f)));
  real scale = 1 / size;
  e *= scale, f *= scale;
  real3 n = cross(e, f);
  if (dot(n, n) > (real)0.01 * dot(e, e) * dot(f, f)) return normalize(n);

  real3 e_low, f_low;
  scale = ldexp((real)1, -max(ilogb(size), -100));  // exact
  e = exact_difference(b * scale, a * scale, &e_low);
  f = exact_difference(c * scale, a * scale, &f_low);
  real3 p = e.zxy * f.yzx;
  n = fma(e.yzx, f.zxy, -p) - fma(e.zxy, f.yzx, -p);
  n += (e.yzx * f_low.zxy - e.zxy * f_low.yzx) + (e_low.yzx * f.zxy - e_low.zxy * f.yzx);
  real largest = max_component(fabs(n));
  return largest > 0 ? normalize(n / largest) : (real3)(0, 0, 1);
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
