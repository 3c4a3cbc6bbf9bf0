#include "base/printable.hpp"

#include <cstdint>
#include <string_view>

namespace causticl {
namespace {

constexpr std::size_t longest_word = 1000, longest_line = 8000;
constexpr std::uint32_t malformed = 0xffffffff;

struct Character {
  std::uint32_t code;
  std::size_t bytes;
};

/// The character at the front of `text`, which is not empty. What is no UTF-8 (RFC 3629) is one malformed
/// byte.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return {malformed, 1};
  std::uint32_t code = first & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {malformed, 1};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  constexpr std::uint32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  if (code < smallest[bytes] || surrogate || code > 0x10ffff) return {malformed, 1};
  return {code, bytes};
}

bool is_control(std::uint32_t code) {
  if (code < 0x20 || (code >= 0x7f && code <= 0x9f) || code == malformed) return true;
  const bool separates_lines = code == 0x2028 || code == 0x2029;
  const bool turns_direction = code == 0x061c || code == 0x200e || code == 0x200f ||
                               (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  const bool invisible_tag = code >= 0xe0000 && code <= 0xe007f;
  return separates_lines || turns_direction || invisible_tag;
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Cuts between characters.
std::string first_bytes(const std::string& text, std::size_t count) {
  while (count > 0 && continues_character(text[count])) --count;
  return text.substr(0, count);
}
std::string last_bytes(const std::string& text, std::size_t count) {
  while (count > 0 && continues_character(text[text.size() - count])) --count;
  return text.substr(text.size() - count);
}

/// One line with its long words cut; the end of a word tells most of a path, so that it stays.
std::string cut(const std::string& line) {
  std::string result;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    const std::string word = line.substr(begin, end - begin);
    result += word.size() <= longest_word ? word : first_bytes(word, 700) + "..." + last_bytes(word, 200);
    if (result.size() > longest_line) return first_bytes(result, longest_line - 3) + "...";
    if (end < line.size()) result += ' ';
    begin = end + 1;
  }
  return result;
}

std::string cleaned(const std::string& text, bool line_breaks) {
  std::string result, line;
  for (std::string_view rest = text; !rest.empty();) {
    const Character character = first_character(rest);
    if (character.code == '\n' && line_breaks) {
      result += cut(line) + '\n';
      line.clear();
    } else if (is_control(character.code)) {
      line += '?';
    } else {
      line += rest.substr(0, character.bytes);
    }
    rest.remove_prefix(character.bytes);
  }
  return result + cut(line);
}

}  // namespace

std::string printable(const std::string& text) { return cleaned(text, true); }

std::string printable_line(const std::string& text) { return cleaned(text, false); }

bool has_control_characters(const std::string& text) {
  for (std::string_view rest = text; !rest.empty();) {
    const Character character = first_character(rest);
    if (is_control(character.code)) return true;
    rest.remove_prefix(character.bytes);
  }
  return false;
}

}  // namespace causticl
