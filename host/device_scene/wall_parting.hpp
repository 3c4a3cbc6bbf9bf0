// Whether one of several surfaces parts two others.
#pragma once

#include <array>
#include <bitset>
#include <vector>

#include "device_scene/wall_primitives.hpp"

namespace causticl {

/// Directions in bins, a cube of 8 x 8 a face. Which bins hold two normals that gathering a photon allows.
class NormalBins {
 public:
  static constexpr int count = 6 * 8 * 8;
  using Set = std::bitset<count>;

  NormalBins();
  static int number(Vec3 normal);
  static Set of(Vec3 normal) { return Set{}.set(static_cast<std::size_t>(number(normal))); }
  bool may_agree(const Set& a, const Set& b) const;

 private:
  std::array<Set, count> agreeing_;
};

/// A lit side faces a wall that rises over its plane with this slope, as seen from some place of it. The path
/// that rises over both ends passes over what is lower. Where one primitive stands for others it also faces
/// what is near and bent away from its plane by 12 degrees, or more.
constexpr double wall_steepness = 0.2, wall_bent_cosine = 0.978;

/// How far what may be told of a wall reaches.
struct WallReach {
  double path;       // of a path between two points
  double tiny;       // a primitive that stands for others is no larger, and they are in a cube of this edge
  double dense;      // primitives of one part of a mesh that are no larger do not part each other
  double tolerance;  // what sticks out of a plane by no more does not count
};

/// Whether the wall blocks light and may stand between a visible point and a photon on two of the others, or
/// on itself and one of them:
/// - they lie on the two sides of it, within reach of what of it lies in the box;
/// - they have lit sides whose normals are near enough for gathering;
/// - one of these sides faces the wall;
/// - the three are not of the same dense part of a mesh, whose bumps and folds are finer than the radius.
bool parts_others(const NormalBins& bins, const WallPrimitive& wall,
                  const std::vector<const WallPrimitive*>& others, const WallBox& box,
                  const WallReach& reach);

}  // namespace causticl
