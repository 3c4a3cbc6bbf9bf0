// The box about the local origin.
#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

class Box : public ShapeKind {
 public:
  bool is_convex_body(const Object&) const override { return true; }

  std::array<Vec3, 2> local_box(const Scene&, const Object& object) const override {
    return {-0.5 * object.size, 0.5 * object.size};
  }

  std::size_t triangles(const Scene&, const Object&) const override { return 12; }

  /// Six faces, wound counter-clockwise seen from outside also where the transform mirrors.
  bool visit_triangles(const Scene&, const Object& object, const TriangleVisitor& visit) const override {
    const bool mirrored = object.transform.determinant() < 0;
    for (int axis = 0; axis < 3; ++axis) {
      const int right = (axis + 1) % 3, up = (axis + 2) % 3;
      for (const double side : {-0.5, 0.5}) {
        const auto corner = [&](double x, double y) {
          Vec3 p;
          p[axis] = side * object.size[axis];
          p[right] = x * object.size[right];
          p[up] = y * object.size[up];
          return TriangleCorner{object.transform.point(p), {}, x + 0.5, y + 0.5};
        };
        const bool going_on =
            (side > 0) != mirrored
                ? visit_quad(corner(-.5, -.5), corner(.5, -.5), corner(.5, .5), corner(-.5, .5), visit)
                : visit_quad(corner(-.5, -.5), corner(-.5, .5), corner(.5, .5), corner(.5, -.5), visit);
        if (!going_on) return false;
      }
    }
    return true;
  }
};

}  // namespace

const ShapeKind& box_shape() {
  static const Box kind;
  return kind;
}

const SceneTable& box_keys() {
  using namespace types;
  static const SceneTable table =
      shape_table(Object::Shape::box, "box about the local origin",
                  {{"size", vector(positive_number), Object{}.size, "edge lengths", "local units"}});
  return table;
}

void read_box(const SceneObject& json, Object& object, SceneLoader&) { object.size = json.vector("size"); }

}  // namespace causticl
