#include "format/json_document.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "base/error.hpp"

namespace causticl {
namespace {

// A scene is a text that people read; data stands in meshes and images. Each value takes about 200 bytes.
constexpr std::size_t file_size_limit = std::size_t{32} << 20;
constexpr std::size_t value_limit = 1'000'000;

// The parser tells its handler about values but not about places. An iterator that reports how far it has
// been read does: every event comes with the last character of its token read, and after a number one more,
// so that the line breaks before the last character read are those before the end of the token.
struct CountingIterator {
  using iterator_category = std::forward_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  const char** furthest = nullptr;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    *furthest = ++at;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
  bool operator!=(const CountingIterator& other) const { return at != other.at; }
};

// The word that ends at or runs through `last`, for messages.
std::string word_around(const char* begin, const char* end, const char* last) {
  const auto in_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_+-.", c);
  };
  const char *first = last, *stop = last + 1;
  while (first > begin && in_word(*last) && in_word(first[-1])) --first;
  while (stop < end && in_word(*last) && in_word(*stop)) ++stop;
  return json_quote({first, stop});
}

// The parser's message, "syntax error while parsing CONTEXT - unexpected TOKEN; expected WANTED" or
// "... - FAULT; last read: 'TEXT'; expected WANTED", in the form of every other message of the loader.
std::string reworded(const std::string& what, const std::string& word) {
  std::string fault = what.substr(what.find(" - ") + 3);
  const std::string marker = "; expected ";
  const std::size_t reading = fault.find("; last read: ");
  const std::size_t split = fault.find(marker, reading == std::string::npos ? 0 : reading);
  std::string wanted = split == std::string::npos ? "" : fault.substr(split + marker.size());
  fault = fault.substr(0, std::min(reading, split));
  if (wanted.empty() || wanted.find("or a literal") != std::string::npos) wanted = "a value";
  if (wanted == "string literal") wanted = "a key in double quotes";
  if (wanted == "']'") wanted = "',' or ']'";
  if (wanted == "'}'") wanted = "',' or '}'";
  if (wanted == "':'") wanted = "':' after the key";
  if (wanted == "end of input") wanted = "nothing after the outermost value";

  const std::string unexpected = "unexpected ";
  if (fault.compare(0, unexpected.size(), unexpected) == 0) {
    const std::string got = fault.substr(unexpected.size(), fault.find(" literal") - unexpected.size());
    if (got == "end of input")
      return "expected " + wanted + ", got the end of the file; it is cut short or a bracket is not closed";
    const bool closes = got == "'}'" || got == "']'", wants_item = wanted[0] == 'a';
    return "expected " + wanted + ", got " + got +
           (closes && wants_item ? "; remove the comma before it" : "");
  }

  if (fault.find("U+000A") != std::string::npos || fault.find("U+000D") != std::string::npos)
    return "expected the string's closing quote before the end of the line";
  if (fault.compare(0, 14, "invalid string") == 0) return "malformed" + fault.substr(7);
  if (fault.compare(0, 15, "invalid comment") == 0) return "malformed" + fault.substr(7);
  return "expected " + wanted + ", got " + word;
}

// Builds the tree. `open_` holds the containers that are not closed yet; their addresses are stable since a
// container grows only while its last item is closed.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(const std::string& name, const std::string& text)
      : name_(name), begin_(text.data()), end_(begin_ + text.size()), counted_(begin_), furthest_(begin_) {}

  const char** furthest() { return &furthest_; }
  JsonValue take() { return std::move(root_); }

  bool null() override {
    add(JsonValue::Kind::null);
    return true;
  }
  bool boolean(bool value) override {
    add(JsonValue::Kind::boolean).boolean = value;
    return true;
  }
  bool number_integer(number_integer_t value) override {
    return number(static_cast<double>(value), std::to_string(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return number(static_cast<double>(value), std::to_string(value));
  }
  bool number_float(number_float_t value, const string_t& text) override { return number(value, text); }
  bool string(string_t& value) override {
    add(JsonValue::Kind::string).text = value;
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonValue::Kind::object); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& value) override {
    const int at = line();
    const auto [earlier, is_new] = open_.back().key_lines.emplace(value, at);
    if (!is_new)
      fail(at,
           "duplicate key " + json_quote(value) + ", first given in line " + std::to_string(earlier->second));
    open_.back().value->members.push_back({value, at, {}});
    return true;
  }

  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& error) override {
    if (error.id == 406) fail(line(), "expected a number that double precision can hold, got " + token);
    // What is missing at the end belongs after the last thing there is, not after the blank lines below it.
    if (furthest_ == end_)
      while (furthest_ > begin_ + 1 && std::isspace(static_cast<unsigned char>(furthest_[-1]))) --furthest_;
    fail(line(), reworded(error.what(), word_around(begin_, end_, furthest_ - 1)));
  }

