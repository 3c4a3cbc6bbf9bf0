// Vectors and the key `transform`.
#include <cmath>
#include <numbers>

#include "scene_loader.hpp"

namespace causticl {
namespace {

constexpr NumberRange angle{-1e6, 1e6, "a number from -1e6 to 1e6"};

Vec3 read_xyz(const JsonReader& json, const NumberRange& range) {
  return {json.at("x").number(range), json.at("y").number(range), json.at("z").number(range)};
}

int read_axis(const JsonReader& json) { return static_cast<int>(json.at("axis").choice({"x", "y", "z"})); }

// Quarter turns are exact, so that a wall turned by 90 degrees lies exactly in an axis-aligned plane.
Transform rotation(int axis, double degrees) {
  Transform result = Transform::rotate(axis, degrees * std::numbers::pi / 180);
  if (std::fmod(degrees, 90) == 0)
    for (Vec3& row : result.rows)
      for (int i = 0; i < 3; ++i) row[i] = std::round(row[i]);
  return result;
}

Transform read_step(const JsonReader& json) {
  if (json.value().kind != JsonValue::Kind::object) json.fail_expected("an object");
  switch (json.at("type").choice({"shift", "scale", "rotate", "rotateradian"})) {
    case 0:
      json.check_keys({"type", "x", "y", "z"});
      return Transform::shift(read_xyz(json, any_number));
    case 1: {
      json.check_keys({"type", "x", "y", "z"});
      const Vec3 factors = read_xyz(json, any_number);
      for (const char* key : {"x", "y", "z"})
        if (std::abs(json.at(key).number()) < positive_number.low)
          json.at(key).fail_expected("a factor other than 0", "a flat object cannot be scaled back");
      return Transform::scale(factors);
    }
    case 2:
      json.check_keys({"type", "axis", "degree"});
      return rotation(read_axis(json), json.at("degree").number(angle));
    default:
      json.check_keys({"type", "axis", "radian"});
      return Transform::rotate(read_axis(json), json.at("radian").number(angle));
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
