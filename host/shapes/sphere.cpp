// The sphere about the local origin.
#include <cmath>
#include <numbers>

#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"
#include "scene/shape_records.hpp"

namespace causticl {
namespace {

// A sphere stays one under rotations, mirrors and one factor for all axes.
bool scales_uniformly(const Transform& transform) {
  const auto& [a, b, c] = transform.rows;
  const double s = dot(a, a), tolerance = 1e-6 * s;
  return std::abs(dot(b, b) - s) <= tolerance && std::abs(dot(c, c) - s) <= tolerance &&
         std::abs(dot(a, b)) <= tolerance && std::abs(dot(b, c)) <= tolerance &&
         std::abs(dot(c, a)) <= tolerance;
}

class Sphere : public ShapeKind {
 public:
  bool is_convex_body(const Object&) const override { return true; }

  std::array<Vec3, 2> local_box(const Scene&, const Object& object) const override {
    const Vec3 r{object.radius, object.radius, object.radius};
    return {-r, r};
  }

  BoundingBox bounds(const Scene&, const Object& object) const override {
    BoundingBox result;
    const double r = object.radius;
    result.add_ellipsoid(object.transform, {}, {r, r, r});
    return result;
  }

  double ball_radius(const Object& object) const override {
    return object.radius * std::cbrt(std::fabs(object.transform.determinant()));
  }

  ShapePrimitive primitive(const Object& placed, bool) const override {
    ShapePrimitive result;
    const double radius = ball_radius(placed);
    const Vec3 centre = placed.transform.translation, r{radius, radius, radius};
    result.shape.type = SHAPE_SPHERE;
    result.shape.sphere = to_float4(centre, radius);
    store_transform(placed.transform, result.shape);
    result.bounds = {centre - r, centre + r};
    result.area = 4 * std::numbers::pi * radius * radius;
    result.emitter.type = EMITTER_SPHERE;
    result.emitter.a = result.shape.sphere;
    return result;
  }

  bool wall(const Shape& shape, ShapeWall& result) const override {
    const double radius = shape.sphere.w;
    const Vec3 centre = to_vec3(shape.sphere), reach{radius, radius, radius};
    result.wall.origin = to_float4(centre, WALL_SPHERE);
    result.wall.normal.w = shape.sphere.w;
    result.low = centre - reach;
    result.high = centre + reach;
    return true;
  }
};

}  // namespace

const ShapeKind& sphere_shape() {
  static const Sphere kind;
  return kind;
}

const SceneTable& sphere_keys() {
  using namespace types;
  static const SceneTable table = shape_table(
      Object::Shape::sphere, "sphere about the local origin; its transform scales by one factor only",
      {{"radius", number(positive_number), required, "radius", "local units"}});
  return table;
}

void read_sphere(const SceneObject& json, Object& object, SceneLoader&) {
  object.radius = json.number("radius");
  if (!scales_uniformly(object.transform))
    json.at("transform")
        .fail("expected one factor for x, y and z, got a scale that makes the sphere an ellipsoid");
}

}  // namespace causticl
