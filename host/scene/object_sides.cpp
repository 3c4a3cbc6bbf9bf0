#include "scene/object_sides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace causticl {
namespace {

using Shape = Object::Shape;

constexpr double rounding = 1e-6;  // of the size of coordinates: what touches lies on no side

}  // namespace

bool is_flat(const Object& object) {
  return object.shape == Shape::plane || object.shape == Shape::rectangle || object.shape == Shape::disk;
}

std::vector<Vec3> object_corners(const Scene& scene, const Object& object) {
  Vec3 low, high;
  switch (object.shape) {
    case Shape::plane:
      return {};
    case Shape::mesh: {
      const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
      const double infinity = std::numeric_limits<double>::infinity();
      low = {infinity, infinity, infinity};
      high = -low;
      for (const auto& position : mesh.positions)
        for (int axis = 0; axis < 3; ++axis) {
          const double x = position[static_cast<std::size_t>(axis)];
          low[axis] = std::min(low[axis], x);
          high[axis] = std::max(high[axis], x);
        }
      break;
    }
    case Shape::box:
      high = 0.5 * object.size;
      low = -high;
      break;
    case Shape::rectangle:
      high = {0.5, 0.5, 0};
      low = -high;
      break;
    case Shape::bezier:
      for (const auto& [radius, height] : object.points) {
        const double r = std::max(high.x, std::fabs(radius));
        low = {-r, std::min(low.y, height), -r};
        high = {r, std::max(high.y, height), r};
      }
      break;
    case Shape::sphere:
    case Shape::disk:
      high = {object.radius, object.radius, object.shape == Shape::disk ? 0 : object.radius};
      low = -high;
  }
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(
        object.transform.point({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}));
  return points;
}

int sides_with(const Object& wall, const Object& other, const std::vector<Vec3>& corners) {
  const Vec3 n = normalize(wall.transform.inverse().rows[2]);
  const Vec3 origin = wall.transform.translation;
  if (other.shape == Shape::plane) {
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
