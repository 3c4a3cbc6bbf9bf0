// What should not happen in a kernel is counted there, and the host reports it: see Counters in pass_records.h.
#include "shared/effects.h"
#include "core/prelude.cl"
#include "shared/types.h"

// What befell a ray on its way, as bits of Hit.diagnostics.
#define DIAGNOSTIC_UNRESOLVED 1u       // a hit on a revolved curve stands for arcs that could not be told apart
#define DIAGNOSTIC_TRAVERSAL_BOUND 2u  // the walk through the tree was cut short
#define DIAGNOSTIC_MEDIA_FULL 4u       // more dielectrics hold one place than a path can keep
#define DIAGNOSTIC_MEDIA_LEFT 8u       // a path left a dielectric that it had not entered

// Counts the faults of one ray. Apart from the test this costs nothing where there are none.
INLINE void count_diagnostics(uint diagnostics, volatile global Counters *counters) {
  if (diagnostics == 0) return;
  if (diagnostics & DIAGNOSTIC_UNRESOLVED) atomic_inc(&counters->unresolved);
  if (diagnostics & DIAGNOSTIC_TRAVERSAL_BOUND) atomic_inc(&counters->traversal_bound);
  if (!HAS(EFFECT_NESTED)) return;
  if (diagnostics & DIAGNOSTIC_MEDIA_FULL) atomic_inc(&counters->media_full);
  if (diagnostics & DIAGNOSTIC_MEDIA_LEFT) atomic_inc(&counters->media_left);
}

// Puts black in place of a colour that is not finite, and counts it: such a texel ends paths and harms no pixel.
INLINE void make_finite(real3 *color, volatile global Counters *counters) {
  if (isfinite(color->x + color->y + color->z)) return;
  atomic_inc(&counters->non_finite);
  *color = (real3)(0, 0, 0);
}
