// The disk in z = 0 about the local origin.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"
#include "scene/shape_records.hpp"

namespace causticl {
namespace {

class Disk : public ShapeKind {
 public:
  bool is_flat() const override { return true; }

  std::array<Vec3, 2> local_box(const Scene&, const Object& object) const override {
    const Vec3 r{object.radius, object.radius, 0};
    return {-r, r};
  }

  BoundingBox bounds(const Scene&, const Object& object) const override {
    BoundingBox result;
    result.add_ellipsoid(object.transform, {}, {object.radius, object.radius, 0});
    return result;
  }

  void add_facets(const Object& object, int, std::vector<Facet>& facets) const override {
    constexpr int turns = 64;
    const auto point = [&](int turn) {
      const double angle = 2 * std::numbers::pi * turn / turns;
      return object.transform.point({object.radius * std::cos(angle), object.radius * std::sin(angle), 0});
    };
    const Vec3 centre = object.transform.translation;
    const bool mirrored = object.transform.determinant() < 0;
    for (int turn = 0; turn < turns; ++turn) {
      const Vec3 a = point(turn), b = point(turn + 1);
      facets.push_back(mirrored ? Facet{{centre, b, a}} : Facet{{centre, a, b}});
    }
  }

  /// On the device it is the unit disk: its radius is part of the transform.
  ShapePrimitive primitive(const Object& placed, bool) const override {
    ShapePrimitive result;
    result.shape.type = SHAPE_DISK;
    const double r = placed.radius;
    const Transform transform = Transform::scale({r, r, r}).followed_by(placed.transform);
    store_transform(transform, result.shape);
    const Vec3 x = transform.vector({1, 0, 0}), y = transform.vector({0, 1, 0});
    Vec3 reach;
    for (int axis = 0; axis < 3; ++axis) reach[axis] = std::hypot(x[axis], y[axis]);
    result.bounds = {transform.translation - reach, transform.translation + reach};
    result.area = std::numbers::pi * length(cross(x, y));
    result.emitter.type = EMITTER_DISK;
    result.emitter.a = to_float4(transform.translation);
    result.emitter.b = to_float4(x);
    // The emitting side is local +z, which a mirroring transform puts on the other side of x cross y.
    result.emitter.c = to_float4(transform.determinant() < 0 ? -y : y);
    return result;
  }

  /// An ellipse counts as its inscribed circle.
  bool wall(const Shape& shape, ShapeWall& result) const override {
    const float4* rows = shape.to_world;
    const Vec3 centre = translation_of(shape), n = normal_of_flat(shape);
    const Vec3 x{rows[0].x, rows[1].x, rows[2].x}, y{rows[0].y, rows[1].y, rows[2].y};
    const double radius = std::min(length(x), length(y));
    result.wall.origin = to_float4(centre, WALL_DISK);
    result.wall.normal = to_float4(n, radius);
    Vec3 reach;
    for (int axis = 0; axis < 3; ++axis)
      reach[axis] = radius * std::sqrt(std::max(0.0, 1 - n[axis] * n[axis]));
    result.low = centre - reach;
    result.high = centre + reach;
    return true;
  }
};

}  // namespace

const ShapeKind& disk_shape() {
  static const Disk kind;
  return kind;
}

const SceneTable& disk_keys() {
  using namespace types;
  static const SceneTable table =
      shape_table(Object::Shape::disk, "disk in z = 0 about the local origin; the front looks to +z",
                  {{"radius", number(positive_number), Object{}.radius, "radius", "local units"}});
  return table;
}

void read_disk(const SceneObject& json, Object& object, SceneLoader&) {
  object.radius = json.number("radius");
}

}  // namespace causticl
