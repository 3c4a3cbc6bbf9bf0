#include "scene/shape_kind.hpp"

#include <stdexcept>

namespace causticl {
namespace {

struct Row {
  const char* name;
  EffectBit effect;
  const ShapeKind& (*kind)();
  bool of_triangles;
};

/// In the order of Object::Shape.
constexpr Row rows[] = {
#define CAUSTICL_ROW(x, NAME, number, name, type, effect, points) {type, effect, name##_shape, false},
#define CAUSTICL_TRIANGLES_ROW(x, name, type) {type, EFFECT_TRIANGLES, name##_shape, true},
    SHAPE_TABLE(CAUSTICL_ROW, ) TRIANGLE_SHAPE_TABLE(CAUSTICL_TRIANGLES_ROW, )
#undef CAUSTICL_ROW
#undef CAUSTICL_TRIANGLES_ROW
};

const Row& row_of(Object::Shape shape) { return rows[static_cast<std::size_t>(shape)]; }

}  // namespace

const ShapeKind& kind_of(Object::Shape shape) { return row_of(shape).kind(); }

const ShapeKind& kind_of_record(const Shape& shape) {
  switch (shape.type) {
#define CAUSTICL_CASE(x, NAME, number, name, type, effect, points) \
  case SHAPE_##NAME:                                               \
    return name##_shape();
    SHAPE_TABLE(CAUSTICL_CASE, )
#undef CAUSTICL_CASE
  }
  throw std::logic_error("no shape has the number " + std::to_string(shape.type));
}

const char* name_of(Object::Shape shape) { return row_of(shape).name; }

EffectBit effect_of(Object::Shape shape) { return row_of(shape).effect; }

bool is_made_of_triangles(const Object& object) { return row_of(object.shape).of_triangles; }

BoundingBox ShapeKind::bounds(const Scene& scene, const Object& object) const {
  BoundingBox result;
  const auto [low, high] = local_box(scene, object);
  for (const Vec3 corner : box_corners(object.transform, low, high)) result.add(corner);
  return result;
}

ShapePrimitive ShapeKind::primitive(const Object& placed, bool) const {
  throw std::logic_error(std::string("a ") + name_of(placed.shape) + " is made of triangles");
}

}  // namespace causticl
