// Which effect stands for the shape of an object.
#pragma once

#include "scene/scene.hpp"
#include "shared/effects.h"

namespace causticl {

/// Every shape has one.
constexpr EffectBit effect_of(Object::Shape shape) {
  switch (shape) {
    case Object::Shape::sphere:
      return EFFECT_SPHERES;
    case Object::Shape::plane:
      return EFFECT_PLANES;
    case Object::Shape::disk:
      return EFFECT_DISKS;
    case Object::Shape::bezier:
      return EFFECT_BEZIER;
    case Object::Shape::rectangle:
    case Object::Shape::box:
    case Object::Shape::mesh:
      break;
  }
  return EFFECT_TRIANGLES;
}

}  // namespace causticl