 private:
  struct Container {
    JsonValue* value;
    std::unordered_map<std::string, int> key_lines;
  };

  [[noreturn]] void fail(int at, const std::string& message) {
    throw UserError(one_line(name_ + ":" + std::to_string(at) + ": " + message));
  }

  int line() {
    for (; counted_ + 1 < furthest_; ++counted_) line_ += *counted_ == '\n';
    return line_;
  }

  JsonValue& place() {
    if (open_.empty()) return root_;
    JsonValue& container = *open_.back().value;
    if (container.kind == JsonValue::Kind::array) return container.items.emplace_back();
    return container.members.back().value;
  }

  JsonValue& add(JsonValue::Kind kind) {
    if (++values_ > value_limit) fail(line(), "expected at most 1000000 values, got more");
    JsonValue& value = place();
    value.kind = kind;
    value.line = line();
    return value;
  }

  bool number(double value, const std::string& text) {
    JsonValue& added = add(JsonValue::Kind::number);
    added.number = value;
    added.text = text;
    return true;
  }

  bool open(JsonValue::Kind kind) {
    if (open_.size() >= json_depth_limit)
      fail(line(), "expected at most " + std::to_string(json_depth_limit) + " levels of nesting, got more");
    open_.push_back({&add(kind), {}});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& name_;
  const char *begin_, *end_;  // the text
  const char* counted_;       // line_ is the line of this character
  const char* furthest_;      // end of what has been read
  int line_ = 1;
  std::size_t values_ = 0;
  JsonValue root_;
  std::vector<Container> open_;
};

}  // namespace

const JsonValue* JsonValue::member(const std::string& key) const {
  for (const JsonMember& candidate : members)
    if (candidate.key == key) return &candidate.value;
  return nullptr;
}

SourceLocation JsonDocument::location(int source, int line, const std::string& pointer) const {
  return {sources[source], source == 0 ? static_cast<std::uint64_t>(line) : 0, pointer};
}

JsonDocument json_parse(const std::string& name, const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw UserError(one_line(name + ":1: expected a scene, got an empty file"));
  if (text.find('\0') != std::string::npos)
    throw UserError(one_line(name + ": expected a scene in JSON, got binary data"));
  TreeBuilder builder(name, text);
  const CountingIterator begin{text.data(), builder.furthest()},
      end{text.data() + text.size(), builder.furthest()};
  nlohmann::json::sax_parse(begin, end, &builder, nlohmann::json::input_format_t::json, true, true);
  return {{name}, builder.take()};
}

JsonDocument json_read(const std::string& file) {
  const auto fail = [&](const std::string& why) { throw UserError(one_line(file + ": " + why)); };
  std::error_code status;
  if (std::filesystem::is_directory(file, status)) fail("expected a scene file, got a directory");
  const auto refuse_large = [&] { fail("expected a scene file of at most 32 MiB, got a larger one"); };
  if (std::filesystem::is_regular_file(file, status) &&
      std::filesystem::file_size(file, status) > file_size_limit && !status)
    refuse_large();
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(std::string("cannot read the scene file: ") + std::strerror(errno));
  std::string text;
  for (char block[65536]; in.read(block, sizeof block) || in.gcount() > 0;) {
    text.append(block, static_cast<std::size_t>(in.gcount()));
    if (text.size() > file_size_limit) refuse_large();
  }
  if (in.bad()) fail(std::string("cannot read the scene file: ") + std::strerror(errno));
  return json_parse(file, text);
}

std::string json_quote(const std::string& text, std::size_t limit) {
  using nlohmann::json;
  if (text.size() <= limit) return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  // Cut between characters: the bytes 10xxxxxx continue one.
  while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xc0) == 0x80) --limit;
  return json(text.substr(0, limit) + "...").dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string one_line(const std::string& text) {
  using nlohmann::json;
  // dump() knows UTF-8: let it mark what is malformed, then take the escapes of a JSON string away again.
  const std::string valid = json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
  std::string result;
  for (const char c : valid) result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return result;
}

}  // namespace causticl
