// The dielectrics that hold a point: what a path has entered and not yet left.
//
// Every dielectric object has a material of its own (host/scene/dielectrics.hpp), in the order in which one body gives way to
// another where they overlap: the greatest index fills the place (Schmidt & Budge, "Simple Nested Dielectrics in Ray
// Traced Images", JGT 2002, with a total order in place of integers alone). A path may be in a body twice, where shells of
// one mesh overlap, so that indices may repeat.

#include "shared/effects.h"
#include "core/diagnostics.cl"

// Bodies that hold one point, at most. What is entered beyond that is left out and counted (DIAGNOSTIC_MEDIA_FULL).
#define MEDIUM_STACK_CAPACITY 8u

#define MEDIUM_OUTSIDE 0xffffffffu  // what lies outside of all bodies

typedef struct {
  uint count;
  uint material[(EFFECTS & EFFECT_NESTED) ? MEDIUM_STACK_CAPACITY : 1u];  // ascending; the last one fills the place
} MediumStack;

INLINE MediumStack medium_stack_none(void) {
  MediumStack stack;
  stack.count = 0;
  return stack;
}

// The material that fills the place, or MEDIUM_OUTSIDE.
INLINE uint medium_stack_top(const MediumStack *stack) {
  return stack->count == 0 ? MEDIUM_OUTSIDE : stack->material[stack->count - 1u];
}

INLINE bool medium_stack_holds(const MediumStack *stack, uint material) {
  for (uint i = 0; i < stack->count; ++i)
    if (stack->material[i] == material) return true;
  return false;
}

// Enters a body. Adds to *diagnostics where there is no room.
INLINE void medium_stack_enter(MediumStack *stack, uint material, uint *diagnostics) {
  if (stack->count == MEDIUM_STACK_CAPACITY) {
    *diagnostics |= DIAGNOSTIC_MEDIA_FULL;
    return;
  }
  uint i = stack->count++;
  for (; i > 0 && stack->material[i - 1u] > material; --i) stack->material[i] = stack->material[i - 1u];
  stack->material[i] = material;
}

// Leaves a body, once. False where the stack does not hold it.
INLINE bool medium_stack_leave(MediumStack *stack, uint material) {
  uint i = 0;
  while (i < stack->count && stack->material[i] != material) ++i;
  if (i == stack->count) return false;
  --stack->count;
  for (; i < stack->count; ++i) stack->material[i] = stack->material[i + 1u];
  return true;
}
