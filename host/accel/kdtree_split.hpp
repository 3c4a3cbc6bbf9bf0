// Where to cut a cell of the KD-tree.
#pragma once

#include <span>
#include <vector>

#include "accel/kdtree_bounds.hpp"

namespace causticl::kd {

/// Costs of the surface area heuristic, in units of one test of a wide node. A block costs as much to test as
/// a node; the lower figure counts in that cutting further repeats triangles: measured on 100,000 triangles,
/// 0.45 gives 107 bytes a triangle and 5.7 tests a ray, 1.2 gives 144 bytes and 5.4 tests, and the rays are
/// no faster.
constexpr float block_cost = 0.45f;     // eight triangles
constexpr float binary_cost = 1.f / 3;  // a binary split: three levels make one wide node
constexpr std::uint64_t block_lanes = 8;
constexpr std::size_t leaf_limit = 24;  // primitives; above, a node is cut even where no gain shows at once

inline float blocks_of(std::uint64_t count) {
  const std::uint64_t blocks = (count + block_lanes - 1) / block_lanes;
  return static_cast<float>(blocks);
}

/// A plane x[axis] = position and what cutting there costs: area times expected tests, without the node's
/// own.
struct Split {
  int axis = -1;  // none
  float position = 0;
  bool planar_left = true;  // the side of references that lie in the plane
  float cost = std::numeric_limits<float>::max();

  bool in_left(const Box& box) const {
    return box.low[axis] < position ||
           (box.high[axis] == position && box.low[axis] == position && planar_left);
  }
  bool in_right(const Box& box) const {
    return box.high[axis] > position ||
           (box.high[axis] == position && box.low[axis] == position && !planar_left);
  }
};

/// The cheapest cut of `references`, all of which lie in `bounds`.
Split find_split(std::span<const Reference> references, const Box& bounds);

}  // namespace causticl::kd
