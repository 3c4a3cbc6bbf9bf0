#include "accel/kdtree_bounds.hpp"

namespace causticl::kd {
namespace {

// A convex polygon: a triangle cut by the six planes of a box has nine corners at most.
struct Polygon {
  double corner[9][3];
  int size = 0;
};

// Keeps the part of `in` with sign * (x[axis] - plane) >= 0 (Sutherland and Hodgman 1974).
void clip(const Polygon& in, int axis, double plane, double sign, Polygon& out) {
  out.size = 0;
  for (int i = 0; i < in.size; ++i) {
    const double* a = in.corner[i];
    const double* b = in.corner[i + 1 == in.size ? 0 : i + 1];
    const double da = sign * (a[axis] - plane), db = sign * (b[axis] - plane);
    if (da >= 0 && out.size < 9) std::copy(a, a + 3, out.corner[out.size++]);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      if (out.size == 9) break;
      double* c = out.corner[out.size++];
      const double s = da / (da - db);
      for (int k = 0; k < 3; ++k) c[k] = a[k] + s * (b[k] - a[k]);
      c[axis] = plane;
    }
  }
}

// The float bounds of a polygon, rounded outward and cut to `cell`.
Box polygon_bounds(const Polygon& polygon, const Box& cell) {
  Box box;
  if (polygon.size == 0) return box;
  for (int k = 0; k < 3; ++k) {
    double low = polygon.corner[0][k], high = low;
    for (int i = 1; i < polygon.size; ++i) {
      low = std::min(low, polygon.corner[i][k]);
      high = std::max(high, polygon.corner[i][k]);
    }
    float l = static_cast<float>(low), h = static_cast<float>(high);
    constexpr float huge = std::numeric_limits<float>::max();
    if (l > low) l = std::nextafter(l, -huge);
    if (h < high) h = std::nextafter(h, huge);
    box.low[k] = std::clamp(l, cell.low[k], cell.high[k]);
    box.high[k] = std::clamp(h, cell.low[k], cell.high[k]);
  }
  return box;
}

}  // namespace

void split_reference(const TreeInput& input, const Reference& reference, int axis, float position, Box& left,
                     Box& right) {
  Box cells[2] = {reference.box, reference.box};
  cells[0].high[axis] = position;
  cells[1].low[axis] = position;
  if (reference.primitive() >= input.triangles.size()) {
    left = cells[0];
    right = cells[1];
    return;
  }
  const auto& triangle = input.triangles[reference.primitive()];
  Polygon polygons[2];
  polygons[0].size = 3;
  for (int v = 0; v < 3; ++v)
    for (int k = 0; k < 3; ++k) polygons[0].corner[v][k] = triangle.position[v][k];
  int current = 0;
  // Clipping to the bounds of the part so far is clipping to its cell: the part is all of the triangle in
  // them.
  const auto cut = [&](int k, double plane, double sign) {
    clip(polygons[current], k, plane, sign, polygons[1 - current]);
    current = 1 - current;
  };
  for (int k = 0; k < 3; ++k) {
    bool below = false, above = false;
    for (int v = 0; v < 3; ++v) {
      below |= triangle.position[v][k] < reference.box.low[k];
      above |= triangle.position[v][k] > reference.box.high[k];
    }
    if (below) cut(k, reference.box.low[k], 1);
    if (above) cut(k, reference.box.high[k], -1);
  }
  Polygon side;
  clip(polygons[current], axis, position, -1, side);
  left = polygon_bounds(side, cells[0]);
  clip(polygons[current], axis, position, 1, side);
  right = polygon_bounds(side, cells[1]);
}

}  // namespace causticl::kd
