#include "mesh/mesh_polygon.hpp"

#include "base/vec.hpp"

namespace causticl {
namespace {

struct Point2 {
  double x, y;
  bool operator==(const Point2&) const = default;
};

/// Twice the signed area of the triangle: positive where it turns left.
double signed_area(Point2 a, Point2 b, Point2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners along the two axes that the polygon's normal is farthest from, seen so that the polygon runs
/// counter-clockwise.
std::vector<Point2> project(const std::vector<std::array<double, 3>>& corners) {
  Vec3 normal;  // Newell: twice the vector area, robust for concave and nearly flat polygons
  for (std::size_t i = 0; i < corners.size(); ++i) {
    // Relative to the first corner, so that a small polygon far from the origin keeps its digits.
    const auto relative = [&](std::size_t k) {
      const auto &p = corners[k % corners.size()], &o = corners[0];
      return Vec3{p[0] - o[0], p[1] - o[1], p[2] - o[2]};
    };
    normal = normal + cross(relative(i), relative(i + 1));
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Point2> result;
  result.reserve(corners.size());
  for (const auto& p : corners) result.push_back({p[u] - corners[0][u], p[v] - corners[0][v]});
  return result;
}

/// A ring of the corners that are not cut off yet.
class Ring {
 public:
  explicit Ring(std::vector<Point2> points)
      : points_(std::move(points)), next_(points_.size()), previous_(points_.size()) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      previous_[i] = (i + count - 1) % count;
    }
    for (std::uint32_t i = 0; i < count; ++i)
      if (corner_area(i) <= 0) reflex_.push_back(i);
  }

  std::uint32_t next(std::uint32_t i) const { return next_[i]; }
  std::uint32_t previous(std::uint32_t i) const { return previous_[i]; }

  /// Whether the triangle at corner i turns left and holds no other corner. Only reflex corners can lie in
  /// it. Counts the corners looked at into `work`.
  bool is_ear(std::uint32_t i, std::uint64_t& work) const {
    if (corner_area(i) <= 0) return false;
    const Point2 a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
    for (const std::uint32_t k : reflex_) {
      ++work;
      const Point2 p = points_[k];
      if (next_[k] == removed || corner_area(k) > 0) continue;
      if (p == a || p == b || p == c) continue;  // also the doubled corners of a bridge to a hole
      if (signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0) return false;
    }
    return true;
  }

  void remove(std::uint32_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    next_[i] = removed;
  }

 private:
  static constexpr std::uint32_t removed = 0xffffffffu;
  std::vector<Point2> points_;
  std::vector<std::uint32_t> next_, previous_, reflex_;

  double corner_area(std::uint32_t i) const {
    return signed_area(points_[previous_[i]], points_[i], points_[next_[i]]);
  }
};

}  // namespace

void triangulate_polygon(const std::vector<std::array<double, 3>>& corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (corners.size() == 3) {
    triangles.assign(1, {0, 1, 2});
    return;
  }
  triangles.clear();
  Ring ring(project(corners));

  // Ear clipping is quadratic, cubic at worst: a hostile polygon of millions of corners becomes a fan instead
  // of a hang.
  constexpr std::uint64_t most_work = 1ull << 26;
  std::uint64_t work = 0;
  std::size_t left = corners.size(), misses = 0;
  std::uint32_t corner = 1;  // a convex polygon then becomes the usual fan around corner 0
  while (left > 3 && misses < left && work < most_work) {
    const std::uint32_t next = ring.next(corner);
    if (ring.is_ear(corner, work)) {
      triangles.push_back({ring.previous(corner), corner, next});
      ring.remove(corner);
      --left;
      misses = 0;
    } else {
      ++misses;
    }
    ++work;
    corner = next;
  }
  for (std::uint32_t b = ring.next(corner); left >= 3; --left, b = ring.next(b))
    triangles.push_back({corner, b, ring.next(b)});
}

}  // namespace causticl
