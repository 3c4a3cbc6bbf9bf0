// The key `transform`.
#include <cmath>
#include <numbers>

#include "format/scene_loader.hpp"

namespace causticl {
namespace {

// "x", "y", "z", or a vector of any length but 0.
Vec3 read_axis(const SceneObject& json) {
  const SceneValue axis = json.at("axis");
  if (axis.is(JsonValue::Kind::string)) {
    Vec3 unit;
    unit[static_cast<int>(axis.alternative(0).choice())] = 1;
    return unit;
  }
  const bool is_vector = axis.is(JsonValue::Kind::object) || axis.is(JsonValue::Kind::array);
  if (!is_vector) axis.fail_expected("\"x\", \"y\" or \"z\", or a vector");
  const Vec3 direction = axis.alternative(1).vector();
  // Of components as small as any number may be, the squares would vanish.
  const double largest = max_component({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0)) axis.fail("expected an axis, got a vector of length 0");
  return normalize(direction / largest);
}

// The axis that `direction` lies along, 0, 1 or 2; -1 where it lies along none.
int axis_of(Vec3 direction) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) == 1) return axis;
  return -1;
}

// Turns about the axes are those of Transform::rotate(int, double) to the bit, and quarter turns exact, so
// that a wall turned by 90 degrees lies exactly in an axis-aligned plane.
Transform rotation(Vec3 direction, double degrees) {
  const int axis = axis_of(direction);
  if (axis < 0) return Transform::rotate(direction, degrees * std::numbers::pi / 180);
  if (direction[axis] < 0) degrees = -degrees;
  Transform result = Transform::rotate(axis, degrees * std::numbers::pi / 180);
  if (std::fmod(degrees, 90) == 0)
    for (Vec3& row : result.rows)
      for (int i = 0; i < 3; ++i) row[i] = std::round(row[i]);
  return result;
}

Transform rotation_by_radians(Vec3 direction, double radians) {
  const int axis = axis_of(direction);
  return axis < 0 ? Transform::rotate(direction, radians)
                  : Transform::rotate(axis, direction[axis] < 0 ? -radians : radians);
}

Transform read_scale(const SceneObject& json) {
  if (const auto factor = json.find("factor"))
    return Transform::scale({factor->number(), factor->number(), factor->number()});
  return Transform::scale({json.number("x"), json.number("y"), json.number("z")});
}

// 16 numbers, row by row, of a matrix that acts on columns (x, y, z, 1).
Transform read_matrix(const SceneObject& json) {
  const SceneValue values = json.at("values");
  std::vector<double> items;
  for (const SceneValue& item : values.items()) items.push_back(item.number());
  Transform result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      result.rows[row][static_cast<int>(column)] = items[4 * row + column];
    result.translation[static_cast<int>(row)] = items[4 * row + 3];
  }
  // Relative to the lengths of its rows the determinant is the volume that unit vectors span.
  const double lengths = length(result.rows[0]) * length(result.rows[1]) * length(result.rows[2]);
  if (!(std::abs(result.determinant()) > 1e-12 * lengths))
    values.fail("expected a matrix that has an inverse, got one that makes objects flat");
  return result;
}

Transform read_step(const SceneObject& json) {
  switch (json.type()) {
    case 0:
      return Transform::shift({json.number("x"), json.number("y"), json.number("z")});
    case 1:
      return read_scale(json);
    case 2:
      return rotation(read_axis(json), json.number("degree"));
    case 3:
      return rotation_by_radians(read_axis(json), json.number("radian"));
    default:
      return read_matrix(json);
  }
}

double largest_entry(const Transform& transform) {
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) largest = std::fmax(largest, std::abs(transform.rows[i][j]));
  return largest;
}

double largest_shift(const Transform& transform) {
  const Vec3 t = transform.translation;
  return max_component({std::abs(t.x), std::abs(t.y), std::abs(t.z)});
}

}  // namespace

Transform read_transform(const SceneValue& json) {
  Transform result;
  for (const SceneValue& step : json.items()) {
    result = result.followed_by(read_step(step.object()));
    // Each step has an inverse; a long chain of them may still leave the range of the arithmetic.
    const double limit = any_number.high;
    if (!(largest_entry(result) <= limit && largest_shift(result) <= limit &&
          largest_entry(result.inverse()) <= limit))
      step.fail("expected the steps up to here to scale and shift by less than 1e12, got more");
  }
  return result;
}

}  // namespace causticl
