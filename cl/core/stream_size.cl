// How many paths go side by side.
#include "core/prelude.cl"

// Paths of a wave at most: those of a usual work-group where the device wants loops, as PoCL does; else a work-item's
// own. What a wave holds should fit into the first cache, where arrays with room for more would also be in each other's
// way.
#if defined(POCL_DEVICE_ADDRESS_BITS)
#define WAVE_CAPACITY 64u
#else
#define WAVE_CAPACITY 1u
#endif

// Whole vectors spare the loops their scalar remainders.
#define WAVE_STEP (WAVE_CAPACITY < 8u ? WAVE_CAPACITY : 8u)
INLINE uint wave_padded(uint count) { return (count + WAVE_STEP - 1u) / WAVE_STEP * WAVE_STEP; }
