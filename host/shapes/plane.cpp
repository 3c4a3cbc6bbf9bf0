// The infinite plane z = 0.
#include <limits>

#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"
#include "scene/shape_records.hpp"

namespace causticl {
namespace {

class Plane : public ShapeKind {
 public:
  bool is_flat() const override { return true; }
  bool is_infinite() const override { return true; }

  std::array<Vec3, 2> local_box(const Scene&, const Object&) const override { return {}; }
  BoundingBox bounds(const Scene&, const Object&) const override { return {}; }

  ShapePrimitive primitive(const Object& placed, bool) const override {
    ShapePrimitive result;
    result.shape.type = SHAPE_PLANE;
    store_transform(placed.transform, result.shape);
    return result;
  }

  bool wall(const Shape& shape, ShapeWall& result) const override {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    result.wall.origin = to_float4(translation_of(shape), WALL_PLANE);
    result.wall.normal = to_float4(normal_of_flat(shape));
    result.low = {-infinity, -infinity, -infinity};
    result.high = -result.low;
    return true;
  }
};

}  // namespace

const ShapeKind& plane_shape() {
  static const Plane kind;
  return kind;
}

const SceneTable& plane_keys() {
  static const SceneTable table = shape_table(Object::Shape::plane, "infinite plane z = 0");
  return table;
}

void read_plane(const SceneObject&, Object&, SceneLoader&) {}

}  // namespace causticl
