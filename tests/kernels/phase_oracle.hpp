// The phase function in double precision.
#pragma once

#include <cmath>

namespace causticl {

inline double phase_oracle(double g, double cosine) {
  return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

}  // namespace causticl
