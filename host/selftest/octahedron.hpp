// A closed convex mesh of one block of triangles.
#pragma once

#include <cmath>
#include <utility>

#include "base/vec.hpp"
#include "shared/types.h"

namespace causticl {

/// The faces of an octahedron, counter-clockwise from outside: convex as well.
inline TriangleBlock octahedron(const Transform& to_world) {
  TriangleBlock block{};
  for (uint face = 0; face < 8; ++face) {
    Vec3 corners[3];
    for (int axis = 0; axis < 3; ++axis) corners[axis][axis] = (face >> axis & 1) ? -1 : 1;
    // An odd number of mirrored axes turns the winding around.
    if (((face ^ face >> 1 ^ face >> 2) & 1) != 0) std::swap(corners[1], corners[2]);
    for (int vertex = 0; vertex < 3; ++vertex) {
      const Vec3 p = to_world.point(corners[vertex]);
      for (int axis = 0; axis < 3; ++axis) block.position[vertex][axis][face] = static_cast<float>(p[axis]);
    }
    block.primitive[face] = face;
  }
  return block;
}

/// How near the plane of a second face is to a point. Where the plane is nearer than the point's own error,
/// the point may as well lie on that face, and "the side of the surface" has no meaning.
inline double second_nearest_face(const TriangleBlock& block, Vec3 p) {
  double nearest = INFINITY, second = INFINITY;
  for (int face = 0; face < 8; ++face) {
    Vec3 v[3];
    for (int vertex = 0; vertex < 3; ++vertex)
      for (int axis = 0; axis < 3; ++axis) v[vertex][axis] = block.position[vertex][axis][face];
    const double distance = std::fabs(dot(normalize(cross(v[1] - v[0], v[2] - v[0])), p - v[0]));
    second = std::fmin(second, std::fmax(nearest, distance));
    nearest = std::fmin(nearest, distance);
  }
  return second;
}

}  // namespace causticl
