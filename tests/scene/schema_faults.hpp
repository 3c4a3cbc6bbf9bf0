// Values that a type of the scene format must refuse.
#pragma once

#include <cmath>
#include <vector>

#include "schema_examples.hpp"

namespace causticl {

/// A number within a range.
inline double number_within(const NumberRange& range) {
  return range.low < 1 && 1 < range.high ? 1 : (range.low + range.high) / 2;
}

/// Numbers just outside a range.
inline std::vector<Json> numbers_outside(const NumberRange& range) {
  std::vector<Json> values{range.exclusive ? range.low : std::nextafter(range.low, -HUGE_VAL),
                           range.exclusive ? range.high : std::nextafter(range.high, HUGE_VAL)};
  if (range.nonzero) values.insert(values.end(), {0, range.gap / 2, -range.gap / 2});
  return values;
}

/// A value that a type accepts.
inline Json good_value(const ValueType& type) {
  using Kind = ValueType::Kind;
  switch (type.kind) {
    case Kind::boolean:
      return true;
    case Kind::string:
      return "5x4.png";
    case Kind::choice:
      return type.words[0];
    case Kind::vector:
      return Json::array({number_within(type.range), number_within(type.range), number_within(type.range)});
    case Kind::list: {
      Json list = Json::array();
      for (std::size_t i = 0; i < type.least; ++i)
        list.push_back(good_value(type.parts[type.parts.size() > 1 ? i : 0]));
      return list;
    }
    case Kind::object:
      return parse_scene(table_examples().at(type.tables[0]().name).object);
    case Kind::map:
      return Json::object();
    case Kind::either:
      return good_value(type.parts[0]);
    default:
      return number_within(type.range);
  }
}

std::vector<Json> faults_of(const ValueType& type);

/// One component out of range; too few, too many, unknown or no numbers.
inline std::vector<Json> vector_faults(const NumberRange& range) {
  const double good = number_within(range);
  std::vector<Json> faults{"red",
                           true,
                           Json::array({good, good}),
                           Json::array({good, good, good, good}),
                           Json::array({good, good, "far"}),
                           Json::object({{"x", good}, {"y", good}}),
                           Json::object({{"x", good}, {"y", good}, {"z", good}, {"w", good}})};
  for (const Json& outside : numbers_outside(range)) {
    faults.push_back(Json::array({good, outside, good}));
    faults.push_back(Json::object({{"x", good}, {"y", good}, {"z", outside}}));
  }
  return faults;
}

/// One item too few, one too many, and every fault of an item.
inline std::vector<Json> list_faults(const ValueType& type) {
  std::vector<Json> faults{1, "list", Json::object()};
  const Json list = good_value(type);
  if (type.least > 0) {
    faults.push_back(list);
    faults.back().erase(0);
  }
  if (type.most < SIZE_MAX) {
    Json longer = list;
    while (longer.size() <= type.most) longer.push_back(good_value(type.parts[0]));
    faults.push_back(longer);
  }
  for (std::size_t i = 0; i < type.parts.size(); ++i)
    for (const Json& fault : faults_of(type.parts[i])) {
      faults.push_back(list);
      faults.back()[i] = fault;
    }
  return faults;
}

/// Of an `either`: what is wrong for the first alternative is wrong for the others. Of the others only lists
/// and objects are, for a number or a word may suit the first.
inline std::vector<Json> either_faults(const ValueType& type) {
  std::vector<Json> faults = faults_of(type.parts[0]);
  for (std::size_t i = 1; i < type.parts.size(); ++i)
    for (const Json& fault : faults_of(type.parts[i]))
      if (fault.is_structured()) faults.push_back(fault);
  return faults;
}

/// Values of other types, out of range, of a wrong length.
inline std::vector<Json> faults_of(const ValueType& type) {
  using Kind = ValueType::Kind;
  std::vector<Json> faults{nullptr};
  const auto add = [&](const std::vector<Json>& more) {
    faults.insert(faults.end(), more.begin(), more.end());
  };
  switch (type.kind) {
    case Kind::number:
    case Kind::fraction:
      add(numbers_outside(type.range));
      add({"1", true, Json::object()});
      break;
    case Kind::integer:
      add({type.range.low - 1, type.range.low + 0.5, type.range.high + 2, "1", false});
      break;
    case Kind::boolean:
      add({0, 1, "true"});
      break;
    case Kind::string:
      add({1, true, Json::array({"white"})});
      if (type.least > 0) faults.push_back("");
      break;
    case Kind::choice:
      add({"no such word", "", 1, true});
      break;
    case Kind::color:
      add(numbers_outside(type.range));
      add(vector_faults(type.range));
      break;
    case Kind::vector:
      add(vector_faults(type.range));
      faults.push_back(number_within(type.range));
      break;
    case Kind::list:
      add(list_faults(type));
      break;
    case Kind::object:
      add({1, "object", Json::array(), Json::object({{"no_such_key", 1}}),
           Json::object({{"type", "no such type"}})});
      break;
    case Kind::map:
      add({1, "map", Json::array()});
      for (const Json& fault : faults_of(type.parts[0])) faults.push_back(Json::object({{"name", fault}}));
      break;
    case Kind::either:
      add(either_faults(type));
      break;
  }
  return faults;
}

}  // namespace causticl
