// Objects as bodies: their facets, and what lies inside of them.
#pragma once

#include <vector>

#include "scene/facet.hpp"

namespace causticl {

/// The triangles of an object at time 0; other shapes cut into flat pieces. None of balls, which are known
/// exactly, and of infinite planes.
std::vector<Facet> object_facets(const Scene& scene, const Object& object);

/// An object that may hold others.
struct Body {
  const Object* object = nullptr;
  std::vector<Facet> facets;
  BoundingBox bounds;   // at time 0
  Vec3 centre;          // of a ball
  double radius = 0;    // of a ball, in the world; 0 of all else
  bool closed = false;  // a ball, or facets of which every edge has two, one in each direction

  /// Whether the point lies inside: by the distance from the centre, or by the winding number of the facets
  /// (Van Oosterom & Strackee 1983), which no edge can mislead. What is open holds what lies behind it: the
  /// points from where a ray along the mean of its normals leaves it more often than it enters it.
  bool holds(Vec3 point) const;

  /// Of all facets by area, of unit length; zero where they cancel. Of an infinite plane its own.
  Vec3 mean_normal() const;
};

Body make_body(const Scene& scene, const Object& object);

/// Up to about 200 points of the surface, spread over it.
std::vector<Vec3> surface_points(const Body& body);

}  // namespace causticl
