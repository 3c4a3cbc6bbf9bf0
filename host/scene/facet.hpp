// Flat pieces of surfaces.
#pragma once

#include "scene/object_bounds.hpp"

namespace causticl {

/// A flat piece of a surface, counter-clockwise seen from outside, in world space.
struct Facet {
  Vec3 corner[3];

  Vec3 normal() const { return cross(corner[1] - corner[0], corner[2] - corner[0]); }  // twice the area long
  BoundingBox bounds() const;
};

/// Appends the two halves of a quadrangle.
void add_quad(std::vector<Facet>& facets, Vec3 a, Vec3 b, Vec3 c, Vec3 d);

}  // namespace causticl
