// What a table of the scene format is made of: objects, their keys, and what each may hold. The reader
// (scene_value.hpp) and the JSON Schema (scene_schema.hpp) both follow the tables of scene_keys.hpp.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

#include "base/vec.hpp"
#include "format/json_reader.hpp"

namespace causticl {

struct SceneTable;
/// Tables name each other by function, so that none needs another to be there first.
using TableFunction = const SceneTable& (*)();

/// What a value may be. The functions of namespace types make one.
struct ValueType {
  enum class Kind {
    number,
    fraction,  // a number; who writes it as a percentage is told how to write it
    integer,
    boolean,
    string,
    choice,  // one of some words
    vector,  // [x, y, z] or {"x", "y", "z"}
    color,   // a vector, or one number for grey
    list,
    object,  // of one table, or of several that differ by "type" or, without that, by their keys
    map,     // an object whose keys are names of the user
    either
  };
  Kind kind = Kind::number;
  NumberRange range = any_number;          // of a number, an integer, a component
  std::size_t least = 0, most = SIZE_MAX;  // list: how many items; string: the fewest bytes
  std::string name;                        // list: what an error calls its items; object: its JSON Schema
  std::vector<std::string> words;          // choice
  std::string pattern;                     // choice: a regular expression of other spellings; may be empty
  std::vector<ValueType> parts;            // list: type of all items, or of each; map: of the values; either
  std::vector<TableFunction> tables;       // object
};

namespace types {

ValueType number(const NumberRange& range = any_number);
ValueType fraction(const NumberRange& range);
ValueType integer(std::int64_t low, std::int64_t high);
ValueType boolean();
ValueType string();
/// The path of a file to read.
ValueType file();
ValueType choice(std::vector<std::string> words, std::string pattern = "");
ValueType vector(const NumberRange& range = any_number);
ValueType color(const NumberRange& range);
/// `least` to `most` items of one type.
ValueType list(std::size_t least, std::size_t most, std::string what, ValueType item);
/// As many items as there are types.
ValueType tuple(std::string what, std::vector<ValueType> items);
ValueType object(std::string name, std::vector<TableFunction> tables);
ValueType map(ValueType value);
ValueType either(std::vector<ValueType> alternatives);

}  // namespace types

/// What holds where a key is absent.
struct Absent {
  struct Required {};
  struct Described {
    const char* text;  // what happens then; may be empty
  };
  Absent(Required) : value(Required{}) {}
  Absent(Described described) : value(described) {}
  Absent(bool boolean) : value(boolean) {}
  Absent(double number) : value(number) {}
  Absent(int number) : value(double{1} * number) {}
  Absent(std::int64_t number) : value(static_cast<double>(number)) {}
  Absent(Vec3 v) : value(std::vector<double>{v.x, v.y, v.z}) {}
  Absent(std::initializer_list<double> list) : value(std::vector<double>(list)) {}
  Absent(const char* word) : value(std::string(word)) {}

  std::variant<Required, Described, bool, double, std::vector<double>, std::string> value;
};
constexpr Absent::Required required;
constexpr Absent::Described optional{""};

/// One key of an object.
struct SceneKey {
  const char* name;
  ValueType type;
  Absent absent;
  const char* description;
  const char* unit = "";
  const char* alias = nullptr;  // a second name, which an object may have in place of the first
};

/// What two keys of an object have to do with each other.
struct KeyRule {
  enum class Relation { one_of, not_both, needs };
  Relation relation;
  const char* first;
  const char* second;
  const char* place;    // the key that an error of both points to; empty: the object
  const char* message;  // not_both: after the place; needs: the hint where `second` is missing
};

/// An object of the format.
struct SceneTable {
  SceneTable(std::string table_name, std::string type_word, std::string what, std::vector<SceneKey> rows,
             std::vector<KeyRule> relations = {});

  std::string name;         // of its JSON Schema
  std::string type;         // the word that its key "type" holds; empty where it has none
  std::string description;  // as in "a DESCRIPTION"
  std::vector<SceneKey> keys;
  std::vector<KeyRule> rules;
  std::vector<std::string> names;         // of all keys, then their aliases, as errors list them
  std::vector<std::string> editor_names;  // of keys for editors, which errors do not list: "$schema"

  /// The row of a key by its first name. Throws std::logic_error where there is none: whoever reads a key has
  /// to enter it in the table.
  const SceneKey& row(const std::string& key) const;
};

}  // namespace causticl
