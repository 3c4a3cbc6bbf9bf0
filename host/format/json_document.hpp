// JSON with comments as a tree that remembers where each value stands.
#pragma once

#include <string>
#include <vector>

#include "base/source_location.hpp"

namespace causticl {

struct JsonMember;

/// One JSON value. `line` counts from 1 within its source.
struct JsonValue {
  enum class Kind { missing, null, boolean, number, string, array, object };
  Kind kind = Kind::missing;
  bool boolean = false;
  double number = 0;
  std::string text;  // a string's contents (valid UTF-8), or a number as written
  std::vector<JsonValue> items;
  std::vector<JsonMember> members;  // in the order of the file
  int line = 1;
  int source = 0;  // index into JsonDocument::sources

  /// The value of a key, or nullptr.
  const JsonValue* member(const std::string& key) const;
};

struct JsonMember {
  std::string key;
  int line = 1;  // of the key
  JsonValue value;
};

/// A parsed file with what has been laid over it. sources[0] is the file's name; the others are the options
/// ("-D renderer.radius=2") that replaced or added values.
struct JsonDocument {
  std::vector<std::string> sources;
  JsonValue root;

  /// Of what stands at a JSON pointer: in the file, or in the option that it came from.
  SourceLocation location(int source, int line, const std::string& pointer) const;
};

// Deeper nesting than this is refused: no scene needs it, and it bounds the recursion of whoever walks the
// tree.
constexpr int json_depth_limit = 64;

/// Parses JSON with // and /* */ comments; a UTF-8 byte order mark is skipped. Throws UserError
/// "NAME:LINE: expected X, got Y; hint" at the first fault: syntax, duplicate keys, numbers beyond double
/// precision, ill-formed UTF-8, nesting beyond json_depth_limit.
JsonDocument json_parse(const std::string& name, const std::string& text);

/// Reads and parses a file. Throws UserError, also for what cannot be read.
JsonDocument json_read(const std::string& file);

/// Sets the value at `key`, a path of keys and list indices joined by dots, to `value`, read as JSON, or as a
/// string where it is not JSON. Missing keys of objects are created. Throws UserError naming `-D KEY=VALUE`.
void json_override(JsonDocument& document, const std::string& key, const std::string& value);

/// `text` as a JSON string in quotes, control characters escaped, cut to `limit` bytes.
std::string json_quote(const std::string& text, std::size_t limit = 48);

/// `text` with control characters and malformed UTF-8 replaced by `?`: one printable line.
std::string one_line(const std::string& text);

}  // namespace causticl
