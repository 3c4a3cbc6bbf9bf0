// Sorting photons into the grid: count, running sums, move (a counting sort).
#include "grid.cl"

// Buckets that one work-item of the running sum takes.
#define SCAN_SEGMENT 256u

INLINE real3 photon_position(global const Photon *photon) { return vload3(0, photon->position); }

// counts[b] = photons in bucket b; must be zero before.
kernel void count_photons(global const Photon *photons, volatile global uint *counts, Grid grid) {
  uint i = get_global_id(0);
  if (i >= grid.photon_count) return;
  atomic_inc(counts + grid_bucket(grid, photon_position(photons + i)));
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

// starts[b] = photons in all buckets before b, for b = 0 ... size; cursors holds the same numbers.
kernel void scan_segments(global uint *cursors, global const uint *sums, global uint *starts, uint size) {
  uint segment = get_global_id(0), first = segment * SCAN_SEGMENT;
  if (first >= size) return;
  uint total = sums[segment];
  for (uint i = first; i < min(first + SCAN_SEGMENT, size); ++i) {
    uint next = total + cursors[i];
    starts[i] = cursors[i] = total;
    total = next;
  }
  if (first + SCAN_SEGMENT >= size) starts[size] = total;
}

// Moves photons to their bucket's range, as six arrays. The order within a bucket is that of execution, and
// nothing that follows depends on it: sums over photons are sums of integers.
kernel void move_photons(global const Photon *photons, volatile global uint *cursors, global uint *sorted, Grid grid) {
  uint i = get_global_id(0);
  if (i >= grid.photon_count) return;
  uint slot = atomic_inc(cursors + grid_bucket(grid, photon_position(photons + i)));
  uint stride = photon_stride(grid.photon_count);
  global real *position = (global real *)sorted + slot;
  global uint *words = (global uint *)photon_words(sorted, stride) + slot;
  for (uint axis = 0; axis < 3; ++axis) position[axis * stride] = photons[i].position[axis];
  words[0] = photons[i].normal;
  words[stride] = photons[i].flux_rg;
  words[2 * stride] = photons[i].flux_b;
}
