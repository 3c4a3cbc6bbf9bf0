#include "scene/object_sides.hpp"

#include <algorithm>
#include <cmath>

#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

constexpr double rounding = 1e-6;  // of the size of coordinates: what touches lies on no side

}  // namespace

std::vector<Vec3> object_corners(const Scene& scene, const Object& object) {
  if (is_infinite(object)) return {};
  const auto [low, high] = kind_of(object).local_box(scene, object);
  const auto corners = box_corners(object.transform, low, high);
  return {corners.begin(), corners.end()};
}

int sides_with(const Object& wall, const Object& other, const std::vector<Vec3>& corners) {
  const Vec3 n = normalize(wall.transform.inverse().rows[2]);
  const Vec3 origin = wall.transform.translation;
  if (is_infinite(other)) {
    const Vec3 m = normalize(other.transform.inverse().rows[2]);
    if (length(cross(m, n)) > 1e-6) return front_side | back_side;
  }
  auto points = corners;
  if (points.empty()) points = {other.transform.translation};
  double low = 0, high = 0, size = 0;
  for (const Vec3 p : points) {
    low = std::min(low, dot(n, p - origin));
    high = std::max(high, dot(n, p - origin));
    size = std::max({size, length(p), length(origin)});
  }
  return (high > rounding * size ? front_side : 0) | (low < -rounding * size ? back_side : 0);
}

int side_with(const Object& wall, Vec3 point) {
  const Vec3 n = normalize(wall.transform.inverse().rows[2]), origin = wall.transform.translation;
  const double at = dot(n, point - origin), size = std::max(length(point), length(origin));
  return at > rounding * size ? front_side : at < -rounding * size ? back_side : 0;
}

}  // namespace causticl
