// Shapes as the host uploads them, for kernels that are checked on their own.
#pragma once

#include "scene/shape_records.hpp"
#include "selftest/vectors.hpp"

namespace causticl {

inline Shape make_shape(uint type, const Transform& transform, uint curve = 0) {
  Shape shape{};
  store_transform(transform, shape);
  shape.sphere = to_float4(transform.translation, length(transform.vector({1, 0, 0})));
  shape.type = type;
  shape.material = 7;
  shape.curve = curve;
  return shape;
}

/// The map that a device shape really has: its rows in single precision.
inline Transform rows_transform(const float4* rows) {
  Transform result;
  for (int i = 0; i < 3; ++i) {
    result.rows[i] = to_vec3(rows[i]);
    result.translation[i] = rows[i].w;
  }
  return result;
}

}  // namespace causticl
