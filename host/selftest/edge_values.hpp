// Numbers where a comparison may go either way: zeros of both signs, and neighbours of a number.
#pragma once

#include "selftest/input_random.hpp"
#include "selftest/selftest_check.hpp"

namespace causticl {

inline float signed_zero(InputRandom& random) { return random.below(2) ? 0.0f : -0.0f; }

/// One number above or below `value`, or, next to 0, a tiny part of `size`: products of denormals vanish.
inline float neighbour(InputRandom& random, float value, double size) {
  const int step = random.below(2) ? 1 : -1;
  return value == 0 ? static_cast<float>(step * 1e-20 * size) : next_float(value, step);
}

}  // namespace causticl
