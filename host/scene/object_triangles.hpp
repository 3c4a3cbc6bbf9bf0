// Objects that are made of triangles, in world space.
#pragma once

#include <functional>

#include "scene/scene.hpp"

namespace causticl {

struct TriangleCorner {
  Vec3 position;
  Vec3 normal;  // of unit length where the triangle is smooth
  double u = 0, v = 0;
};

/// Half the length of the cross product of two edges, as a float: 0 for what is too small to be one.
float triangle_area(const TriangleCorner (&corners)[3]);

/// Takes a triangle, and whether its normals are for shading; false to be told of no more.
using TriangleVisitor = std::function<bool(const TriangleCorner (&)[3], bool smooth)>;

/// Visits the triangles of the object one after another, wound counter-clockwise seen from outside. False
/// where the visitor ended that; nothing is visited of an object of another kind.
bool visit_triangles(const Scene& scene, const Object& object, const TriangleVisitor& visit);

/// Visits the two halves of a flat quadrangle.
bool visit_quad(const TriangleCorner& a, const TriangleCorner& b, const TriangleCorner& c,
                const TriangleCorner& d, const TriangleVisitor& visit);

/// Whether one of the object's triangles is, or may be where the object has moved to, so thin that what is
/// left of the cross product of its edges has to be computed more exactly than in float (EFFECT_SLIVERS).
bool has_slivers(const Scene& scene, const Object& object);

}  // namespace causticl
