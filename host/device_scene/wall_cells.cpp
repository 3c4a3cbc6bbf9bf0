#include "device_scene/wall_cells.hpp"

namespace causticl {
namespace {

/// Cells along the longest axis at most: smaller ones would take more memory than they spare walls.
constexpr double most_cells = 128;

}  // namespace

WallCells::WallCells(const std::vector<WallPrimitive>& primitives, double least_edge, double reach) {
  Vec3 high{-INFINITY, -INFINITY, -INFINITY};
  low_ = -high;
  for (const auto& primitive : primitives)
    for (int axis = 0; axis < 3; ++axis)
      if (std::isfinite(primitive.low.x)) {
        low_[axis] = std::min(low_[axis], primitive.low[axis]);
        high[axis] = std::max(high[axis], primitive.high[axis]);
      }
  if (!(low_.x <= high.x)) low_ = high = {0, 0, 0};
  const double largest = std::max(max_component({std::fabs(low_.x), std::fabs(low_.y), std::fabs(low_.z)}),
                                  max_component({std::fabs(high.x), std::fabs(high.y), std::fabs(high.z)}));
  tolerance_ = 1e-3 * reach + 4e-6 * largest;
  const Vec3 margin = Vec3{1, 1, 1} * (1.01 * reach + 1e-5 * largest);
  low_ = low_ - margin;
  high = high + margin;
  // As the kernel's floats have it.
  for (int axis = 0; axis < 3; ++axis) low_[axis] = static_cast<float>(low_[axis]);
  // Cells that are finer than what rounding leaves of places would tell nothing apart.
  const double edge = std::max({least_edge, 4 * tolerance_, max_component(high - low_) / most_cells});
  edge_ = 1 / static_cast<double>(static_cast<float>(1 / edge));
  for (int axis = 0; axis < 3; ++axis)
    cells_[axis] = static_cast<int>(std::ceil((high[axis] - low_[axis]) / edge_)) + 1;
}

WallBox WallCells::box_of(std::size_t index) const {
  const auto at = static_cast<int>(index);
  return box_at(at % cells_[0], at / cells_[0] % cells_[1], at / cells_[0] / cells_[1]);
}

}  // namespace causticl
