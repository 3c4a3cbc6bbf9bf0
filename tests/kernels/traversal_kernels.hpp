// The kernels with which tests and benchmarks trace rays, and a stand-in for the scene's shapes.
#pragma once

namespace causticl {

/// Spheres by a textbook test: what the tree does with shapes does not depend on how they are met.
constexpr const char* sphere_stand_in = R"(
#include "shapes/ray.cl"
#include "shared/types.h"
INLINE bool shape_closest(global const Shape *shape, uint index, global const float *curves, Ray ray, Hit *hit) {
  real3 o = ray.origin - shape->sphere.xyz;
  real b = dot(o, ray.direction);
  real3 l = o - b * ray.direction;
  real q = shape->sphere.w * shape->sphere.w - dot(l, l);
  if (q < 0) return false;
  real root = sqrt(q), t = -b - root;
  if (t <= 0) t = root - b;
  if (!(t > 0 && t < hit->t)) return false;
  hit->t = t;
  hit->primitive = HIT_SHAPE | index;
  return true;
}
INLINE bool shape_occluded(global const Shape *shape, global const float *curves, Ray ray, real t_max,
                           uint *diagnostics) {
  Hit hit = hit_none(t_max);
  return shape_closest(shape, 0, curves, ray, &hit);
}
)";

/// Rays are two float4: origin and t_max, direction. A result is (t, weights, primitive of the scene as
/// bits).
constexpr const char* traversal_kernels = R"(
#include "traversal/kdtree_packet.cl"
INLINE Ray load_ray(global const float4 *rays, uint i) {
  Ray ray = {rays[2 * i].xyz, rays[2 * i + 1].xyz};
  return ray;
}
INLINE void store_hit(global float4 *hits, uint i, global const TriangleBlock *blocks, Hit hit) {
  uint primitive = hit.primitive;
  if (!(primitive & HIT_SHAPE)) primitive = blocks[primitive / 8u].primitive[primitive % 8u];
  hits[i] = (float4)(hit.t, hit.u, hit.v, as_float(primitive));
}
kernel void closest(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                    global const float4 *rays, global float4 *hits, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Hit hit = hit_none(rays[2 * i].w);
  kdtree_closest(nodes, blocks, shapes, 0, load_ray(rays, i), &hit);
  store_hit(hits, i, blocks, hit);
}
kernel void occluded(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                     global const float4 *rays, global uint *result, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint diagnostics = 0;
  result[i] = kdtree_occluded(nodes, blocks, shapes, 0, load_ray(rays, i), rays[2 * i].w, &diagnostics);
}
// As "closest", by packets of consecutive rays: every sixteenth item traces one.
kernel void closest_packets(global const KdNode *nodes, global const TriangleBlock *blocks,
                            global const Shape *shapes, global const float4 *rays, global float4 *hits, uint count) {
  uint first = get_global_id(0);
  if (first % PACKET_RAYS != 0 || first >= count) return;
  uint size = min(PACKET_RAYS, count - first);
  RayPacket packet;
  for (uint i = 0; i < PACKET_RAYS; ++i)
    packet_set(&packet, i, load_ray(rays, min(first + i, count - 1u)), hit_none(rays[2 * min(first + i, count - 1u)].w));
  kdtree_closest_packet(nodes, blocks, shapes, 0, &packet, (1u << size) - 1u);
  for (uint i = 0; i < size; ++i) store_hit(hits, first + i, blocks, packet_hit(&packet, i));
}
// Every primitive in turn: `blocks` holds each once, the shapes in blocks of their own.
kernel void brute_force(global const TriangleBlock *blocks, uint block_count, global const Shape *shapes,
                        uint shape_count, global const float4 *rays, global float4 *hits, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Ray ray = load_ray(rays, i);
  TriangleRay triangle = triangle_ray(ray);
  Hit hit = hit_none(rays[2 * i].w);
  for (uint b = 0; b < block_count; ++b) block_closest(blocks, b, triangle, &hit);
  for (uint s = 0; s < shape_count; ++s) shape_closest(shapes + s, s, 0, ray, &hit);
  store_hit(hits, i, blocks, hit);
}
)";

}  // namespace causticl
