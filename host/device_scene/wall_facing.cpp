#include "device_scene/wall_facing.hpp"

#include <algorithm>
#include <cmath>

namespace causticl {
namespace {

/// From a point to the convex polygon of that normal.
double distance_to(const std::vector<Vec3>& polygon, Vec3 normal, Vec3 point) {
  bool above = true;  // the polygon, whichever way it is wound
  double nearest = INFINITY, sense = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()], along = b - a;
    const double side = dot(cross(normal, along), point - a);
    if (sense == 0) sense = side;
    above = above && side * sense > 0;
    const double t = std::clamp(dot(point - a, along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
    nearest = std::min(nearest, length(point - a - t * along));
  }
  return above ? std::fabs(dot(normal, point - polygon[0])) : nearest;
}

/// The least distance that bounds of the two allow.
double gap_between(const WallPrimitive& a, const WallPrimitive& b) {
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
  return length(gap);
}

/// Corners, middles of edges and the middle.
std::vector<Vec3> samples(const std::vector<Vec3>& polygon) {
  std::vector<Vec3> points = polygon;
  Vec3 sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    points.push_back(0.5 * (polygon[i] + polygon[(i + 1) % polygon.size()]));
    sum = sum + polygon[i];
  }
  points.push_back(sum / static_cast<double>(polygon.size()));
  return points;
}

}  // namespace

WallSides faced_by(const WallPrimitive& other, const WallPrimitive& wall,
                   const std::vector<Vec3>& wall_polygon, const WallReach& reach) {
  const WallSides sides = sides_of(other, wall, wall_polygon, reach.tolerance);
  if (other.corners.empty() || wall.corners.empty() || (!sides.front && !sides.back)) return sides;
  const Vec3 n = normal_of(other), middle = 0.5 * (other.low + other.high);
  const bool tiny = size_of(other) <= reach.tiny;
  if (tiny) {
    if (gap_between(other, wall) <= std::sqrt(3.0) * reach.tiny &&
        std::fabs(dot(n, normal_of(wall))) < wall_bent_cosine)
      return sides;
  }
  // Of what is much larger than the other all samples may be beside the place where it rises.
  const bool samples_tell = size_of(wall) <= 1.5 * size_of(other);
  const double gap = gap_between(other, wall);
  WallSides faced;
  for (const Vec3 point : samples(wall_polygon)) {
    const double height = dot(n, point - other.corners[0]);
    const double distance = !samples_tell ? gap
                            : tiny        ? length(point - middle)
                                          : distance_to(other.corners, n, point);
    if (std::fabs(height) <= wall_steepness * distance) continue;
    faced.front = faced.front || height > reach.tolerance;
    faced.back = faced.back || height < -reach.tolerance;
  }
  return faced;
}

}  // namespace causticl
