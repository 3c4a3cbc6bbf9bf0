// -D key=value: values laid over a parsed file.
#include <algorithm>
#include <charconv>

#include "base/error.hpp"
#include "format/json_document.hpp"

namespace causticl {
namespace {

std::vector<std::string> split_at_dots(const std::string& key) {
  std::vector<std::string> parts{""};
  for (const char c : key) {
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// Everything that comes with an option belongs to that option when an error must name its place.
void set_source(JsonValue& value, int source) {
  value.source = source;
  for (JsonValue& item : value.items) set_source(item, source);
  for (JsonMember& member : value.members) set_source(member.value, source);
}

JsonValue parse_or_string(const std::string& text) {
  try {
    return json_parse("", text).root;
  } catch (const UserError&) {
    JsonValue value;
    value.kind = JsonValue::Kind::string;
    value.text = text;
    return value;
  }
}

}  // namespace

void json_override(JsonDocument& document, const std::string& key, const std::string& value) {
  const std::string option = "-D " + key + "=" + value;
  const int source = static_cast<int>(document.sources.size());
  document.sources.push_back(option);
  const auto fail = [&](const std::string& why) { throw UserError(one_line(option + ": " + why)); };

  JsonValue* target = &document.root;
  std::string traversed;
  for (const std::string& part : split_at_dots(key)) {
    if (part.empty()) fail("expected keys joined by dots before '=', got " + json_quote(key));
    const std::string parent = traversed.empty() ? "the scene" : json_quote(traversed);
    traversed += (traversed.empty() ? "" : ".") + part;
    if (target->kind == JsonValue::Kind::array) {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
      const std::size_t count = target->items.size();
      if (error != std::errc() || end != part.data() + part.size() || index >= count)
        fail("expected an index below " + std::to_string(count) + " into " + parent + ", got " +
             json_quote(part));
      target = &target->items[index];
      continue;
    }
    if (target->kind != JsonValue::Kind::object)
      fail(parent + " is not an object: it can hold no " + json_quote(part));
    auto member = std::find_if(target->members.begin(), target->members.end(),
                               [&](const JsonMember& candidate) { return candidate.key == part; });
    if (member == target->members.end()) {
      JsonMember created;
      created.key = part;
      created.value.kind = JsonValue::Kind::object;
      created.value.source = source;
      member = target->members.insert(member, created);
    }
    target = &member->value;
  }
  *target = parse_or_string(value);
  set_source(*target, source);
}

}  // namespace causticl
