// What the items of a work-group add up among themselves: an atomic for every item, even on memory of the group's own,
// costs as much as tracing a short ray.
#include "core/prelude.cl"
#include "shared/types.h"

// Adds to the rays of a pass, whose sum may take more than 32 bits. Whoever makes the lower bits wrap knows it by what
// they were before, and carries.
INLINE void count_rays(uint rays, volatile global Counters *counters) {
  uint before = atomic_add(&counters->rays, rays);
  if (before + rays < before) atomic_inc(&counters->rays_high);
}

// Adds the sum of `rays` over the items of the group, which is below 2^32. Every item of the group must call it;
// `values` has room for LARGEST_WORK_GROUP.
INLINE void group_count_rays(uint rays, local uint *values, volatile global Counters *counters) {
  values[get_local_id(0)] = rays;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) != 0) return;
  uint sum = 0;
  for (uint i = 0; i < get_local_size(0); ++i) sum += values[i];
  count_rays(sum, counters);
}

// More entries than any buffer holds need not be told apart, and a count that wrapped around would pass for few.
#define LIST_LIMIT 0x80000000u

// Room for `count` entries at the end of a list that *total counts: the index of the first.
INLINE uint list_reserve(uint count, volatile global uint *total) {
  uint first = atomic_add(total, count);
  if (first >= LIST_LIMIT) atomic_sub(total, count);
  return first;
}
