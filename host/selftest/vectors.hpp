// Frames about a direction.
#pragma once

#include "scene/float4.hpp"

namespace causticl {

/// Any right-handed orthonormal frame with z along the unit vector `axis`.
struct Frame {
  Vec3 x, y, z;
  explicit Frame(Vec3 axis) : z(axis) {
    x = normalize(cross(std::fabs(axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, axis));
    y = cross(z, x);
  }
  Vec3 to_local(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 to_world(Vec3 v) const { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace causticl
