// Triangle meshes that tests and benchmarks generate.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "accel/kdtree.hpp"
#include "base/vec.hpp"

namespace causticl {

using TriangleMesh = std::vector<TreeTriangle>;

inline TreeTriangle make_triangle(Vec3 a, Vec3 b, Vec3 c) {
  TreeTriangle triangle;
  const Vec3 corners[3] = {a, b, c};
  for (int v = 0; v < 3; ++v)
    for (int k = 0; k < 3; ++k) triangle.position[v][k] = static_cast<float>(corners[v][k]);
  return triangle;
}

/// A grid over [0, 1]^2 mapped by `point`, two triangles a cell. The right and upper border take the points
/// of the left and lower one where `closed`, so that no rounding parts them.
template <typename Point>
TriangleMesh grid_mesh(int columns, int rows, bool closed, const Point& point) {
  const auto at = [&](int i, int j) {
    if (closed) i %= columns, j %= rows;
    return point(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
  };
  TriangleMesh mesh;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      mesh.push_back(make_triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1)));
      mesh.push_back(make_triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1)));
    }
  return mesh;
}

/// A square of side 1 across an axis, in 20 x 20 cells.
inline TriangleMesh flat_mesh(int axis) {
  return grid_mesh(20, 20, false, [axis](double u, double v) {
    Vec3 p;
    p[axis] = 0.25;
    p[(axis + 1) % 3] = u - 0.5;
    p[(axis + 2) % 3] = v - 0.5;
    return p;
  });
}

constexpr double tau = 6.283185307179586;

inline TriangleMesh torus_mesh(int columns, int rows, double radius, double tube) {
  return grid_mesh(columns, rows, true, [=](double u, double v) {
    const double r = radius + tube * std::cos(tau * v);
    return Vec3{r * std::cos(tau * u), r * std::sin(tau * u), tube * std::sin(tau * v)};
  });
}

/// A point of the (2, 3) torus knot, u from 0 to 1.
inline Vec3 torus_knot_point(double u) {
  const double a = tau * u, r = 2 + std::cos(3 * a);
  return {r * std::cos(2 * a), r * std::sin(2 * a), std::sin(3 * a)};
}

/// A tube with small bumps round the knot, about `triangles` triangles within [-3, 3]^3.
inline TriangleMesh torus_knot_mesh(std::size_t triangles) {
  const int rows = static_cast<int>(std::sqrt(static_cast<double>(triangles) / 2 / 16));
  const int columns = static_cast<int>(triangles / 2 / static_cast<std::size_t>(rows));
  return grid_mesh(columns, rows, true, [=](double u, double v) {
    const Vec3 c = torus_knot_point(u);
    const Vec3 forward = normalize(torus_knot_point(u + 1e-4) - torus_knot_point(u - 1e-4));
    const Vec3 side = normalize(cross(forward, Vec3{0.3, 0.2, 1})), up = cross(side, forward);
    const double r = 0.35 + 0.02 * std::sin(tau * 12 * v) * std::sin(tau * 90 * u);
    return c + side * (r * std::cos(tau * v)) + up * (r * std::sin(tau * v));
  });
}

/// A sphere from an icosahedron, each triangle cut into four `levels` times.
inline TriangleMesh icosphere_mesh(int levels, double radius) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Vec3 p[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::vector<std::array<Vec3, 3>> current;
  for (const auto& f : faces) current.push_back({normalize(p[f[0]]), normalize(p[f[1]]), normalize(p[f[2]])});
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<Vec3, 3>> finer;
    for (const auto& [a, b, c] : current) {
      const Vec3 ab = normalize(a + b), bc = normalize(b + c), ca = normalize(c + a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    current = std::move(finer);
  }
  TriangleMesh mesh;
  for (const auto& [a, b, c] : current) mesh.push_back(make_triangle(a * radius, b * radius, c * radius));
  return mesh;
}

/// The twelve triangles of a box.
inline TriangleMesh box_mesh(Vec3 low, Vec3 high) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const auto corner = [&](bool right, bool top) {
        Vec3 p;
        p[axis] = (upper ? high : low)[axis];
        p[(axis + 1) % 3] = (right == upper ? high : low)[(axis + 1) % 3];
        p[(axis + 2) % 3] = (top ? high : low)[(axis + 2) % 3];
        return p;
      };
      mesh.push_back(make_triangle(corner(false, false), corner(true, false), corner(true, true)));
      mesh.push_back(make_triangle(corner(false, false), corner(true, true), corner(false, true)));
    }
  return mesh;
}

/// `mesh` with every point mapped.
template <typename Map>
TriangleMesh mapped_mesh(TriangleMesh mesh, const Map& map) {
  for (auto& triangle : mesh)
    for (auto& p : triangle.position) {
      const Vec3 to = map(Vec3{p[0], p[1], p[2]});
      for (int k = 0; k < 3; ++k) p[k] = static_cast<float>(to[k]);
    }
  return mesh;
}

}  // namespace causticl
