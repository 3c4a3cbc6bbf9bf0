// Eight triangles at once against a ray, and the surface at a hit.
//
// Two tests are to choose from, by `render --triangle-test`: each defines what it keeps of a ray (TriangleRay,
// triangle_ray()), block_intersect(), and how many blocks a leaf holds for eight triangles (BLOCK_STRIDE).
#include "shared/effects.h"
#include "shapes/ray.cl"
#include "shapes/triangle_lanes.cl"
#include "shapes/triangle_precomputed.cl"
#include "shapes/triangle_watertight.cl"
#include "shared/types.h"

// Takes the nearest triangle of block `index` into `hit` if it is nearer than hit->t.
INLINE bool block_closest(global const TriangleBlock *blocks, uint index, TriangleRay ray, Hit *hit) {
  real8 t, weight_1, weight_2;
  if (!block_intersect(blocks + index, ray, hit->t, &t, &weight_1, &weight_2)) return false;
  real nearest = min_lane(t);
  uint lane = lowest_bit(lane_bits(mask_lanes(t == nearest)));
  real weights[16];
  vstore8(weight_1, 0, weights);
  vstore8(weight_2, 1, weights);
  hit->t = nearest;
  hit->primitive = index * 8u + lane;
  hit->u = weights[lane];
  hit->v = weights[8 + lane];
  return true;
}

// A unit vector from two 16-bit coordinates on the octahedron (Cigolle et al., JCGT 2014).
INLINE real3 normal_from_octahedral(uint bits) {
  real x = (real)(int)(bits & 0xffffu) * ((real)2 / 65535) - 1, y = (real)(int)(bits >> 16u) * ((real)2 / 65535) - 1;
  real z = 1 - fabs(x) - fabs(y);
  real fold = max(-z, (real)0);
  x += x < 0 ? fold : -fold;
  y += y < 0 ? fold : -fold;
  return unit3((real3)(x, y, z));
}

INLINE real3 block_vertex(global const TriangleBlock *block, uint vertex, uint lane) {
  return (real3)(block->position[vertex][0][lane], block->position[vertex][1][lane],
                 block->position[vertex][2][lane]);
}

// a d - b c, where what is left when these cancel counts, the roundings of the products and of the factors added back.
INLINE real cancelled(real a, real d, real b, real c, real a_low, real d_low, real b_low, real c_low) {
  real p = b * c;
  real n = fma(a, d, -p) - fma(b, c, -p);
  return n + ((a * d_low - b * c_low) + (a_low * d - b_low * c));
}

// a - b is the result plus what is added to `low`, exactly (Knuth's TwoSum).
INLINE real3 exact_difference(real3 a, real3 b, real3 *low) {
  real3 d = sub3(a, b), c = sub3(a, d);
  *low = add3(sub3(a, add3(d, c)), sub3(c, b));
  return d;
}

// What is left of a normal when long products cancel, its largest component 1; `size` is the triangle's.
INLINE real3 sliver_normal(real3 a, real3 b, real3 c, real size) {
  real3 e_low, f_low;
  real scale = unit_scale(size);
  real3 e = exact_difference(scaled3(scale, b), scaled3(scale, a), &e_low);
  real3 f = exact_difference(scaled3(scale, c), scaled3(scale, a), &f_low);
  real x = cancelled(e.y, f.z, e.z, f.y, e_low.y, f_low.z, e_low.z, f_low.y);
  real y = cancelled(e.z, f.x, e.x, f.z, e_low.z, f_low.x, e_low.x, f_low.z);
  real z = cancelled(e.x, f.y, e.y, f.x, e_low.x, f_low.y, e_low.y, f_low.x);
  real largest = max_component(abs3((real3)(x, y, z)));
  bool any = largest > 0;
  return (real3)(any ? x / largest : 0, any ? y / largest : 0, any ? z / largest : 1);
}

