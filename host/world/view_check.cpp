#include "world/view_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "world/flat_scene.hpp"

namespace causticl {
namespace {

/// A point as the camera sees it: how far ahead, and how far beyond the four sides of the view.
using Sides = std::array<double, 5>;

Sides sides_of(const CameraSpec& camera, Vec3 point) {
  const Vec3 from = point - camera.origin;
  const double ahead = dot(from, camera.axis);
  const double x = dot(from, camera.right) / dot(camera.right, camera.right);
  const double y = dot(from, camera.up) / dot(camera.up, camera.up);
  return {-ahead, x - ahead / 2, -x - ahead / 2, y - ahead / 2, -y - ahead / 2};
}

/// Whether all points lie on the outer side of one and the same border of the view, and so does what they
/// span.
bool lies_outside(const CameraSpec& camera, std::span<const Vec3> points) {
  Sides least{};
  least.fill(INFINITY);
  for (const Vec3& point : points) {
    const Sides sides = sides_of(camera, point);
    for (std::size_t i = 0; i < sides.size(); ++i) least[i] = std::min(least[i], sides[i]);
  }
  return std::any_of(least.begin(), least.end(), [](double side) { return side > 0; });
}

Vec3 vector_of(const float (&p)[3]) { return {p[0], p[1], p[2]}; }

bool sees_plane(const CameraSpec& camera, const Shape& plane) {
  const Vec3 normal{plane.to_local[2].x, plane.to_local[2].y, plane.to_local[2].z};
  const double height = dot(normal, camera.origin) + static_cast<double>(plane.to_local[2].w);
  for (const double s : {-0.5, 0.5})
    for (const double t : {-0.5, 0.5})
      if (dot(normal, camera.axis + s * camera.right + t * camera.up) * height < 0) return true;
  return height == 0;
}

}  // namespace

std::string empty_view_notice(const Scene& scene) {
  const CameraSpec& camera = scene.camera;
  if (camera.aperture > 0 || has_motion(scene)) return "";
  const FlatScene world = flatten_scene(scene, camera.shutter[0]);
  for (uint i = 0; i < world.plane_count; ++i)
    if (sees_plane(camera, world.shapes[i])) return "";
  for (const auto& triangle : world.tree.triangles) {
    const std::array<Vec3, 3> corners{vector_of(triangle.position[0]), vector_of(triangle.position[1]),
                                      vector_of(triangle.position[2])};
    if (!lies_outside(camera, corners)) return "";
  }
  for (const auto& shape : world.tree.shapes) {
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i)
      for (int axis = 0; axis < 3; ++axis)
        corners[i][axis] = ((i >> axis) & 1 ? shape.bounds.high : shape.bounds.low)[axis];
    if (!lies_outside(camera, corners)) return "";
  }
  return "the camera sees no object: none lies in its field of view; check its position and where it looks";
}

}  // namespace causticl
