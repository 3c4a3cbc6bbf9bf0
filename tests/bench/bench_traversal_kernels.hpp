// The kernels whose rays a second bench_traversal.cpp measures.
#pragma once

namespace causticl {

/// Rays are two float4: origin and t_max, direction. A result is a distance, or for "occluded" a flag.
constexpr const char* bench_traversal_kernels = R"(
#include "traversal/geometry.cl"
#include "traversal/kdtree_packet.cl"
#include "traversal/kdtree_stream.cl"
INLINE Ray load_ray(global const float4 *rays, uint i) {
  Ray ray = {convert_real3(rays[2 * i].xyz), convert_real3(rays[2 * i + 1].xyz)};
  return ray;
}
kernel void closest(GEOMETRY_PARAMETERS, global const float4 *rays, global float *distances, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  GEOMETRY_INIT(0)
  Hit hit = hit_none(rays[2 * i].w);
  geometry_closest(&geometry, load_ray(rays, i), &hit);
  distances[i] = hit.t;
}
// As "closest", by tiles of 4 x 4 pixels of a square picture. Every sixteenth item traces one.
OUTLINE void tile_closest(const Geometry *g, global const float4 *rays, global float *distances, uint side, uint tile) {
  uint across = (side + 3u) / 4u, left = tile % across * 4u, top = tile / across * 4u;
  RayPacket packet;
  uint used = 0;
  for (uint i = 0; i < PACKET_RAYS; ++i) {
    uint x = left + i % 4u, y = top + i / 4u;
    if (x < side && y < side) used |= 1u << i;
    uint at = min(y, side - 1u) * side + min(x, side - 1u);
    packet_set(&packet, i, load_ray(rays, at), hit_none(rays[2u * at].w));
  }
  kdtree_closest_packet(g->nodes, g->blocks, g->shapes, g->curves, &packet, used);
  for (; used != 0; used &= used - 1u) {
    uint i = lowest_bit(used);
    distances[(top + i / 4u) * side + left + i % 4u] = packet.t[i];
  }
}
kernel void closest_packets(GEOMETRY_PARAMETERS, global const float4 *rays, global float *distances, uint count) {
  uint side = (uint)(sqrt((float)count) + 0.5f), across = (side + 3u) / 4u, tile = get_global_id(0) / PACKET_RAYS;
  if (get_global_id(0) % PACKET_RAYS != 0 || tile >= across * across) return;
  GEOMETRY_INIT(0)
  tile_closest(&geometry, rays, distances, side, tile);
}
#ifdef KDTREE_STREAMS
OUTLINE void stream_closest(const Geometry *g, global const float4 *rays, global float *distances, uint first, uint count) {
  float origin[3][STREAM_CAPACITY], direction[3][STREAM_CAPACITY], t[STREAM_CAPACITY], u[STREAM_CAPACITY], v[STREAM_CAPACITY];
  uint primitive[STREAM_CAPACITY], diagnostics[STREAM_CAPACITY];
  for (uint i = 0; i < STREAM_CAPACITY; ++i) {
    uint at = first + min(i, count - 1u);
    Ray ray = load_ray(rays, at);
    origin[0][i] = ray.origin.x, origin[1][i] = ray.origin.y, origin[2][i] = ray.origin.z;
    direction[0][i] = ray.direction.x, direction[1][i] = ray.direction.y, direction[2][i] = ray.direction.z;
    t[i] = rays[2u * at].w, u[i] = v[i] = 0, primitive[i] = HIT_NONE;
  }
  RayArrays arrays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  kdtree_stream(g->nodes, g->blocks, g->shapes, g->curves, &arrays, count, diagnostics);
  for (uint i = 0; i < count; ++i) distances[first + i] = t[i];
}
// As "closest", by waves of consecutive rays, one for every STREAM_CAPACITY items.
kernel void closest_streams(GEOMETRY_PARAMETERS, global const float4 *rays, global float *distances, uint count) {
  uint first = (uint)get_global_id(0);
  if (first % STREAM_CAPACITY != 0 || first >= count) return;
  GEOMETRY_INIT(0)
  stream_closest(&geometry, rays, distances, first, min(STREAM_CAPACITY, count - first));
}
#endif
kernel void occluded(GEOMETRY_PARAMETERS, global const float4 *rays, global uint *result, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  GEOMETRY_INIT(0)
  uint diagnostics = 0;
  result[i] = geometry_occluded(&geometry, load_ray(rays, i), rays[2 * i].w, &diagnostics);
}
)";

}  // namespace causticl
