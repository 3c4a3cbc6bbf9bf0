// Where to cut a cell of the KD-tree.
#pragma once

#include <span>
#include <vector>

#include "kdtree_bounds.hpp"

namespace causticl::kd {

/// Costs of the surface area heuristic, in units of one test of a wide node.
constexpr float block_cost = 1.2f;      // eight triangles
constexpr float binary_cost = 1.f / 3;  // a binary split: three levels make one wide node
constexpr std::uint64_t block_lanes = 8;

inline float blocks_of(std::uint64_t count) {
  return static_cast<float>((count + block_lanes - 1) / block_lanes);
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
