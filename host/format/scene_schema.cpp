#include "format/scene_schema.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "format/scene_keys.hpp"

namespace causticl {
namespace {

using json = nlohmann::ordered_json;
using Kind = ValueType::Kind;

/// Whole numbers without a point.
json number_value(double x) {
  constexpr double whole_limit = 9007199254740992;  // 2^53
  if (x == std::floor(x) && std::abs(x) <= whole_limit) return static_cast<std::int64_t>(x);
  return x;
}

json number_schema(const NumberRange& range) {
  json schema{{"type", "number"}};
  if (range.low == range.high) return {{"const", number_value(range.low)}};
  schema[range.exclusive ? "exclusiveMinimum" : "minimum"] = number_value(range.low);
  schema[range.exclusive ? "exclusiveMaximum" : "maximum"] = number_value(range.high);
  if (range.nonzero && range.gap > 0)
    schema["not"] = {{"exclusiveMinimum", -range.gap}, {"exclusiveMaximum", range.gap}};
  else if (range.nonzero)
    schema["not"] = {{"const", 0}};
  return schema;
}

json choice_schema(const ValueType& type) {
  json words{{"enum", type.words}};
  if (type.pattern.empty()) return words;
  return {{"anyOf", {words, {{"type", "string"}, {"pattern", type.pattern}}}}};
}

/// "vector", "color_0_to_1".
std::string name_of(const std::string& kind, const NumberRange& range) {
  if (range.low == any_number.low && range.high == any_number.high) return kind;
  const auto text = [](double x) {
    char digits[32];
    return std::string(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
  };
  return kind + "_" + text(range.low) + "_to_" + text(range.high);
}

json has_keys(const std::vector<std::string>& keys) { return {{"required", keys}}; }

json rule_schema(const KeyRule& rule) {
  switch (rule.relation) {
    case KeyRule::Relation::one_of:
      return {{"oneOf", {has_keys({rule.first}), has_keys({rule.second})}}};
    case KeyRule::Relation::not_both:
      return {{"not", has_keys({rule.first, rule.second})}};
    case KeyRule::Relation::needs:
      break;
  }
  return {{"dependencies", {{rule.first, json::array({rule.second})}}}};
}

/// Schemas of types; those that have a name stand under "definitions".
class Schemas {
 public:
  json of_type(const ValueType& type);
  json of_table(const SceneTable& table);

  json definitions = json::object();

 private:
  template <typename Make>
  json defined(const std::string& name, Make make);
  json vector(const NumberRange& range);
  json list(const ValueType& type);
  json any_of(const std::vector<ValueType>& types);
  json object(const ValueType& type);
  json described(const SceneKey& key);
};

/// A reference to the definition, which `make` makes at the first mention.
template <typename Make>
json Schemas::defined(const std::string& name, Make make) {
  if (!definitions.contains(name)) {
    definitions[name] = nullptr;  // keeps its place, before those that it mentions
    json schema = make();
    definitions[name] = std::move(schema);
  }
  return {{"$ref", "#/definitions/" + name}};
}

json Schemas::vector(const NumberRange& range) {
  return defined(name_of("vector", range), [&]() -> json {
    const json component = number_schema(range);
    return {{"anyOf",
             {{{"type", "array"}, {"items", component}, {"minItems", 3}, {"maxItems", 3}},
              {{"type", "object"},
               {"properties", {{"x", component}, {"y", component}, {"z", component}}},
               {"required", {"x", "y", "z"}},
               {"additionalProperties", false}}}}};
  });
}

json Schemas::list(const ValueType& type) {
  json schema{{"type", "array"}};
  if (type.least > 0) schema["minItems"] = type.least;
  if (type.most < SIZE_MAX) schema["maxItems"] = type.most;
  if (type.parts.size() == 1) {
    schema["items"] = of_type(type.parts[0]);
  } else {
    schema["items"] = json::array();
    for (const ValueType& part : type.parts) schema["items"].push_back(of_type(part));
  }
  return schema;
}

json Schemas::any_of(const std::vector<ValueType>& types) {
  json alternatives = json::array();
  for (const ValueType& type : types) alternatives.push_back(of_type(type));
  return {{"anyOf", alternatives}};
}

json Schemas::object(const ValueType& type) {
  const auto of = [&](TableFunction table) {
    return defined(table().name, [&] { return of_table(table()); });
  };
  if (type.tables.size() == 1) return of(type.tables[0]);
  const bool by_type = std::none_of(type.tables.begin(), type.tables.end(),
                                    [](TableFunction table) { return table().type.empty(); });
  return defined(type.name, [&] {
    json alternatives = json::array(), words = json::array();
    for (const TableFunction table : type.tables) {
      const json is_this{{"properties", {{"type", {{"const", table().type}}}}}, {"required", {"type"}}};
      alternatives.push_back(by_type ? json{{"if", is_this}, {"then", of(table)}} : of(table));
      words.push_back(table().type);
    }
    if (!by_type) return json{{"anyOf", alternatives}};
    // Not "anyOf", of which validators say no more than that nothing fits.
    return json{{"type", "object"},
                {"properties", {{"type", {{"enum", words}}}}},
                {"required", {"type"}},
                {"allOf", alternatives}};
  });
}

json Schemas::of_type(const ValueType& type) {
  switch (type.kind) {
    case Kind::number:
    case Kind::fraction:
      return number_schema(type.range);
    case Kind::integer:
      return {{"type", "integer"},
              {"minimum", number_value(type.range.low)},
              {"maximum", number_value(type.range.high)}};
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::string:
      if (type.least > 0) return {{"type", "string"}, {"minLength", type.least}};
      return {{"type", "string"}};
    case Kind::choice:
      return choice_schema(type);
    case Kind::vector:
      return vector(type.range);
    case Kind::color:
      return defined(name_of("color", type.range), [&]() -> json {
        return {{"anyOf", {number_schema(type.range), vector(type.range)}}};
      });
    case Kind::list:
      return list(type);
    case Kind::object:
      return object(type);
    case Kind::map:
      return {{"type", "object"}, {"additionalProperties", of_type(type.parts[0])}};
    case Kind::either:
      return any_of(type.parts);
  }
  return {};
}

json default_value(const Absent& absent) {
  if (const auto* number = std::get_if<double>(&absent.value)) return number_value(*number);
  if (const auto* boolean = std::get_if<bool>(&absent.value)) return *boolean;
  if (const auto* word = std::get_if<std::string>(&absent.value)) return *word;
  json list = json::array();
  if (const auto* numbers = std::get_if<std::vector<double>>(&absent.value))
    for (const double x : *numbers) list.push_back(number_value(x));
  return list.empty() ? json() : list;
}

/// The type of a key with what an editor shows of it.
json Schemas::described(const SceneKey& key) {
  std::string text = key.description;
  if (*key.unit) text += std::string(" (") + key.unit + ")";
  const auto* absent = std::get_if<Absent::Described>(&key.absent.value);
  if (absent && *absent->text) text += std::string("; where absent: ") + absent->text;
  json schema{{"description", text}};
  if (const json value = default_value(key.absent); !value.is_null()) schema["default"] = value;
  json type = of_type(key.type);
  // Draft 7 ignores what stands beside a reference.
  if (type.contains("$ref"))
    schema["allOf"] = json::array({type});
  else
    schema.update(type);
  return schema;
}

json Schemas::of_table(const SceneTable& table) {
  json schema{{"description", table.description}, {"type", "object"}},
      properties = json::object(), required_keys = json::array(), rules = json::array();
  if (!table.type.empty()) {
    properties["type"] = {{"const", table.type}};
    required_keys.push_back("type");
  }
  for (const SceneKey& key : table.keys) {
    properties[key.name] = described(key);
    if (key.alias) {
      properties[key.alias] = properties[key.name];
      rules.push_back({{"not", has_keys({key.name, key.alias})}});
    }
    if (std::holds_alternative<Absent::Required>(key.absent.value)) required_keys.push_back(key.name);
  }
  for (const KeyRule& rule : table.rules) rules.push_back(rule_schema(rule));
  schema["properties"] = std::move(properties);
  if (!required_keys.empty()) schema["required"] = std::move(required_keys);
  schema["additionalProperties"] = false;
  if (!rules.empty()) schema["allOf"] = std::move(rules);
  return schema;
}

}  // namespace

std::string scene_schema() {
  Schemas schemas;
  json result{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "CaustiCL scene"}};
  result.update(schemas.of_table(scene_keys()));
  result["definitions"] = std::move(schemas.definitions);
  return result.dump(2) + "\n";
}

}  // namespace causticl
