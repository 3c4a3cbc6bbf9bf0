#include "scene/object_bounds.hpp"

#include <algorithm>

#include "scene/shape_kind.hpp"

namespace causticl {

void BoundingBox::add(Vec3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], p[axis]);
    high[axis] = std::max(high[axis], p[axis]);
  }
}

void BoundingBox::add(const BoundingBox& other) {
  if (other.empty()) return;
  add(other.low);
  add(other.high);
}

void BoundingBox::add_ellipsoid(const Transform& transform, Vec3 centre, Vec3 half_axes) {
  Vec3 extent;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row = transform.rows[static_cast<std::size_t>(axis)];
    extent[axis] = length({row.x * half_axes.x, row.y * half_axes.y, row.z * half_axes.z});
  }
  add(transform.point(centre) - extent);
  add(transform.point(centre) + extent);
}

BoundingBox BoundingBox::grown(double margin) const {
  if (empty()) return *this;
  const Vec3 by{margin, margin, margin};
  return {low - by, high + by};
}

std::array<Vec3, 8> box_corners(const Transform& transform, Vec3 low, Vec3 high) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = transform.point({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  return corners;
}

bool overlap(const BoundingBox& a, const BoundingBox& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis])) return false;
  return true;
}

bool holds(const BoundingBox& box, Vec3 point) { return overlap(box, {point, point}); }

BoundingBox intersection(const BoundingBox& a, const BoundingBox& b) {
  if (!overlap(a, b)) return {};
  BoundingBox result;
  for (int axis = 0; axis < 3; ++axis) {
    result.low[axis] = std::max(a.low[axis], b.low[axis]);
    result.high[axis] = std::min(a.high[axis], b.high[axis]);
  }
  return result;
}

BoundingBox object_bounds(const Scene& scene, const Object& object) {
  return kind_of(object).bounds(scene, object);
}

BoundingBox swept_bounds(const Scene& scene, const Object& object) {
  const BoundingBox still = object_bounds(scene, object);
  BoundingBox swept;
  if (still.empty()) return swept;
  for (const double time : scene.camera.shutter) {
    swept.add(still.low + time * object.motion);
    swept.add(still.high + time * object.motion);
  }
  return swept;
}

}  // namespace causticl
