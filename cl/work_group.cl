// What the items of a work-group add up among themselves: an atomic for every item, even on memory of the group's own,
// costs as much as tracing a short ray.
#include "prelude.cl"
#include "types.h"

// Adds the sum of `value` over the items of the group to *total. Every item of the group must call it; `values` has
// room for LARGEST_WORK_GROUP.
INLINE void group_add(uint value, local uint *values, volatile global uint *total) {
  values[get_local_id(0)] = value;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) != 0) return;
  uint sum = 0;
  for (uint i = 0; i < get_local_size(0); ++i) sum += values[i];
  atomic_add(total, sum);
}

// More entries than any buffer holds need not be told apart, and a count that wrapped around would pass for few.
#define LIST_LIMIT 0x80000000u

// Room for `count` entries at the end of a list that *total counts: the index of the first.
INLINE uint list_reserve(uint count, volatile global uint *total) {
  uint first = atomic_add(total, count);
  if (first >= LIST_LIMIT) atomic_sub(total, count);
  return first;
}
