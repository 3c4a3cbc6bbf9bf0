// The surfaces of a scene as walls, and on which sides of each other they lie.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/lit_sides.hpp"
#include "scene/scene.hpp"
#include "world/flat_scene.hpp"

namespace causticl {

/// A box by its centre and half edges.
struct WallBox {
  Vec3 centre, half;
};

struct WallPrimitive {
  Wall wall;
  std::vector<Vec3> corners;  // of a triangle or parallelogram
  Vec3 low, high;             // bounds; of a plane infinite
  bool blocks;                // light does not pass it
  bool receives;              // photons may be stored on it
  int lit_side;               // as of LitSides
  std::int32_t part = -1;     // as of LitSides
};

/// The normal of a flat primitive, of unit length.
inline Vec3 normal_of(const WallPrimitive& primitive) {
  return {primitive.wall.normal.x, primitive.wall.normal.y, primitive.wall.normal.z};
}

/// The longest edge of the bounds; infinite of a plane.
inline double size_of(const WallPrimitive& primitive) {
  return max_component(primitive.high - primitive.low);
}

/// All surfaces but the infinitesimal ones. Revolved curves become triangles, two triangles one after the
/// other that are the halves of a parallelogram become that; glass parts nothing.
std::vector<WallPrimitive> wall_primitives(const Scene& scene, const FlatScene& world, const LitSides& sides,
                                           double time);

/// Whether the primitive may come within `reach` of the box: true too where it is a little farther.
bool may_reach(const WallPrimitive& primitive, const WallBox& box, double reach);

/// The part of a triangle or parallelogram within the box, as a convex polygon; no corners of other
/// primitives.
std::vector<Vec3> clipped(std::vector<Vec3> polygon, const WallBox& box);

/// On which sides of a wall what lies of another primitive within a box is, by more than `tolerance`.
/// `polygon` is that part of a triangle or parallelogram.
struct WallSides {
  bool front = false, back = false;
};
WallSides sides_of(const WallPrimitive& wall, const WallPrimitive& other, const std::vector<Vec3>& polygon,
                   double tolerance);

}  // namespace causticl
