// Bounding boxes and references of the KD-tree's builder.
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "accel/kdtree.hpp"

namespace causticl::kd {

/// Four floats that the compiler keeps in one register; the fourth lane carries no meaning.
using Float4 = float __attribute__((vector_size(16)));

inline Float4 minimum(Float4 a, Float4 b) {
#ifdef __SSE__
  return _mm_min_ps(a, b);
#else
  return a < b ? a : b;
#endif
}
inline Float4 maximum(Float4 a, Float4 b) {
#ifdef __SSE__
  return _mm_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}

struct Box {
  Float4 low = Float4{} + std::numeric_limits<float>::max();
  Float4 high = Float4{} - std::numeric_limits<float>::max();

  void extend(const Box& other) {
    low = minimum(low, other.low);
    high = maximum(high, other.high);
  }
  bool empty() const { return !(low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2]); }
  /// Half the surface area, and a little of the extent, so that boxes that are lines do not all cost nothing.
  float area() const {
    const Float4 d = high - low;
    const float sum = d[0] + d[1] + d[2];
    return d[0] * d[1] + d[1] * d[2] + d[2] * d[0] + 1e-6f * sum * sum;
  }
};

/// The part of a primitive that lies in a cell, by its bounds. The index travels in the fourth lane of `low`.
struct Reference {
  Box box;

  static Reference make(Box box, uint primitive) {
    float bits;
    std::memcpy(&bits, &primitive, sizeof bits);
    box.low[3] = bits;
    box.high[3] = 0;
    return {box};
  }
  uint primitive() const {
    const float bits = box.low[3];
    uint index;
    std::memcpy(&index, &bits, sizeof index);
    return index;
  }
};

/// The part of `reference` on each side of the plane x[axis] = position, which cuts it: triangles are
/// clipped. A side may come out empty where the triangle only just reaches over the plane.
void split_reference(const TreeInput& input, const Reference& reference, int axis, float position, Box& left,
                     Box& right);

}  // namespace causticl::kd
