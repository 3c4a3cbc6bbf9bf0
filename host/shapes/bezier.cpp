// A Bezier curve revolved about the local y axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "format/shape_keys.hpp"
#include "scene/curve.hpp"
#include "scene/shape_kind.hpp"
#include "scene/shape_records.hpp"

namespace causticl {
namespace {

std::array<double, 2> curve_point(CurvePoints p, double t) {
  for (std::size_t n = p.size(); n > 1; --n)
    for (std::size_t i = 0; i + 1 < n; ++i)
      for (std::size_t k = 0; k < 2; ++k) p[i][k] += (p[i + 1][k] - p[i][k]) * t;
  return p[0];
}

/// The control points of the curve. Where they lie far along the axis, they are brought near the local
/// origin, and the transform takes them back, so that floats keep the curve's digits.
CurvePoints near_points(const Object& object, Transform& transform) {
  constexpr double far = 64;  // times the curve's own size
  auto points = object.points;
  double low = points[0][1], high = low, radius = 0;
  for (const auto& [r, height] : points) {
    low = std::min(low, height);
    high = std::max(high, height);
    radius = std::max(radius, std::fabs(r));
  }
  const double middle = 0.5 * (low + high);
  if (std::fabs(middle) <= far * std::max(radius, high - low)) return points;
  for (auto& point : points) point[1] -= middle;
  transform = Transform::shift({0, middle, 0}).followed_by(transform);
  return points;
}

class Bezier : public ShapeKind {
 public:
  std::array<Vec3, 2> local_box(const Scene&, const Object& object) const override {
    Vec3 low, high;
    for (const auto& [radius, height] : object.points) {
      const double r = std::max(high.x, std::fabs(radius));
      low = {-r, std::min(low.y, height), -r};
      high = {r, std::max(high.y, height), r};
    }
    return {low, high};
  }

  /// A Bezier curve lies in the convex hull of its control points, and so does what it sweeps.
  BoundingBox bounds(const Scene&, const Object& object) const override {
    BoundingBox result;
    for (const auto& p : object.points) result.add_ellipsoid(object.transform, {0, p[1], 0}, {p[0], 0, p[0]});
    return result;
  }

  /// The normal points away from the axis side on which the area swept lies: outward where the closed profile
  /// runs upward outside.
  void add_facets(const Object& object, int pieces, std::vector<Facet>& facets) const override {
    constexpr int turns = 32;
    CurvePoints profile;
    for (int i = 0; i <= pieces; ++i)
      profile.push_back(curve_point(object.points, static_cast<double>(i) / pieces));
    double area = 0;  // of the profile closed along the axis, positive where it runs upward outside
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
      area += 0.5 * (std::fabs(profile[i][0]) + std::fabs(profile[i + 1][0])) *
              (profile[i + 1][1] - profile[i][1]);
    const auto point = [&](std::size_t i, int turn) {
      const double angle = 2 * std::numbers::pi * (turn % turns) / turns, r = std::fabs(profile[i][0]);
      return object.transform.point({r * std::cos(angle), profile[i][1], r * std::sin(angle)});
    };
    const bool turned = (area < 0) != (object.transform.determinant() < 0);
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
      for (int turn = 0; turn < turns; ++turn) {
        const Vec3 a = point(i, turn), b = point(i + 1, turn), c = point(i + 1, turn + 1),
                   d = point(i, turn + 1);
        if (turned)
          add_quad(facets, a, d, c, b);
        else
          add_quad(facets, a, b, c, d);
      }
  }

  bool is_closed_of_facets(const Object& object) const override {
    const auto& first = object.points.front();
    const auto& last = object.points.back();
    return first == last || (first[0] == 0 && last[0] == 0);
  }

  ShapePrimitive primitive(const Object& placed, bool emits) const override {
    ShapePrimitive result;
    Transform transform = placed.transform;
    const auto points = near_points(placed, transform);
    result.shape.type = SHAPE_BEZIER;
    result.shape.degree = static_cast<uint>(points.size() - 1);
    store_transform(transform, result.shape);
    result.curves = curve_data(points);
    const CurveBounds local = curve_bounds(points);
    for (const Vec3 corner : box_corners(transform, local.low, local.high)) result.bounds.add(corner);
    result.emitter.type = EMITTER_SHAPE;
    if (!emits) return result;
    const auto table = curve_area_table(points, EMITTER_AREA_STEPS);
    // Past the number of steps and the area.
    result.shape.area_table = static_cast<uint>(result.curves.size()) + 2;
    result.curves.insert(result.curves.end(), table.begin(), table.end());
    // The world's area where the scale is uniform; elsewhere kernels only need it to be the same throughout.
    result.area = table[1] * std::pow(std::fabs(transform.determinant()), 2.0 / 3.0);
    result.shape.area = static_cast<float>(result.area);
    return result;
  }
};

/// Whether the polynomial with these Bernstein coefficients is below -tolerance somewhere in [0, 1]: it stays
/// within the hull of its coefficients, so halve the interval (de Casteljau) until they decide.
bool goes_below_zero(const std::vector<double>& coefficients, double tolerance, int halvings = 20) {
  if (*std::min_element(coefficients.begin(), coefficients.end()) >= -tolerance) return false;
  if (std::min(coefficients.front(), coefficients.back()) < -tolerance) return true;
  if (halvings == 0) return false;
  std::vector<double> first, last = coefficients;
  for (std::size_t n = coefficients.size(); n > 0; --n) {
    first.push_back(last[0]);
    for (std::size_t i = 0; i + 1 < n; ++i) last[i] = (last[i] + last[i + 1]) / 2;
  }
  return goes_below_zero(first, tolerance, halvings - 1) || goes_below_zero(last, tolerance, halvings - 1);
}

/// One curve (radius, height) of degree up to 16. Control points may lie across the axis, the curve may not:
/// its surface would be turned inside out there.
CurvePoints read_points(const SceneValue& json) {
  CurvePoints points;
  std::vector<double> radii;
  bool distinct = false;
  double largest = 0;
  for (const SceneValue& item : json.items()) {
    const auto xy = item.items();
    points.push_back({xy[0].number(), xy[1].number()});
    radii.push_back(points.back()[0]);
    largest = std::max(largest, std::abs(radii.back()));
    distinct |= points.back() != points.front();
  }
  if (largest < positive_number.low)
    json.fail("expected a control point off the axis, got a curve of radius 0");
  if (!distinct) json.fail("expected control points that differ, got one point");
  if (goes_below_zero(radii, 1e-9 * largest))
    json.fail("expected a curve whose radius is nowhere negative, got one that crosses the axis");
  return points;
}

}  // namespace

const ShapeKind& bezier_shape() {
  static const Bezier kind;
  return kind;
}

const SceneTable& bezier_keys() {
  using namespace types;
  static const SceneTable table = shape_table(
      Object::Shape::bezier, "Bezier curve revolved about the local y axis",
      {{"point", list(2, 17, "control points", tuple("numbers, radius and height", {number(), number()})),
        required, "control points [radius, height]; the curve does not cross the axis", "local units"}});
  return table;
}

void read_bezier(const SceneObject& json, Object& object, SceneLoader&) {
  object.points = read_points(json.at("point"));
}

}  // namespace causticl
