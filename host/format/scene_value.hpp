// Values of a scene file as its tables (scene_keys.hpp) describe them. What a table says, they check: known
// keys, types, ranges, defaults, second names. Asking for what no table declares is a fault of the program
// and throws std::logic_error.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "format/asset_file.hpp"
#include "format/json_reader.hpp"
#include "format/scene_table.hpp"

namespace causticl {

/// A place in a scene file.
class SceneNode {
 public:
  /// As in JsonReader.
  std::string pointer() const { return json_.pointer(); }
  SourceLocation location() const { return json_.location(); }
  operator SourceLocation() const { return location(); }
  bool is(JsonValue::Kind kind) const { return json_.value().kind == kind; }
  [[noreturn]] void fail_expected(const std::string& expected, const std::string& hint = "") const {
    json_.fail_expected(expected, hint);
  }
  [[noreturn]] void fail(const std::string& message) const { json_.fail(message); }

 protected:
  explicit SceneNode(const JsonReader& json) : json_(json) {}
  JsonReader json_;
};

class SceneObject;

/// A value and its type. Each getter throws UserError where the value is of another type or out of range.
class SceneValue : public SceneNode {
 public:
  SceneValue(const JsonReader& json, const ValueType& type) : SceneNode(json), type_(&type) {}

  double number() const;  // also of a fraction
  std::int64_t integer() const;
  bool boolean() const;
  std::string string() const;  // also of a choice, whatever the word
  operator AssetName() const { return {string(), location()}; }
  std::size_t choice() const;  // index of the word
  Vec3 vector() const;
  Vec3 color() const;
  std::vector<SceneValue> items() const;
  /// Of a map: names and values, in the order of the file.
  std::vector<std::pair<std::string, SceneValue>> members() const;

  /// The object: of the only table where that has no type, else of the one that its key "type" names.
  SceneObject object() const;
  /// The object, of this one of several tables that have no "type".
  SceneObject object(const SceneTable& form) const;
  /// Throws UserError where this is no object, or has a key that none of its tables has.
  void check_keys_of_all() const;
  /// Whether this is an object with such a key, of any of its tables.
  bool mentions(const std::string& key) const;
  /// Of a type `either`: this, as of one of its alternatives.
  SceneValue alternative(std::size_t index) const;

 private:
  const ValueType& of(ValueType::Kind kind) const;

  const ValueType* type_;
};

/// An object whose keys are those of its table, and keep its rules. Getters by key give the table's default
/// where the key is absent, and throw UserError where it is required.
class SceneObject : public SceneNode {
 public:
  /// Throws UserError where it is no object, has a key beside the table's, or breaks a rule.
  SceneObject(const JsonReader& json, const SceneTable& table, std::size_t type = 0);

  /// Which of the tables of its value's type is its own.
  std::size_t type() const { return type_; }
  /// Whether the table has a key; the object may lack it.
  bool knows(const std::string& key) const;
  bool has(const std::string& key) const { return find(key).has_value(); }
  /// The value of a key. Where it is absent, every getter of the result throws that the key is required.
  SceneValue at(const std::string& key) const;
  std::optional<SceneValue> find(const std::string& key) const;

  double number(const std::string& key) const;
  int integer(const std::string& key) const;
  bool boolean(const std::string& key) const;
  Vec3 vector(const std::string& key) const;
  Vec3 color(const std::string& key) const;
  std::string word(const std::string& key) const;  // of a choice
  /// The same as an enumeration that lists the words in the order of the table.
  template <typename Enum>
  Enum choice(const std::string& key) const {
    return static_cast<Enum>(choice_index(key));
  }

  /// Where the default is no constant of the table.
  double number(const std::string& key, double absent) const;
  bool boolean(const std::string& key, bool absent) const;

 private:
  void check(const KeyRule& rule) const;
  std::size_t choice_index(const std::string& key) const;
  /// What `read` gives of the value of a key, or `absent` of its default.
  template <typename Read, typename Default>
  auto value_or_default(const std::string& key, Read read, Default absent) const;

  const SceneTable* table_;
  std::size_t type_;
};

}  // namespace causticl
