// Which surfaces of a scene may part others.
#pragma once

#include <cstdint>
#include <vector>

#include "device_scene/wall_cells.hpp"
#include "device_scene/wall_parting.hpp"
#include "device_scene/wall_primitives.hpp"

namespace causticl {

/// Asks parts_others() for the primitives of a scene. Of the tiny ones of a part of a mesh in a cube
/// of a quarter of the radius that lie alike one stands for all, so that dense meshes take little longer than
/// coarse ones.
class PartingWalls {
 public:
  /// Of the radius: primitives of one part of a mesh that are no larger do not part each other.
  static constexpr double dense_ratio = 0.5;

  using Primitives = std::vector<const WallPrimitive*>;

  /// Keeps references. For balls of at most that radius.
  PartingWalls(const std::vector<WallPrimitive>& primitives, const WallCells& cells, double radius);

  /// Whether it is told once whether the primitive parts others. Of large ones it is told for each cell.
  bool is_small(std::uint32_t i) const;

  /// Whether the small primitive parts others; true as well where that would take long to tell.
  bool parts(std::uint32_t i);

  /// Whether what lies of the primitive in the box parts others, which are those of others_in(box).
  bool parts(std::uint32_t i, const Primitives& others, const WallBox& box);

  /// What may lie in the box. Tiny primitives have one that stands for them. Nothing where no time is left.
  Primitives others_in(const WallBox& box);

 private:
  enum class Answer : char { unknown, no, yes };
  const std::vector<WallPrimitive>& primitives_;
  const WallCells& cells_;
  const double radius_;
  std::vector<std::uint32_t> representative_;          // of each primitive: itself, or one like it
  std::vector<Answer> answers_;                        // of small primitives
  std::vector<std::vector<std::uint32_t>> occupants_;  // of each cell: those that stand for themselves
  std::vector<std::uint32_t> planes_;
  const NormalBins bins_;
  std::size_t looks_left_;

  WallReach reach() const;
  void choose_representatives();
};

}  // namespace causticl
