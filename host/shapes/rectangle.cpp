// The square in z = 0 about the local origin.
#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

class Rectangle : public ShapeKind {
 public:
  bool is_flat() const override { return true; }

  std::array<Vec3, 2> local_box(const Scene&, const Object&) const override {
    return {Vec3{-0.5, -0.5, 0}, Vec3{0.5, 0.5, 0}};
  }

  std::size_t triangles(const Scene&, const Object&) const override { return 2; }

  /// Counter-clockwise seen from local +z, also where the transform mirrors.
  bool visit_triangles(const Scene&, const Object& object, const TriangleVisitor& visit) const override {
    const auto corner = [&](double x, double y) {
      return TriangleCorner{object.transform.point({x, y, 0}), {}, x + 0.5, y + 0.5};
    };
    if (object.transform.determinant() < 0)
      return visit_quad(corner(-.5, -.5), corner(-.5, .5), corner(.5, .5), corner(.5, -.5), visit);
    return visit_quad(corner(-.5, -.5), corner(.5, -.5), corner(.5, .5), corner(-.5, .5), visit);
  }
};

}  // namespace

const ShapeKind& rectangle_shape() {
  static const Rectangle kind;
  return kind;
}

const SceneTable& rectangle_keys() {
  static const SceneTable table = shape_table(
      Object::Shape::rectangle, "square in z = 0, from -1/2 to 1/2 in x and y; the front looks to +z");
  return table;
}

void read_rectangle(const SceneObject&, Object&, SceneLoader&) {}

}  // namespace causticl
