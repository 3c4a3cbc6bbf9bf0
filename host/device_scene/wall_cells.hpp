// A grid of cells around surfaces.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "device_scene/wall_primitives.hpp"

namespace causticl {

class WallCells {
 public:
  /// Around all primitives that are bounded, so far that what lies beyond is near nothing bounded: farther
  /// than `reach`. Cells have edges of `least_edge` or, where they would be too many or too fine for floats,
  /// longer ones.
  WallCells(const std::vector<WallPrimitive>& primitives, double least_edge, double reach);

  std::size_t count() const {
    return static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
           static_cast<std::size_t>(cells_[2]);
  }
  Vec3 low() const { return low_; }
  double edge() const { return edge_; }
  const int (&along() const)[3] { return cells_; }
  /// What rounding of places in the scene, or of the reach, may be.
  double tolerance() const { return tolerance_; }
  /// The cell, and the tolerance around it.
  WallBox box_of(std::size_t index) const;

  /// Calls `found` with the index of each cell that is within `reach` of the box from `low` to `high`.
  template <typename Found>
  void visit(Vec3 low, Vec3 high, double reach, const Found& found) const {
    visit_places(low, high, reach, [&](std::size_t index, int, int, int) { found(index); });
  }

  /// The same of each cell that the primitive may be within `reach` of, of those of which `wanted` is true.
  template <typename Wanted, typename Found>
  void visit(const WallPrimitive& primitive, double reach, const Wanted& wanted, const Found& found) const {
    visit_places(primitive.low, primitive.high, reach, [&](std::size_t index, int i, int j, int k) {
      if (wanted(index) && may_reach(primitive, box_at(i, j, k), reach)) found(index);
    });
  }

 private:
  Vec3 low_;
  double edge_ = 1, tolerance_ = 0;
  int cells_[3] = {0, 0, 0};

  WallBox box_at(int i, int j, int k) const {
    return {low_ + edge_ * Vec3{i + 0.5, j + 0.5, k + 0.5}, Vec3{1, 1, 1} * (0.5 * edge_ + tolerance_)};
  }

  template <typename Found>
  void visit_places(Vec3 low, Vec3 high, double reach, const Found& found) const {
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell_at = [&](double x) {
        return static_cast<int>(std::clamp(std::floor((x - low_[axis]) / edge_), 0.0, cells_[axis] - 1.0));
      };
      first[axis] = cell_at(low[axis] - reach - tolerance_);
      last[axis] = cell_at(high[axis] + reach + tolerance_);
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j) {
        int index = (k * cells_[1] + j) * cells_[0] + first[0];
        for (int i = first[0]; i <= last[0]; ++i, ++index) found(static_cast<std::size_t>(index), i, j, k);
      }
  }
};

}  // namespace causticl
