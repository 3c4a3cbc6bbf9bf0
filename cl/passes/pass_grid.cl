// Sorting photons into the grid: count, running sums, move (a counting sort).
#include "photons/grid.cl"

// Buckets that one work-item of the running sum takes.
#define SCAN_SEGMENT 256u

INLINE real3 photon_position(global const Photon *photon) { return vload3(0, photon->position); }

// counts[b] = photons in bucket b of both grids; must be zero before. ranks[i] = those counted there before photon i:
// in an order that execution gives, and nothing that follows depends on it, since sums over photons are sums of integers.
kernel void count_photons(global const Photon *photons, volatile global uint *counts, global uint *ranks,
                          PhotonGrids grids) {
  uint i = get_global_id(0);
  if (i >= grids.photon_count) return;
  ranks[i] = atomic_inc(counts + photon_bucket(grids, photon_position(photons + i), photons[i].normal));
}

// sums[s] = total of segment s of `counts`, which has `size` entries.
kernel void sum_segments(global const uint *counts, global uint *sums, uint size) {
  uint segment = get_global_id(0), first = segment * SCAN_SEGMENT;
  if (first >= size) return;
  uint total = 0;
  for (uint i = first; i < min(first + SCAN_SEGMENT, size); ++i) total += counts[i];
  sums[segment] = total;
}

// Replaces the segments' totals by the totals of all segments before each. One work-item.
kernel void scan_sums(global uint *sums, uint segments) {
  if (get_global_id(0) != 0) return;
  uint total = 0;
  for (uint i = 0; i < segments; ++i) {
    uint next = total + sums[i];
    sums[i] = total;
    total = next;
  }
}

// starts[b] = photons in all buckets before b, for b = 0 ... size.
kernel void scan_segments(global const uint *counts, global const uint *sums, global uint *starts, uint size) {
  uint segment = get_global_id(0), first = segment * SCAN_SEGMENT;
  if (first >= size) return;
  uint total = sums[segment];
  for (uint i = first; i < min(first + SCAN_SEGMENT, size); ++i) {
    starts[i] = total;
    total += counts[i];
  }
  if (first + SCAN_SEGMENT >= size) starts[size] = total;
}

// Moves photons to their bucket's range. The lanes of the last block that are left hold nothing.
kernel void move_photons(global const Photon *photons, global const uint *ranks, global const uint *starts,
                         global PhotonBlock *sorted, PhotonGrids grids) {
  uint i = get_global_id(0);
  Photon photon = {{0, 0, 0}, 0, 0, 0};
  uint slot = i;
  if (i < grids.photon_count) {
    photon = photons[i];
    slot = starts[photon_bucket(grids, photon_position(photons + i), photon.normal)] + ranks[i];
  } else if (i >= (grids.photon_count + 7) / 8 * 8) {
    return;
  }
  global PhotonBlock *block = sorted + slot / 8;
  uint lane = slot % 8;
  for (uint axis = 0; axis < 3; ++axis) block->position[axis][lane] = photon.position[axis];
  block->normal[lane] = photon.normal;
  block->flux_rg[lane] = photon.flux_rg;
  block->flux_b[lane] = photon.flux_b;
}
