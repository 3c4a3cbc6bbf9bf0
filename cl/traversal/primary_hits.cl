// Where camera paths begin: their rays and primary hits, found by packets of neighbouring rays where the program is built
// for that (CAMERA_PACKETS), which is for devices that gain by it. The paths are the same to the bit either way.
#include "core/diagnostics.cl"
#include "core/film_pixels.cl"
#include "traversal/geometry.cl"
#include "traversal/kdtree_packet.cl"

// The ray with which path number `sample` of pixel (x, y) begins: of the pass.
INLINE Ray path_ray(const Params *params, uint x, uint y, uint sample, bool low_discrepancy);

#ifdef CAMERA_PACKETS
#define PRIMARY_HITS_FOUND true

// Which paths a packet holds: `samples` paths of each pixel of a tile, or a part of the samples of one pixel.
typedef struct {
  uint width, height;  // of a tile
  uint parts;          // packets of a pixel
} PacketTile;

INLINE PacketTile packet_tile(uint samples) {
  PacketTile tile = {samples <= 2u ? 4u : samples <= 8u ? 2u : 1u, samples <= 1u ? 4u : samples <= 4u ? 2u : 1u,
                     (samples + PACKET_RAYS - 1u) / PACKET_RAYS};
  return tile;
}

// The ray of path number `sample` of a pixel, which meets nothing yet, in place i of the packet.
INLINE void first_ray_put(const Params *params, uint x, uint y, uint sample, bool low_discrepancy, RayPacket *rays, uint i) {
  packet_set(rays, i, path_ray(params, x, y, sample, low_discrepancy), hit_none(INFINITY));
}

// The rays of a packet's paths. With low-discrepancy samples the loop is vectorised; the strata of others ask for divisions of
// integers, for which there are no vector instructions.
INLINE void first_rays(const Params *settings, const uint *x, const uint *y, const uint *samples, RayPacket *rays) {
  const Params params = *settings;
  if (params.sobol != 0) {
#if VECTORISED(0u)
#pragma clang loop vectorize(assume_safety)
#endif
    for (uint i = 0; i < PACKET_RAYS; ++i) first_ray_put(&params, x[i], y[i], samples[i], true, rays, i);
  } else {
    for (uint i = 0; i < PACKET_RAYS; ++i) first_ray_put(&params, x[i], y[i], samples[i], false, rays, i);
  }
}

// One packet of the tiles that hold pixels of the chunk, row by row: the chunk may begin and end within a row.
OUTLINE void primary_hits_of(const Geometry *geometry, const Params *params, uint samples, uint index,
                           global PrimaryHit *primary_hits, volatile global Counters *counters) {
  PacketTile tile = packet_tile(samples);
  uint width = film_width(params), height = film_height(params), across = (width + tile.width - 1u) / tile.width;
  uint part = index % tile.parts, place = index / tile.parts;
  uint left = place % across * tile.width;
  uint top = (params->first_pixel / width / tile.height + place / across) * tile.height;
  uint of_pixel = min(samples, PACKET_RAYS);
  RayPacket rays;
  uint paths[PACKET_RAYS], xs[PACKET_RAYS], ys[PACKET_RAYS], numbers[PACKET_RAYS];
  uint used = 0;
  for (uint i = 0; i < PACKET_RAYS; ++i) {
    uint in_tile = i / of_pixel, sample = part * PACKET_RAYS + i % of_pixel;
    uint x = left + in_tile % tile.width, y = top + in_tile / tile.width;
    uint pixel = y * width + x - params->first_pixel;  // wraps around before the first
    bool has_path = in_tile < tile.width * tile.height && sample < samples && x < width && y < height &&
                    pixel < params->pixel_count;
    used |= has_path ? 1u << i : 0u;
    paths[i] = pixel * samples + sample;
    xs[i] = params->crop_x + x, ys[i] = params->crop_y + y, numbers[i] = sample;
  }
  first_rays(params, xs, ys, numbers, &rays);
  if (HAS(EFFECT_PLANES)) {
    RayArrays arrays = RAY_ARRAYS(&rays);
    planes_closest_all(geometry->shapes, geometry->plane_count, PACKET_RAYS, &arrays);
  }
  kdtree_closest_packet(geometry->nodes, geometry->blocks, geometry->shapes, geometry->curves, &rays, used);
  for (; used != 0; used &= used - 1u) {
    uint i = lowest_bit(used);
    Ray ray = packet_ray(&rays, i);
    Hit hit = packet_hit(&rays, i);
    count_diagnostics(hit.diagnostics, counters);
    PrimaryHit found = {{ray.origin.x, ray.origin.y, ray.origin.z},
                      {ray.direction.x, ray.direction.y, ray.direction.z},
                      hit.t, hit.u, hit.v, hit.primitive};
    primary_hits[paths[i]] = found;
  }
}

#else
#define PRIMARY_HITS_FOUND false
#endif

INLINE Ray first_ray(global const PrimaryHit *first) {
  Ray ray = {(real3)(first->origin[0], first->origin[1], first->origin[2]),
             (real3)(first->direction[0], first->direction[1], first->direction[2])};
  return ray;
}

// geometry_closest() along first_ray(), but that its diagnostics have been counted.
INLINE bool primary_hit(global const PrimaryHit *first, Hit *hit) {
  hit->t = first->t, hit->u = first->u, hit->v = first->v;
  hit->primitive = first->primitive;
  return hit->primitive != HIT_NONE;
}
