// Where the surfaces of two bodies touch, as far as single precision can tell.
#pragma once

#include "scene/body.hpp"

namespace causticl {

/// How near surfaces within these bounds must come to be one for the kernels: some roundings of the largest
/// coordinate.
double contact_tolerance(const BoundingBox& bounds);

/// A box that holds every place where the two surfaces touch along a face, or where a sphere is tangent to
/// the other; empty where there is none. Edges and corners that meet do not count.
BoundingBox touching_faces(const Body& a, const Body& b, double tolerance);

/// Whether one surface passes through the other, touches it, or lies inside of it. May be true of surfaces
/// that come near each other.
bool surfaces_meet(const Body& a, const Body& b, double tolerance);

}  // namespace causticl
