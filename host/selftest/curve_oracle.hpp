// First hit of a ray with a revolved Bezier curve, in double precision, by another method than the device's:
// a tree of boxes over many short cone frustums, each met exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/curve.hpp"

namespace causticl {

class CurveOracle {
 public:
  explicit CurveOracle(const CurvePoints& points) {
    for (int i = 0; i <= leaves; ++i) samples_.push_back(point(points, static_cast<double>(i) / leaves));
    nodes_.resize(2 * leaves);
    for (int i = 2 * leaves - 1; i > 0; --i) {
      Box& box = nodes_[i];
      if (i >= leaves) {
        const auto &a = samples_[i - leaves], &b = samples_[i - leaves + 1];
        const double x0 = std::abs(a[0]), x1 = std::abs(b[0]);
        box = {a[0] * b[0] < 0 ? 0 : std::min(x0, x1), std::max(x0, x1), std::min(a[1], b[1]),
               std::max(a[1], b[1])};
      } else {
        const Box &a = nodes_[2 * i], &b = nodes_[2 * i + 1];
        box = {std::min(a.x_low, b.x_low), std::max(a.x_high, b.x_high), std::min(a.y_low, b.y_low),
               std::max(a.y_high, b.y_high)};
      }
    }
    scale_ = std::max(nodes_[1].x_high, (nodes_[1].y_high - nodes_[1].y_low) / 2);
  }

  /// (x, y) at t.
  static std::array<double, 2> point(const CurvePoints& points, double t) {
    CurvePoints p = points;
    for (std::size_t n = p.size(); n > 1; --n)
      for (std::size_t i = 0; i + 1 < n; ++i)
        for (std::size_t k = 0; k < 2; ++k) p[i][k] += (p[i + 1][k] - p[i][k]) * t;
    return p[0];
  }

  double scale() const { return scale_; }

  /// The least t > 0, or infinity.
  double primary_hit(Vec3 o, Vec3 d) const {
    double best = INFINITY;
    int stack[64], size = 0;
    stack[size++] = 1;
    while (size > 0) {
      const int node = stack[--size];
      if (!overlaps(nodes_[node], o, d, best)) continue;
      if (node >= leaves)
        for_segments(node - leaves, [&](const auto& a, const auto& b) { frustum(a, b, o, d, best); });
      else {
        stack[size++] = 2 * node;
        stack[size++] = 2 * node + 1;
      }
    }
    return best;
  }

  /// Whether a primary hit at `t` is right for a surface that is known to within `tolerance`: the ray is at
  /// the surface there, and wherever it crosses the surface before, it stays within the tolerance until it
  /// crosses back or reaches t.
  bool right_within(Vec3 o, Vec3 d, double t, double tolerance) const {
    const auto away = [&](double at) { return distance(o + d * at, 2 * tolerance) > tolerance; };
    if (std::isfinite(t) && away(t)) return false;
    double start = 0;
    for (int crossing = 0; crossing < 64; ++crossing) {
      const double next = start + primary_hit(o + d * start, d);
      if (next >= t * (1 - 1e-6)) return true;
      const double after = next + 1e-9 * (1 + next);
      const double until = std::min(after + primary_hit(o + d * after, d), t);
      if (std::isinf(until)) return false;
      for (int i = 0; i < 16; ++i)
        if (away(next + (until - next) * (i + 0.5) / 16)) return false;
      start = after;
    }
    return false;
  }

  /// Distance of a local point from the surface, no more than `at_most`.
  double distance(Vec3 p, double at_most = INFINITY) const {
    const double rho = std::hypot(p.x, p.z);
    double best = at_most;
    int stack[64], size = 0;
    stack[size++] = 1;
    while (size > 0) {
      const int node = stack[--size];
      const Box& box = nodes_[node];
      const double x = std::max({box.x_low - rho, rho - box.x_high, 0.0});
      const double y = std::max({box.y_low - p.y, p.y - box.y_high, 0.0});
      if (x * x + y * y >= best * best) continue;
      if (node >= leaves) {
        for_segments(node - leaves, [&](const auto& a, const auto& b) {
          best = std::min(best, segment_distance(a, b, rho, p.y));
        });
      } else {
        stack[size++] = 2 * node;
        stack[size++] = 2 * node + 1;
      }
    }
    return best;
  }

 private:
  static constexpr int leaves = 1 << 14;
  struct Box {
    double x_low, x_high, y_low, y_high;
  };
  std::vector<std::array<double, 2>> samples_;
  std::vector<Box> nodes_;
  double scale_ = 1;

