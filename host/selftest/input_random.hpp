// Random inputs that are a function of a seed and the number of the input alone.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/vec.hpp"

namespace causticl {

/// A stream of numbers for one input (SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", 2014).
class InputRandom {
 public:
  InputRandom(std::uint64_t seed, std::uint64_t input)
      : state_(mix(seed * 0x9e3779b97f4a7c15u) ^ mix(input)) {}

  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  /// An integer in [0, count).
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>((bits() >> 32) * count >> 32);
  }
  /// 10^x, x uniform: all sizes alike.
  double scale(double low_exponent, double high_exponent) {
    return std::exp2(uniform(low_exponent, high_exponent) * 3.321928094887362);
  }
  /// A direction uniform on the sphere.
  Vec3 direction() {
    const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  /// A uniform number of 24 bits in [0, 1), as kernels draw theirs.
  float uniform24() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }

 private:
  std::uint64_t state_;
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
};

/// `value` moved by `steps` representable numbers, across zero if need be.
inline float next_float(float value, int steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, INFINITY);
  for (; steps < 0; ++steps) value = std::nextafter(value, -INFINITY);
  return value;
}

}  // namespace causticl