// The unit normal of a triangle by its winding; the edges are scaled first, since the squared area of a triangle
// of 1e-10 underflows. A sliver's normal is what is left when long products cancel, so there the roundings of edges
// and products are added back: without, one of 1 : 10^6 is off by some per cent and one of 1 : 10^8 arbitrary.
INLINE real3 triangle_normal(real3 a, real3 b, real3 c) {
  real3 e = sub3(b, a), f = sub3(c, a);
  real size = max(max_component(abs3(e)), max_component(abs3(f)));
  real scale = 1 / size;
  e = scaled3(scale, e), f = scaled3(scale, f);
  real3 n = cross3(e, f);
  real square = dot3(n, n);
  real x = n.x, y = n.y, z = n.z, length = sqrt(square);
  if (HAS(EFFECT_SLIVERS) && !(square > (real)SLIVER_SINE2 * dot3(e, e) * dot3(f, f))) {
    n = sliver_normal(a, b, c, size);
    x = n.x, y = n.y, z = n.z, length = sqrt(dot3(n, n));
  }
  return scaled3(1 / length, (real3)(x, y, z));
}

// Whether the triangle of a hit holds the point that lies by `offset`, which is along its plane, from there. False for one
// too thin to tell.
INLINE bool triangle_holds(global const TriangleBlock *blocks, Hit hit, real3 offset) {
  global const TriangleBlock *block = blocks + hit.primitive / 8u;
  uint lane = hit.primitive % 8u;
  real3 a = block_vertex(block, 0, lane);
  real3 e = block_vertex(block, 1, lane) - a, f = block_vertex(block, 2, lane) - a;
  real ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), oe = dot(offset, e), of = dot(offset, f);
  real determinant = ee * ff - ef * ef;
  if (!(determinant > (real)1e-5 * ee * ff)) return false;
  real inverse = 1 / determinant;
  real u = hit.u + (oe * ff - of * ef) * inverse, v = hit.v + (of * ee - oe * ef) * inverse;
  return u >= 0 && v >= 0 && u + v <= 1;
}

// The surface at a hit on a triangle. The position is interpolated, which is far more exact than o + t d; its
// error is bounded as in Pharr, Jakob, Humphreys, PBR section 6.8.5.
INLINE void triangle_surface(global const TriangleBlock *blocks, global const TriangleAttributes *attributes, Hit hit,
                             Surface *surface) {
  global const TriangleBlock *block = blocks + hit.primitive / 8u;
  uint lane = hit.primitive % 8u;
  global const TriangleAttributes *attribute = attributes + block->primitive[lane];
  real3 a = block_vertex(block, 0, lane), b = block_vertex(block, 1, lane), c = block_vertex(block, 2, lane);
  real3 geometric_normal = triangle_normal(a, b, c);
  real weight_0 = 1 - hit.u - hit.v;
  a = scaled3(weight_0, a), b = scaled3(hit.u, b), c = scaled3(hit.v, c);
  surface->position = add3(add3(a, b), c);
  surface->error = (real)GAMMA(7) * max_component(add3(add3(abs3(a), abs3(b)), abs3(c)));
  surface->material = attribute->material & ~TRIANGLE_SMOOTH;
  real x = geometric_normal.x, y = geometric_normal.y, z = geometric_normal.z;
  if (HAS(EFFECT_SMOOTH) && (attribute->material & TRIANGLE_SMOOTH)) {
    real3 n = add3(add3(scaled3(weight_0, normal_from_octahedral(attribute->normal[0])),
                        scaled3(hit.u, normal_from_octahedral(attribute->normal[1]))),
                   scaled3(hit.v, normal_from_octahedral(attribute->normal[2])));
    real squared = dot3(n, n);
    if (squared > (real)1e-12) {
      n = scaled3(dot3(n, geometric_normal) < 0 ? -rsqrt(squared) : rsqrt(squared), n);
      x = n.x, y = n.y, z = n.z;
    }
  }
  surface->geometric_normal = geometric_normal;
  surface->shading_normal = (real3)(x, y, z);
  global const float *uv = (global const float *)attribute->uv;
  surface->uv = (real2)(weight_0 * uv[0] + hit.u * uv[2] + hit.v * uv[4], weight_0 * uv[1] + hit.u * uv[3] + hit.v * uv[5]);
}
