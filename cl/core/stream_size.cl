// How many paths go in a batch.
#include "core/prelude.cl"

// Paths of a batch at most: those of a usual work-group where the device wants loops, as PoCL does; else a work-item's
// own. What a batch holds should fit into the first cache, where arrays with room for more would also be in each other's
// way.
#if defined(POCL_DEVICE_ADDRESS_BITS)
#define STREAM_CAPACITY 64u
#else
#define STREAM_CAPACITY 1u
#endif

// Whole vectors spare the loops their scalar remainders.
#define STREAM_STEP (STREAM_CAPACITY < 8u ? STREAM_CAPACITY : 8u)
INLINE uint stream_padded(uint count) { return (count + STREAM_STEP - 1u) / STREAM_STEP * STREAM_STEP; }
