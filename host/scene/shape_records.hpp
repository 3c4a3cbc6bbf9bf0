// Places of shapes in their records of the device.
#pragma once

#include "scene/float4.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// Sets both maps of the record.
inline void store_transform(const Transform& transform, Shape& shape) {
  const Transform inverse = transform.inverse();
  for (int i = 0; i < 3; ++i) {
    shape.to_world[i] = to_float4(transform.rows[static_cast<std::size_t>(i)], transform.translation[i]);
    shape.to_local[i] = to_float4(inverse.rows[static_cast<std::size_t>(i)], inverse.translation[i]);
  }
}

/// The image of the local origin.
inline Vec3 translation_of(const Shape& shape) {
  return {shape.to_world[0].w, shape.to_world[1].w, shape.to_world[2].w};
}

/// The unit normal of a shape in z = 0: the row of the inverse, whatever the map does to the local axes.
inline Vec3 normal_of_flat(const Shape& shape) { return normalize(to_vec3(shape.to_local[2])); }

}  // namespace causticl
