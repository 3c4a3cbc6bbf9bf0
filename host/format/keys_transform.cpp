// The tables of the steps of a `transform`.
#include "format/scene_keys.hpp"

namespace causticl {
namespace {

using namespace types;

constexpr NumberRange angle{-1e6, 1e6, "a number from -1e6 to 1e6"};
constexpr NumberRange factor{any_number.low,
                             any_number.high,
                             any_number.expected,
                             false,
                             "a factor other than 0",
                             positive_number.low,
                             "a flat object cannot be scaled back"};
constexpr const char* last_row = "the last row of a matrix without perspective is 0, 0, 0, 1";
constexpr NumberRange zero{0, 0, "0", false, nullptr, 0, last_row};
constexpr NumberRange one{1, 1, "1", false, nullptr, 0, last_row};

ValueType axis() { return either({choice({"x", "y", "z"}), vector()}); }

const SceneTable& shift_keys() {
  static const SceneTable table{"transform_shift",
                                "shift",
                                "shift",
                                {{"x", number(), 0, "along x", "scene units"},
                                 {"y", number(), 0, "along y", "scene units"},
                                 {"z", number(), 0, "along z", "scene units"}}};
  return table;
}

const SceneTable& scale_keys() {
  constexpr auto not_both = KeyRule::Relation::not_both;
  static const SceneTable table{
      "transform_scale",
      "scale",
      "scale",
      {{"factor", number(factor), optional, "along all axes"},
       {"x", number(factor), 1, "along x"},
       {"y", number(factor), 1, "along y"},
       {"z", number(factor), 1, "along z"}},
      {{not_both, "factor", "x", "x",
        "expected \"factor\", or \"x\", \"y\" and \"z\", got \"factor\" and \"x\""},
       {not_both, "factor", "y", "y",
        "expected \"factor\", or \"x\", \"y\" and \"z\", got \"factor\" and \"y\""},
       {not_both, "factor", "z", "z",
        "expected \"factor\", or \"x\", \"y\" and \"z\", got \"factor\" and \"z\""}}};
  return table;
}

const SceneTable& rotate_keys() {
  static const SceneTable table{"transform_rotate",
                                "rotate",
                                "rotation by degrees",
                                {{"axis", axis(), required, "what it turns about, right-handed"},
                                 {"degree", number(angle), required, "angle", "degrees"}}};
  return table;
}

const SceneTable& rotate_by_radians_keys() {
  static const SceneTable table{"transform_rotateradian",
                                "rotateradian",
                                "rotation by radians",
                                {{"axis", axis(), required, "what it turns about, right-handed"},
                                 {"radian", number(angle), required, "angle", "radians"}}};
  return table;
}

const SceneTable& matrix_keys() {
  std::vector<ValueType> entries(12, number());
  entries.insert(entries.end(), {number(zero), number(zero), number(zero), number(one)});
  static const SceneTable table{
      "transform_matrix",
      "matrix",
      "4x4 matrix",
      {{"values", tuple("numbers, the rows of a 4x4 matrix", entries), required,
        "row by row, of a matrix that acts on columns (x, y, z, 1); it has an inverse"}}};
  return table;
}

}  // namespace

ValueType transform_step_type() {
  return object("transform_step",
                {&shift_keys, &scale_keys, &rotate_keys, &rotate_by_radians_keys, &matrix_keys});
}

}  // namespace causticl
