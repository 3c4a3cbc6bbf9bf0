#include "format/scene_table.hpp"

#include <stdexcept>
#include <utility>

namespace causticl {
namespace types {
namespace {

using Kind = ValueType::Kind;

ValueType of_kind(Kind kind, const NumberRange& range = any_number) {
  ValueType type;
  type.kind = kind;
  type.range = range;
  return type;
}

}  // namespace

ValueType number(const NumberRange& range) { return of_kind(Kind::number, range); }
ValueType fraction(const NumberRange& range) { return of_kind(Kind::fraction, range); }
ValueType integer(std::int64_t low, std::int64_t high) {
  return of_kind(Kind::integer, {static_cast<double>(low), static_cast<double>(high), ""});
}
ValueType boolean() { return of_kind(Kind::boolean); }
ValueType string() { return of_kind(Kind::string); }
ValueType file() {
  ValueType type = string();
  type.least = 1;
  return type;
}

ValueType choice(std::vector<std::string> words, std::string pattern) {
  ValueType type = of_kind(Kind::choice);
  type.words = std::move(words);
  type.pattern = std::move(pattern);
  return type;
}

ValueType vector(const NumberRange& range) { return of_kind(Kind::vector, range); }
ValueType color(const NumberRange& range) { return of_kind(Kind::color, range); }

ValueType list(std::size_t least, std::size_t most, std::string what, ValueType item) {
  ValueType type = tuple(std::move(what), {std::move(item)});
  type.least = least;
  type.most = most;
  return type;
}

ValueType tuple(std::string what, std::vector<ValueType> items) {
  ValueType type = of_kind(Kind::list);
  type.least = type.most = items.size();
  type.name = std::move(what);
  type.parts = std::move(items);
  return type;
}

ValueType object(std::string name, std::vector<TableFunction> tables) {
  ValueType type = of_kind(Kind::object);
  type.name = std::move(name);
  type.tables = std::move(tables);
  return type;
}

ValueType map(ValueType value) {
  ValueType type = of_kind(Kind::map);
  type.parts = {std::move(value)};
  return type;
}

ValueType either(std::vector<ValueType> alternatives) {
  ValueType type = of_kind(Kind::either);
  type.parts = std::move(alternatives);
  return type;
}

}  // namespace types

SceneTable::SceneTable(std::string table_name, std::string type_word, std::string what,
                       std::vector<SceneKey> rows, std::vector<KeyRule> relations)
    : name(std::move(table_name)),
      type(std::move(type_word)),
      description(std::move(what)),
      keys(std::move(rows)),
      rules(std::move(relations)) {
  if (!type.empty()) names.push_back("type");
  for (const SceneKey& key : keys) (key.name[0] == '$' ? editor_names : names).push_back(key.name);
  for (const SceneKey& key : keys)
    if (key.alias) names.push_back(key.alias);
}

const SceneKey& SceneTable::row(const std::string& key) const {
  for (const SceneKey& candidate : keys)
    if (key == candidate.name) return candidate;
  throw std::logic_error("the table of " + name + " has no key \"" + key + "\"");
}

}  // namespace causticl
