// The cylinder about the local y axis, with or without its two caps.
#include <cmath>
#include <numbers>

#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"
#include "scene/shape_records.hpp"

namespace causticl {
namespace {

// What Object::own holds.
constexpr std::size_t height = 0, capped = 1;

/// From the unit cylinder, of radius 1 and from y = -1 to 1, to the world.
Transform from_unit(const Object& object) {
  return Transform::scale({object.radius, 0.5 * object.own[height], object.radius})
      .followed_by(object.transform);
}

/// The area of the image of the wall, by the midpoint rule, which converges fast on what is periodic.
double wall_area(const Transform& to_world) {
  constexpr int steps = 4096;
  const Vec3 along = to_world.vector({0, 2, 0});
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / steps;
    sum += length(cross(to_world.vector({-std::sin(angle), 0, std::cos(angle)}), along));
  }
  return sum * 2 * std::numbers::pi / steps;
}

class Cylinder : public ShapeKind {
 public:
  bool is_convex_body(const Object& object) const override { return object.own[capped] != 0; }

  std::array<Vec3, 2> local_box(const Scene&, const Object& object) const override {
    const Vec3 high{object.radius, 0.5 * object.own[height], object.radius};
    return {-high, high};
  }

  /// As close as the ellipses at both ends.
  BoundingBox bounds(const Scene&, const Object& object) const override {
    BoundingBox result;
    for (const double y : {-0.5, 0.5})
      result.add_ellipsoid(object.transform, {0, y * object.own[height], 0},
                           {object.radius, 0, object.radius});
    return result;
  }

  void add_facets(const Object& object, int pieces, std::vector<Facet>& facets) const override {
    const Transform to_world = from_unit(object);
    const auto point = [&](int turn, double y) {
      const double angle = 2 * std::numbers::pi * (turn % pieces) / pieces;
      return to_world.point({std::cos(angle), y, std::sin(angle)});
    };
    // Counter-clockwise seen from outside, also where the transform mirrors.
    const bool mirrored = to_world.determinant() < 0;
    const auto add_triangle = [&](Vec3 a, Vec3 b, Vec3 c) {
      facets.push_back(mirrored ? Facet{{a, c, b}} : Facet{{a, b, c}});
    };
    for (int turn = 0; turn < pieces; ++turn) {
      const Vec3 a = point(turn, -1), b = point(turn, 1), c = point(turn + 1, 1), d = point(turn + 1, -1);
      add_triangle(a, b, c);
      add_triangle(a, c, d);
      if (object.own[capped] == 0) continue;
      add_triangle(to_world.point({0, 1, 0}), c, b);
      add_triangle(to_world.point({0, -1, 0}), a, d);
    }
  }

  ShapePrimitive primitive(const Object& placed, bool emits) const override {
    ShapePrimitive result;
    const Transform to_world = from_unit(placed);
    result.shape.type = SHAPE_CYLINDER;
    store_transform(to_world, result.shape);
    for (const double y : {-1.0, 1.0}) result.bounds.add_ellipsoid(to_world, {0, y, 0}, {1, 0, 1});
    result.shape.own[0] = static_cast<float>(placed.own[capped]);
    result.emitter.type = EMITTER_SHAPE;
    if (!emits) return result;
    const double wall = wall_area(to_world);
    const double cap =
        std::numbers::pi * length(cross(to_world.vector({1, 0, 0}), to_world.vector({0, 0, 1})));
    result.area = wall + (placed.own[capped] != 0 ? 2 * cap : 0);
    result.shape.own[1] = static_cast<float>(wall / result.area);
    result.shape.area = static_cast<float>(result.area);
    return result;
  }
};

}  // namespace

const ShapeKind& cylinder_shape() {
  static const Cylinder kind;
  return kind;
}

const SceneTable& cylinder_keys() {
  using namespace types;
  static const SceneTable table = shape_table(
      Object::Shape::cylinder, "cylinder about the local y axis, its centre in the local origin",
      {{"radius", number(positive_number), Object{}.radius, "radius", "local units"},
       {"height", number(positive_number), required, "from end to end", "local units"},
       {"capped", boolean(), true, "with the two discs at its ends; false: open, a tube without thickness"}});
  return table;
}

void read_cylinder(const SceneObject& json, Object& object, SceneLoader&) {
  object.radius = json.number("radius");
  object.own[height] = json.number("height");
  object.own[capped] = json.boolean("capped") ? 1 : 0;
}

}  // namespace causticl
