// Boxes that hold objects, in world space.
#pragma once

#include <array>
#include <limits>

#include "scene/scene.hpp"

namespace causticl {

/// A box along the axes; empty until something is added.
struct BoundingBox {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  bool empty() const { return low.x > high.x; }
  void add(Vec3 p);
  void add(const BoundingBox& other);
  /// The image of the local ellipsoid about `centre` with these half axes.
  void add_ellipsoid(const Transform& transform, Vec3 centre, Vec3 half_axes);
  /// Grown by `margin` on every side.
  BoundingBox grown(double margin) const;
};

/// The images of the corners of a box.
std::array<Vec3, 8> box_corners(const Transform& transform, Vec3 low, Vec3 high);

bool overlap(const BoundingBox& a, const BoundingBox& b);
bool holds(const BoundingBox& box, Vec3 point);
/// What both hold; empty where they do not overlap.
BoundingBox intersection(const BoundingBox& a, const BoundingBox& b);

/// The bounds of an object at time 0; empty for an infinite plane.
BoundingBox object_bounds(const Scene& scene, const Object& object);

/// The bounds of all that the object passes through while the shutter is open.
BoundingBox swept_bounds(const Scene& scene, const Object& object);

}  // namespace causticl
