// Vectors between host and device.
#pragma once

#include "base/vec.hpp"
#include "shared/types.h"

namespace causticl {

inline Vec3 to_vec3(float4 v) { return {v.x, v.y, v.z}; }

inline float4 to_float4(Vec3 v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

}  // namespace causticl