  bool overlaps(const Box& box, Vec3 o, Vec3 d, double best) const {
    const double pad = 1e-9 * scale_;
    double t0 = 0, t1 = best;
    if (d.y != 0) {
      const double ya = (box.y_low - pad - o.y) / d.y, yb = (box.y_high + pad - o.y) / d.y;
      t0 = std::max(t0, std::min(ya, yb));
      t1 = std::min(t1, std::max(ya, yb));
    } else if (o.y < box.y_low - pad || o.y > box.y_high + pad) {
      return false;
    }
    const double a = d.x * d.x + d.z * d.z;
    const double r1 = box.x_high + pad, r0 = std::max(box.x_low - pad, 0.0);
    if (a < 1e-20) {
      const double rho = std::hypot(o.x, o.z);
      return t0 <= t1 && rho <= r1 + 1e-6 && rho >= r0 - 1e-6;
    }
    const double closest = -(o.x * d.x + o.z * d.z) / a;
    const double rho = std::hypot(o.x + d.x * closest, o.z + d.z * closest);
    if (rho > r1) return false;
    const double outer = std::sqrt((r1 * r1 - rho * rho) / a);
    t0 = std::max(t0, closest - outer);
    t1 = std::min(t1, closest + outer);
    if (t0 > t1) return false;
    const double inner = r0 > rho ? std::sqrt((r0 * r0 - rho * rho) / a) * (1 - 1e-9) : 0;
    return t0 <= closest - inner || t1 >= closest + inner;
  }

  // Calls f for the pieces (|x|, y) of a leaf: two where it crosses the axis.
  template <typename F>
  void for_segments(int leaf, F f) const {
    using Point = std::array<double, 2>;
    const Point &a = samples_[leaf], &b = samples_[leaf + 1];
    const Point first{std::abs(a[0]), a[1]}, last{std::abs(b[0]), b[1]};
    if (a[0] * b[0] < 0) {
      const Point axis{0, a[1] + (b[1] - a[1]) * a[0] / (a[0] - b[0])};
      f(first, axis);
      f(axis, last);
    } else {
      f(first, last);
    }
  }

  static double segment_distance(const std::array<double, 2>& a, const std::array<double, 2>& b, double x,
                                 double y) {
    const double ex = b[0] - a[0], ey = b[1] - a[1], length2 = ex * ex + ey * ey;
    const double along =
        length2 > 0 ? std::clamp(((x - a[0]) * ex + (y - a[1]) * ey) / length2, 0.0, 1.0) : 0;
    return std::hypot(a[0] + along * ex - x, a[1] + along * ey - y);
  }

  // The line n . (rho, y) = c of the segment against the path: nx rho = c - ny y, squared.
  static void frustum(const std::array<double, 2>& p0, const std::array<double, 2>& p1, Vec3 o, Vec3 d,
                      double& best) {
    const double ex = p1[0] - p0[0], ey = p1[1] - p0[1], length2 = ex * ex + ey * ey;
    if (length2 == 0) return;
    const double length = std::sqrt(length2), nx = ey / length, ny = -ex / length;
    const double c = nx * p0[0] + ny * p0[1];
    const auto accept = [&](double t) {
      if (!(t > 0 && t < best)) return;
      const double rho = std::hypot(o.x + t * d.x, o.z + t * d.z), y = o.y + t * d.y;
      if (std::abs(nx * rho + ny * y - c) > 1e-9 * (1 + std::abs(c))) return;  // the mirrored cone
      const double along = ((rho - p0[0]) * ex + (y - p0[1]) * ey) / length2;
      if (along >= -1e-9 && along <= 1 + 1e-9) best = t;
    };
    if (std::abs(nx) < 1e-9) {
      if (d.y != 0) accept((p0[1] - o.y) / d.y);
      return;
    }
    const double k = c - ny * o.y, m = ny * d.y;
    const double qa = nx * nx * (d.x * d.x + d.z * d.z) - m * m;
    const double qb = nx * nx * (o.x * d.x + o.z * d.z) + k * m;
    const double qc = nx * nx * (o.x * o.x + o.z * o.z) - k * k;
    const double discriminant = qb * qb - qa * qc;
    if (discriminant < 0) return;
    const double q = -(qb + std::copysign(std::sqrt(discriminant), qb));
    if (qa != 0) accept(q / qa);
    if (q != 0) accept(qc / q);
  }
};

}  // namespace causticl
