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

// Where the first item of a group does the work of all, and of several of its items more: the share of this group in `total`
// pieces, [*first, *end). False on other items, and where nothing is left for the group. Few groups have something to
// do, spread evenly over all, since threads take runs of neighbouring groups.
INLINE bool group_share(uint total, uint an_item, uint *first, uint *end) {
  if (get_local_id(0) != 0 || total == 0) return false;
  uint count = (uint)get_local_size(0) * an_item;
  ulong busy = (total + count - 1u) / count, group = get_group_id(0), groups = get_num_groups(0);
  uint before = (uint)(group * busy / groups);
  if ((group + 1) * busy / groups == before) return false;
  *first = before * count;
  *end = *first + min(count, total - *first);
  return *first < total;
}
