// Where a ray meets a sphere, for the very numbers that the device sees.
#pragma once

#include <cmath>

#include "base/vec.hpp"

namespace causticl {

/// The roots in units of the direction's length, in long double: from the distance between centre and ray,
/// which cancels nothing however far away the sphere is. Where the ray misses, near = far = that of the
/// closest approach.
struct SphereRoots {
  long double near, far;
  long double closest;   // t of the closest approach of the whole line
  long double approach;  // the distance between centre and line
  long double distance;  // between centre and origin
};

inline SphereRoots sphere_roots(Vec3 centre, double radius, Vec3 origin, Vec3 direction) {
  long double f[3], a = 0, b = 0, distance2 = 0, approach2 = 0;
  for (int i = 0; i < 3; ++i) {
    f[i] = static_cast<long double>(origin[i]) - centre[i];
    a += static_cast<long double>(direction[i]) * direction[i];
    b -= f[i] * direction[i];
    distance2 += f[i] * f[i];
  }
  b /= a;
  for (int i = 0; i < 3; ++i) {
    const long double x = f[i] + b * direction[i];
    approach2 += x * x;
  }
  const long double half = std::sqrt(std::fmax((radius * radius - approach2) / a, 0.0L));
  return {b - half, b + half, b, std::sqrt(approach2), std::sqrt(distance2)};
}

}  // namespace causticl
