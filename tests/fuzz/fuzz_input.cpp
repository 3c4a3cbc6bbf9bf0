#include "fuzz_input.hpp"

#include "base/printable.hpp"

namespace causticl {
namespace {

// Longer lines say nothing that a person reads.
constexpr std::size_t longest_line = 8192;

}  // namespace

const TemporaryFolder& fuzz_folder() {
  static const TemporaryFolder folder;
  return folder;
}

void promise_one_line(const std::string& text) {
  promise(!text.empty(), "a message is not empty");
  promise(text.find_first_of("\n\r") == std::string::npos, "a message is one line: " + text);
  promise_for_terminal(printable_line(text));
}

// By bytes, not by the functions that cleaned the text.
void promise_for_terminal(const std::string& line) {
  promise(line.size() <= longest_line, "a line has at most 8192 bytes: " + line.substr(0, 200));
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto byte = [&](std::size_t at) {
      return at < line.size() ? static_cast<unsigned char>(line[at]) : 0u;
    };
    const bool is_c0 = byte(i) < 0x20 || byte(i) == 0x7f;
    const bool is_c1 = byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) <= 0x9f;
    // U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069
    const bool turns =
        byte(i) == 0xe2 && ((byte(i + 1) == 0x80 && (byte(i + 2) == 0x8e || byte(i + 2) == 0x8f ||
                                                     (byte(i + 2) >= 0xa8 && byte(i + 2) <= 0xae))) ||
                            (byte(i + 1) == 0x81 && byte(i + 2) >= 0xa6 && byte(i + 2) <= 0xa9));
    promise(!is_c0 && !is_c1 && !turns, "a line has no control character: " + line);
  }
}

}  // namespace causticl
