// Fresnel's equations in double precision.
#pragma once

#include <algorithm>
#include <cmath>

#include "vector_inputs.hpp"

namespace causticl {

struct Boundary {
  double reflectance, cosine_t;
};

/// Exact equations, or what they give for a squared cosine of refraction that is `shift` (a fraction of its
/// terms) away and a cosine of incidence that is `offset` away: bounds of what rounding may change.
inline Boundary fresnel_oracle(double cosine, double eta, double shift = 0, double offset = 0) {
  cosine = std::clamp(cosine + offset, 0.0, 1.0);
  const double difference = (eta - 1) * (eta + 1), margin = std::fabs(difference) + cosine * cosine;
  const double square = difference + cosine * cosine + shift * margin;
  if (square <= 0) return {eta == 1 ? 0.0 : 1.0, 0};
  const double c = std::sqrt(square) / eta;
  const double parallel = (eta * cosine - c) / (eta * cosine + c);
  const double perpendicular = (cosine - eta * c) / (cosine + eta * c);
  return {0.5 * (parallel * parallel + perpendicular * perpendicular), c};
}

constexpr double rounding = 3e-7;  // of the squared cosine: four operations
/// From 1/3 to 3.
inline double random_ior(RandomInputs& random) { return std::exp(random.uniform(-std::log(3), std::log(3))); }

}  // namespace causticl
