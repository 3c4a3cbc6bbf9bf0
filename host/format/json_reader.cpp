#include "format/json_reader.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/spelling.hpp"

namespace causticl {
namespace {

std::string describe(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::missing:
      return "nothing; the key is required";
    case JsonValue::Kind::null:
      return "null";
    case JsonValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case JsonValue::Kind::number:
      return value.text.size() <= 40 ? value.text : value.text.substr(0, 40) + "...";
    case JsonValue::Kind::string:
      return json_quote(value.text);
    case JsonValue::Kind::array:
      return "a list of " + std::to_string(value.items.size());
    case JsonValue::Kind::object:
      return "an object";
  }
  return "";
}

// RFC 6901, section 3.
std::string pointer_token(const std::string& key) {
  std::string result;
  for (const char c : printable_line(key.size() <= 80 ? key : key.substr(0, 80) + "...")) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  }
  return result;
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i)
    result += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + json_quote(names[i]);
  return result;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string suggestion(const std::string& text, const std::vector<std::string>& names) {
  const std::string* best = nearest_name(text, names);
  if (best) return "did you mean " + json_quote(*best) + "?";
  if (names.empty()) return "";
  return "use " + std::string(names.size() > 2 ? "one of " : "") + quoted_list(names);
}

SourceLocation JsonReader::location() const {
  return document_->location(placed_->source, placed_->line, pointer());
}

void JsonReader::fail(const std::string& message) const {
  throw UserError(one_line(location().text() + ": " + message));
}

void JsonReader::fail_expected(const std::string& expected, const std::string& hint) const {
  fail("expected " + expected + ", got " + describe(*value_) + (hint.empty() ? "" : "; " + hint));
}

JsonReader JsonReader::child(const std::string& token, const JsonValue& value) const {
  JsonReader result = *this;
  result.value_ = result.placed_ = &value;
  result.pointer_ += '/';
  result.pointer_ += pointer_token(token);
  return result;
}

void JsonReader::check_keys(const std::vector<std::string>& keys,
                            const std::vector<std::string>& unlisted) const {
  if (value_->kind != JsonValue::Kind::object) fail_expected("an object");
  for (const JsonMember& member : value_->members) {
    if (contains(keys, member.key) || contains(unlisted, member.key)) continue;
    const SourceLocation at =
        document_->location(member.value.source, member.line, child(member.key, member.value).pointer());
    throw UserError(one_line(at.text() + ": unknown key " + json_quote(member.key) + "; " +
                             suggestion(member.key, keys)));
  }
}

std::optional<JsonReader> JsonReader::find(const std::string& key) const {
  const JsonValue* value = value_->member(key);
  if (!value) return std::nullopt;
  return child(key, *value);
}

JsonReader JsonReader::at(const std::string& key) const {
  static const JsonValue missing;
  if (const auto found = find(key)) return *found;
  JsonReader result = child(key, missing);
  result.placed_ = value_;
  return result;
}

std::vector<std::pair<std::string, JsonReader>> JsonReader::members() const {
  if (value_->kind != JsonValue::Kind::object) fail_expected("an object");
  std::vector<std::pair<std::string, JsonReader>> result;
  for (const JsonMember& member : value_->members)
    result.emplace_back(member.key, child(member.key, member.value));
  return result;
}

std::vector<JsonReader> JsonReader::items(std::size_t low, std::size_t high, const std::string& what) const {
  const std::string count = low == high        ? std::to_string(low)
                            : high == SIZE_MAX ? (low == 0 ? "" : "at least " + std::to_string(low))
                                               : std::to_string(low) + " to " + std::to_string(high);
  const std::vector<JsonValue>& list = value_->items;
  if (value_->kind != JsonValue::Kind::array || list.size() < low || list.size() > high)
    fail_expected("a list of " + count + (count.empty() ? "" : " ") + what);
  std::vector<JsonReader> result;
  result.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) result.push_back(child(std::to_string(i), list[i]));
  return result;
}

double JsonReader::number(const NumberRange& range) const {
  const double x = value_->number;
  const bool inside = range.exclusive ? x > range.low && x < range.high : x >= range.low && x <= range.high;
  if (value_->kind != JsonValue::Kind::number || !inside)
    fail_expected(range.expected, range.nonzero ? "" : range.hint);
  if (range.nonzero && (x == 0 || std::abs(x) < range.gap)) fail_expected(range.nonzero, range.hint);
  return x;
}

std::int64_t JsonReader::integer(std::int64_t low, std::int64_t high) const {
  const double x = value_->number;
  if (value_->kind != JsonValue::Kind::number || x != std::floor(x) || x < static_cast<double>(low) ||
      x > static_cast<double>(high))
    fail_expected("an integer from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<std::int64_t>(x);
}

bool JsonReader::boolean() const {
  if (value_->kind != JsonValue::Kind::boolean) fail_expected("true or false");
  return value_->boolean;
}

std::string JsonReader::string() const {
  if (value_->kind != JsonValue::Kind::string) fail_expected("a string");
  return value_->text;
}

std::size_t JsonReader::choice(const std::vector<std::string>& names) const {
  if (value_->kind != JsonValue::Kind::string) fail_expected(quoted_list(names));
  const std::string& text = value_->text;
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string hint = suggestion(text, names);
  fail_expected(quoted_list(names), hint.compare(0, 3, "did") == 0 ? hint : "");
}

}  // namespace causticl
