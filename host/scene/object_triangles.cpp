#include "scene/object_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "shared/types.h"

namespace causticl {
namespace {

using Shape3 = Object::Shape;
using Corner = TriangleCorner;

bool visit_quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d,
                const TriangleVisitor& visit) {
  return visit({a, b, c}, false) && visit({a, c, d}, false);
}

bool visit_rectangle(const Object& object, const TriangleVisitor& visit) {
  const auto corner = [&](double x, double y) {
    return Corner{object.transform.point({x, y, 0}), {}, x + 0.5, y + 0.5};
  };
  // Counter-clockwise seen from local +z, also where the transform mirrors.
  if (object.transform.determinant() < 0)
    return visit_quad(corner(-.5, -.5), corner(-.5, .5), corner(.5, .5), corner(.5, -.5), visit);
  return visit_quad(corner(-.5, -.5), corner(.5, -.5), corner(.5, .5), corner(-.5, .5), visit);
}

/// Six faces, wound counter-clockwise seen from outside also where the transform mirrors.
bool visit_box(const Object& object, const TriangleVisitor& visit) {
  const bool mirrored = object.transform.determinant() < 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    for (const double side : {-0.5, 0.5}) {
      const auto corner = [&](double x, double y) {
        Vec3 p;
        p[axis] = side * object.size[axis];
        p[right] = x * object.size[right];
        p[up] = y * object.size[up];
        return Corner{object.transform.point(p), {}, x + 0.5, y + 0.5};
      };
      const bool going_on =
          (side > 0) != mirrored
              ? visit_quad(corner(-.5, -.5), corner(.5, -.5), corner(.5, .5), corner(-.5, .5), visit)
              : visit_quad(corner(-.5, -.5), corner(-.5, .5), corner(.5, .5), corner(.5, -.5), visit);
      if (!going_on) return false;
    }
  }
  return true;
}

bool visit_mesh(const Object& object, const Mesh& mesh, const TriangleVisitor& visit) {
  const Transform to_local = object.transform.inverse();
  const bool mirrored = object.transform.determinant() < 0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    Corner corners[3];
    bool smooth = object.smooth && !mesh.normal_index.empty();
    for (int c = 0; c < 3; ++c) {
      // A mirroring transform turns the winding around: two corners change places to keep outside outside.
      const int from = mirrored && c > 0 ? 3 - c : c;
      const auto& p = mesh.positions[mesh.position_index[t][from]];
      corners[c].position = object.transform.point({p[0], p[1], p[2]});
      const std::uint32_t n = mesh.normal_index.empty() ? no_index : mesh.normal_index[t][from];
      if (n == no_index) {
        smooth = false;
      } else {
        const auto& local = mesh.normals[n];
        // Normals transform by the inverse transpose.
        const Vec3 world =
            to_local.rows[0] * local[0] + to_local.rows[1] * local[1] + to_local.rows[2] * local[2];
        const double size = length(world);
        if (size > 0)
          corners[c].normal = world / size;
        else
          smooth = false;
      }
      const std::uint32_t uv = mesh.uv_index.empty() ? no_index : mesh.uv_index[t][from];
      if (uv != no_index) {
        corners[c].u = mesh.uvs[uv][0];
        corners[c].v = mesh.uvs[uv][1];
      }
    }
    if (!visit(corners, smooth)) return false;
  }
  return true;
}

}  // namespace

float triangle_area(const TriangleCorner (&corners)[3]) {
  const Vec3 e = corners[1].position - corners[0].position, f = corners[2].position - corners[0].position;
  return static_cast<float>(0.5 * length(cross(e, f)));
}

bool visit_triangles(const Scene& scene, const Object& object, const TriangleVisitor& visit) {
  switch (object.shape) {
    case Shape3::mesh:
      return visit_mesh(object, scene.meshes[static_cast<std::size_t>(object.mesh)], visit);
    case Shape3::rectangle:
      return visit_rectangle(object, visit);
    case Shape3::box:
      return visit_box(object, visit);
    default:
      return true;
  }
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
