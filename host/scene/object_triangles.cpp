#include "scene/object_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "scene/shape_kind.hpp"
#include "shared/types.h"

namespace causticl {
float triangle_area(const TriangleCorner (&corners)[3]) {
  const Vec3 e = corners[1].position - corners[0].position, f = corners[2].position - corners[0].position;
  return static_cast<float>(0.5 * length(cross(e, f)));
}

bool visit_triangles(const Scene& scene, const Object& object, const TriangleVisitor& visit) {
  return kind_of(object).visit_triangles(scene, object, visit);
}

bool visit_quad(const TriangleCorner& a, const TriangleCorner& b, const TriangleCorner& c,
                const TriangleCorner& d, const TriangleVisitor& visit) {
  return visit({a, b, c}, false) && visit({a, c, d}, false);
}

bool has_slivers(const Scene& scene, const Object& object) {
  // Corners are rounded to float, wherever the object has moved to: so much may each end of an edge be off.
  constexpr double roundoff = 1.0 / (1 << 24);
  double moved = 0;
  for (int axis = 0; axis < 3; ++axis) moved = std::max(moved, std::fabs(object.motion[axis]));
  return !visit_triangles(scene, object, [&](const TriangleCorner(&corners)[3], bool) {
    double reach = moved;
    for (const auto& corner : corners)
      for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, moved + std::fabs(corner.position[axis]));
    const Vec3 e = corners[1].position - corners[0].position, f = corners[2].position - corners[0].position;
    const double shorter = std::min(length(e), length(f));
    const double sine = length(cross(e, f)) / (length(e) * length(f));
    // Each edge is off by no more than 4 roundings, and turns by that over its length.
    return sine - 8 * roundoff * reach / shorter > 1.01 * std::sqrt(SLIVER_SINE2);
  });
}

}  // namespace causticl
