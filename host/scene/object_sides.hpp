// Which objects lie on which side of flat ones.
#pragma once

#include <vector>

#include "scene/scene.hpp"

namespace causticl {

/// Corners of a box around the object, in world space at time 0; of an infinite plane none.
std::vector<Vec3> object_corners(const Scene& scene, const Object& object);

// The sides of a flat object: that of its normal, and the other.
constexpr int front_side = 1, back_side = 2;

/// On which sides of the flat `wall` the other object has, or by its box may have, some of itself.
/// `corners` are of object_corners(), which takes its time for a mesh.
int sides_with(const Object& wall, const Object& other, const std::vector<Vec3>& corners);

/// On which side of the flat object the point is; 0 where it is in its plane.
int side_with(const Object& wall, Vec3 point);

}  // namespace causticl
