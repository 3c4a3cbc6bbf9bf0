#include "format/scene_value.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "format/option_values.hpp"

namespace causticl {
namespace {

using Kind = ValueType::Kind;

// Who writes 70 or "70%" for 0.7 is told so.
double read_fraction(const JsonReader& json, const NumberRange& range) {
  std::string percent = json.value().text;  // of a number as well as of a string
  if (percent.ends_with('%')) percent.pop_back();
  const auto value = number<double>(percent);
  const bool is_percentage = json.value().kind == JsonValue::Kind::string || json.value().number > range.high;
  if (value && is_percentage && *value > 0 && *value <= 100) {
    char fraction[32];
    std::snprintf(fraction, sizeof fraction, "%.12g", *value / 100);
    json.fail_expected(range.expected, percent + "% is written " + fraction);
  }
  return json.number(range);
}

Vec3 read_vector(const JsonReader& json, const NumberRange& range) {
  if (json.value().kind == JsonValue::Kind::object) {
    json.check_keys({"x", "y", "z"});
    return {json.at("x").number(range), json.at("y").number(range), json.at("z").number(range)};
  }
  if (json.value().kind != JsonValue::Kind::array || json.value().items.size() != 3)
    json.fail_expected("a vector", "write [x, y, z] or {\"x\": x, \"y\": y, \"z\": z}");
  const auto items = json.items(3, 3, "numbers");
  return {items[0].number(range), items[1].number(range), items[2].number(range)};
}

Vec3 read_color(const JsonReader& json, const NumberRange& range) {
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

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <typename T>
const T& constant(const Absent& absent, const std::string& key) {
  if (const T* value = std::get_if<T>(&absent.value)) return *value;
  throw std::logic_error("the key \"" + key + "\" has no such default in its table");
}

Vec3 default_vector(const Absent& absent, const std::string& key) {
  const auto& list = constant<std::vector<double>>(absent, key);
  return {list.at(0), list.at(1), list.at(2)};
}

}  // namespace

const ValueType& SceneValue::of(Kind kind) const {
  if (type_->kind != kind) throw std::logic_error(pointer() + " is of another type in its table");
  return *type_;
}

double SceneValue::number() const {
  return type_->kind == Kind::fraction ? read_fraction(json_, type_->range)
                                       : json_.number(of(Kind::number).range);
}

std::int64_t SceneValue::integer() const {
  const NumberRange& range = of(Kind::integer).range;
  return json_.integer(static_cast<std::int64_t>(range.low), static_cast<std::int64_t>(range.high));
}

bool SceneValue::boolean() const {
  of(Kind::boolean);
  return json_.boolean();
}

std::string SceneValue::string() const {
  if (type_->kind != Kind::choice) of(Kind::string);
  return json_.string();
}

std::size_t SceneValue::choice() const { return json_.choice(of(Kind::choice).words); }
Vec3 SceneValue::vector() const { return read_vector(json_, of(Kind::vector).range); }
Vec3 SceneValue::color() const { return read_color(json_, of(Kind::color).range); }

std::vector<SceneValue> SceneValue::items() const {
  const ValueType& list = of(Kind::list);
  std::vector<SceneValue> result;
  for (const JsonReader& item : json_.items(list.least, list.most, list.name))
    result.emplace_back(item, list.parts[list.parts.size() > 1 ? result.size() : 0]);
  return result;
}

std::vector<std::pair<std::string, SceneValue>> SceneValue::members() const {
  std::vector<std::pair<std::string, SceneValue>> result;
  for (const auto& [name, value] : json_.members())
    result.emplace_back(name, SceneValue(value, of(Kind::map).parts[0]));
  return result;
}

SceneObject SceneValue::object() const {
  const auto& tables = of(Kind::object).tables;
  if (!is(JsonValue::Kind::object)) fail_expected("an object");
  if (tables.size() == 1 && tables[0]().type.empty()) return {json_, tables[0]()};
  std::vector<std::string> words;
  words.reserve(tables.size());
  for (const TableFunction table : tables) words.push_back(table().type);
  const std::size_t index = json_.at("type").choice(words);
  return {json_, tables[index](), index};
}

SceneObject SceneValue::object(const SceneTable& form) const {
  // A key of another form is no spelling mistake: say what it is.
  for (const TableFunction other : of(Kind::object).tables)
    for (const auto& [key, value] : json_.members())
      if (!contains(form.names, key) && contains(other().names, key))
        value.fail("key " + json_quote(key) + " does not belong to a " + form.description +
                   "; use the keys of one form only");
  return {json_, form};
}

void SceneValue::check_keys_of_all() const {
  std::vector<std::string> names;
  for (const TableFunction table : of(Kind::object).tables)
    names.insert(names.end(), table().names.begin(), table().names.end());
  json_.check_keys(names);
}

bool SceneValue::mentions(const std::string& key) const {
  const auto& tables = of(Kind::object).tables;
  if (std::none_of(tables.begin(), tables.end(),
                   [&](TableFunction table) { return contains(table().names, key); }))
    throw std::logic_error("no table of " + type_->name + " has a key \"" + key + "\"");
  return json_.has(key);
}

SceneValue SceneValue::alternative(std::size_t index) const {
  return {json_, of(Kind::either).parts.at(index)};
}

SceneObject::SceneObject(const JsonReader& json, const SceneTable& table, std::size_t type)
    : SceneNode(json), table_(&table), type_(type) {
  json_.check_keys(table.names, table.editor_names);
  for (const KeyRule& rule : table.rules) check(rule);
}

void SceneObject::check(const KeyRule& rule) const {
  using Relation = KeyRule::Relation;
  const bool first = has(rule.first), second = has(rule.second);
  const JsonReader place = *rule.place ? json_.at(rule.place) : json_;
  if (rule.relation == Relation::needs && first && !second)
    at(rule.second).fail_expected("a value", rule.message);
  if (rule.relation == Relation::not_both && first && second) place.fail(rule.message);
  if (rule.relation == Relation::one_of && first == second)
    (first ? place : json_)
        .fail("expected " + json_quote(rule.first) + " or " + json_quote(rule.second) + ", got " +
              (first ? "both" : "neither"));
}

bool SceneObject::knows(const std::string& key) const { return contains(table_->names, key); }

std::optional<SceneValue> SceneObject::find(const std::string& key) const {
  const SceneKey& row = table_->row(key);
  const auto value = json_.find(key), other = row.alias ? json_.find(row.alias) : std::nullopt;
  if (!value && !other) return std::nullopt;
  if (!value || !other) return SceneValue(value ? *value : *other, row.type);
  // A -D that comes with one name replaces the other.
  const int source = value->value().source, other_source = other->value().source;
  if (source == other_source)
    other->fail("expected " + json_quote(key) + " or " + json_quote(row.alias) +
                ", which are the same, got both");
  return SceneValue(source > other_source ? *value : *other, row.type);
}

SceneValue SceneObject::at(const std::string& key) const {
  if (const auto found = find(key)) return *found;
  return {json_.at(key), table_->row(key).type};
}

template <typename Read, typename Default>
auto SceneObject::value_or_default(const std::string& key, Read read, Default absent) const {
  const Absent& row = table_->row(key).absent;
  if (const auto found = find(key)) return read(*found);
  if (std::holds_alternative<Absent::Required>(row.value)) return read(at(key));
  return absent(row);
}

double SceneObject::number(const std::string& key) const {
  return value_or_default(
      key, [](const SceneValue& value) { return value.number(); },
      [&](const Absent& absent) { return constant<double>(absent, key); });
}

int SceneObject::integer(const std::string& key) const {
  return value_or_default(
      key, [](const SceneValue& value) { return static_cast<int>(value.integer()); },
      [&](const Absent& absent) { return static_cast<int>(constant<double>(absent, key)); });
}

bool SceneObject::boolean(const std::string& key) const {
  return value_or_default(
      key, [](const SceneValue& value) { return value.boolean(); },
      [&](const Absent& absent) { return constant<bool>(absent, key); });
}

Vec3 SceneObject::vector(const std::string& key) const {
  return value_or_default(
      key, [](const SceneValue& value) { return value.vector(); },
      [&](const Absent& absent) { return default_vector(absent, key); });
}

Vec3 SceneObject::color(const std::string& key) const {
  return value_or_default(
      key, [](const SceneValue& value) { return value.color(); },
      [&](const Absent& absent) {
        if (!std::holds_alternative<double>(absent.value)) return default_vector(absent, key);
        const double grey = constant<double>(absent, key);
        return Vec3{grey, grey, grey};
      });
}

std::string SceneObject::word(const std::string& key) const {
  return table_->row(key).type.words.at(choice_index(key));
}

std::size_t SceneObject::choice_index(const std::string& key) const {
  return value_or_default(
      key, [](const SceneValue& value) { return value.choice(); },
      [&](const Absent& absent) {
        const auto& words = table_->row(key).type.words;
        const auto at = std::find(words.begin(), words.end(), constant<std::string>(absent, key));
        return static_cast<std::size_t>(at - words.begin());
      });
}

double SceneObject::number(const std::string& key, double absent) const {
  const auto found = find(key);
  return found ? found->number() : absent;
}

bool SceneObject::boolean(const std::string& key, bool absent) const {
  const auto found = find(key);
  return found ? found->boolean() : absent;
}

}  // namespace causticl
