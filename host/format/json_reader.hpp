// Typed access to a JSON tree; every failure names the place, what was expected and what was found.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "format/json_document.hpp"

namespace causticl {

/// The numbers that a value may take, and how an error calls them.
struct NumberRange {
  double low, high;
  const char* expected;
  bool exclusive = false;  // low and high themselves are outside
  const char* nonzero =
      nullptr;  // where 0 and what is nearer to it than `gap` are outside: how an error says so
  double gap = 0;
  const char* hint = "";  // what an error adds: of `nonzero` where that is given, else of `expected`
};

// Coordinates and sizes stay where their squares and cubes fit a float.
constexpr NumberRange any_number{-1e12, 1e12, "a number from -1e12 to 1e12"};
constexpr NumberRange positive_number{1e-12, 1e12, "a positive number from 1e-12 to 1e12"};
constexpr NumberRange non_negative_number{0, 1e12, "a number from 0 to 1e12"};
constexpr NumberRange unit_number{0, 1, "a number from 0 to 1"};
constexpr NumberRange refractive_index{0.01, 100, "a refractive index from 0.01 to 100"};
constexpr NumberRange extinction_coefficient{0, 100, "an extinction coefficient from 0 to 100"};
constexpr NumberRange open_unit_number{0, 1, "a number between 0 and 1, both excluded", true};

/// A value of a document with its JSON pointer. Cheap to copy; the document must outlive it.
class JsonReader {
 public:
  explicit JsonReader(const JsonDocument& document)
      : document_(&document), value_(&document.root), placed_(value_) {}

  const JsonValue& value() const { return *value_; }
  /// RFC 6901; "/" for the whole document.
  std::string pointer() const { return pointer_.empty() ? "/" : pointer_; }
  /// Where the value stands, or the object that lacks it.
  SourceLocation location() const;

  /// Objects: refuses keys other than `keys`, suggesting the nearest, and `unlisted`, which it does not
  /// suggest. Throws if the value is not an object.
  void check_keys(const std::vector<std::string>& keys, const std::vector<std::string>& unlisted = {}) const;
  bool has(const std::string& key) const { return value_->member(key) != nullptr; }
  /// The value of a key. Where it is absent, every getter of the result throws that the key is required.
  JsonReader at(const std::string& key) const;
  std::optional<JsonReader> find(const std::string& key) const;
  /// All members of an object, in the order of the file.
  std::vector<std::pair<std::string, JsonReader>> members() const;

  /// The items of a list of `low` to `high` of them; `what` says what they are ("control points").
  std::vector<JsonReader> items(std::size_t low, std::size_t high, const std::string& what) const;

  double number(const NumberRange& range = any_number) const;
  /// A number without fraction (also written 1e5) from `low` to `high`.
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  bool boolean() const;
  std::string string() const;
  /// One of `names`: its index.
  std::size_t choice(const std::vector<std::string>& names) const;

  /// Throws UserError "PLACE: expected EXPECTED, got WHAT IS HERE; HINT".
  [[noreturn]] void fail_expected(const std::string& expected, const std::string& hint = "") const;
  /// Throws UserError "PLACE: MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  JsonReader child(const std::string& token, const JsonValue& value) const;

  const JsonDocument* document_;
  const JsonValue* value_;
  const JsonValue* placed_;  // whose line errors give: the value, or the object that lacks it
  std::string pointer_;
};

/// "; did you mean X?" for the name nearest to `text`, "; use one of A, B, C" where none is near.
std::string suggestion(const std::string& text, const std::vector<std::string>& names);

}  // namespace causticl
