// Vectors and the key `transform`.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "format/option_values.hpp"
#include "format/scene_loader.hpp"

namespace causticl {
namespace {

constexpr NumberRange angle{-1e6, 1e6, "a number from -1e6 to 1e6"};

Vec3 read_xyz(const JsonReader& json, const NumberRange& range) {
  return {json.at("x").number(range), json.at("y").number(range), json.at("z").number(range)};
}

// "x", "y", "z", or a vector of any length but 0.
Vec3 read_axis(const JsonReader& json) {
  const JsonReader axis = json.at("axis");
  if (axis.value().kind == JsonValue::Kind::string) {
    Vec3 unit;
    unit[static_cast<int>(axis.choice({"x", "y", "z"}))] = 1;
    return unit;
  }
  const bool is_vector =
      axis.value().kind == JsonValue::Kind::object || axis.value().kind == JsonValue::Kind::array;
  if (!is_vector) axis.fail_expected("\"x\", \"y\" or \"z\", or a vector");
  const Vec3 direction = read_vector(axis);
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

Transform read_shift(const JsonReader& json) {
  json.check_keys({"type", "x", "y", "z"});
  return Transform::shift({json.number("x", 0), json.number("y", 0), json.number("z", 0)});
}

void check_factor(const JsonReader& factor) {
  if (std::abs(factor.number()) < positive_number.low)
    factor.fail_expected("a factor other than 0", "a flat object cannot be scaled back");
}

Transform read_scale(const JsonReader& json) {
  json.check_keys({"type", "factor", "x", "y", "z"});
  if (const auto factor = json.find("factor")) {
    for (const char* key : {"x", "y", "z"})
      if (json.has(key))
        json.at(key).fail(
            std::string("expected \"factor\", or \"x\", \"y\" and \"z\", got \"factor\" and \"") + key +
            "\"");
    check_factor(*factor);
    return Transform::scale({factor->number(), factor->number(), factor->number()});
  }
  Vec3 factors{1, 1, 1};
  const char* const keys[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    if (const auto factor = json.find(keys[axis])) {
      check_factor(*factor);
      factors[axis] = factor->number();
    }
  return Transform::scale(factors);
}

// 16 numbers, row by row, of a matrix that acts on columns (x, y, z, 1).
Transform read_matrix(const JsonReader& json) {
  json.check_keys({"type", "values"});
  const JsonReader values = json.at("values");
  const auto items = values.items(16, 16, "numbers, the rows of a 4x4 matrix");
  Transform result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      result.rows[row][static_cast<int>(column)] = items[4 * row + column].number();
    result.translation[static_cast<int>(row)] = items[4 * row + 3].number();
  }
  for (std::size_t column = 0; column < 4; ++column)
    if (items[12 + column].number() != (column == 3 ? 1 : 0))
      items[12 + column].fail_expected(column == 3 ? "1" : "0",
                                       "the last row of a matrix without perspective is 0, 0, 0, 1");
  // Relative to the lengths of its rows the determinant is the volume that unit vectors span.
  const double lengths = length(result.rows[0]) * length(result.rows[1]) * length(result.rows[2]);
  if (!(std::abs(result.determinant()) > 1e-12 * lengths))
    values.fail("expected a matrix that has an inverse, got one that makes objects flat");
  return result;
}

Transform read_step(const JsonReader& json) {
  if (json.value().kind != JsonValue::Kind::object) json.fail_expected("an object");
  switch (json.at("type").choice({"shift", "scale", "rotate", "rotateradian", "matrix"})) {
    case 0:
      return read_shift(json);
    case 1:
      return read_scale(json);
    case 2:
      json.check_keys({"type", "axis", "degree"});
      return rotation(read_axis(json), json.at("degree").number(angle));
    case 3:
      json.check_keys({"type", "axis", "radian"});
      return rotation_by_radians(read_axis(json), json.at("radian").number(angle));
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

Vec3 read_vector(const JsonReader& json, const NumberRange& range) {
  if (json.value().kind == JsonValue::Kind::object) {
    json.check_keys({"x", "y", "z"});
    return read_xyz(json, range);
  }
  if (json.value().kind != JsonValue::Kind::array || json.value().items.size() != 3)
    json.fail_expected("a vector", "write [x, y, z] or {\"x\": x, \"y\": y, \"z\": z}");
  const auto items = json.items(3, 3, "numbers");
  return {items[0].number(range), items[1].number(range), items[2].number(range)};
}

Vec3 read_vector(const JsonReader& json, const std::string& key, Vec3 absent, const NumberRange& range) {
  const auto found = json.find(key);
  return found ? read_vector(*found, range) : absent;
}

double read_fraction(const JsonReader& json, const std::string& key, double absent,
                     const NumberRange& range) {
  const auto found = json.find(key);
  if (!found) return absent;
  std::string percent = found->value().text;  // of a number as well as of a string
  if (percent.ends_with('%')) percent.pop_back();
  const auto value = number<double>(percent);
  const bool is_percentage =
      found->value().kind == JsonValue::Kind::string || found->value().number > range.high;
  if (value && is_percentage && *value > 0 && *value <= 100) {
    char fraction[32];
    std::snprintf(fraction, sizeof fraction, "%.12g", *value / 100);
    found->fail_expected(range.expected, percent + "% is written " + fraction);
  }
  return found->number(range);
}

Color read_color(const JsonReader& json, const NumberRange& range) {
  if (json.value().kind == JsonValue::Kind::number) {
    const double grey = json.number(range);
    return {grey, grey, grey};
  }
  const bool is_vector =
      json.value().kind == JsonValue::Kind::object || json.value().kind == JsonValue::Kind::array;
  if (!is_vector)
    json.fail_expected("a colour", "write [r, g, b], {\"x\": r, \"y\": g, \"z\": b}, or one number for grey");
  return read_vector(json, range);
}

Color read_color(const JsonReader& json, const std::string& key, Color absent, const NumberRange& range) {
  const auto found = json.find(key);
  return found ? read_color(*found, range) : absent;
}

Transform read_transform(const JsonReader& json) {
  Transform result;
  for (const JsonReader& step : json.items(0, SIZE_MAX, "transforms")) {
    result = result.followed_by(read_step(step));
    // Each step has an inverse; a long chain of them may still leave the range of the arithmetic.
    const double limit = any_number.high;
    if (!(largest_entry(result) <= limit && largest_shift(result) <= limit &&
          largest_entry(result.inverse()) <= limit))
      step.fail("expected the steps up to here to scale and shift by less than 1e12, got more");
  }
  return result;
}

}  // namespace causticl
