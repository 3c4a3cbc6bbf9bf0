// What may reach a terminal of texts that come from files.
#include "catch2.hpp"

#include "base/printable.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

TEST_CASE("control characters of every kind become question marks, and nothing else does") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"plain text, caf\u00e9, \u5149, \U0001f4a1", "plain text, caf\u00e9, \u5149, \U0001f4a1"},
      {"\033]0;pwned\a", "?]0;pwned?"},
      {"\033[31mX", "?[31mX"},
      {std::string("a\0b", 3), "a?b"},
      {"a\tb\rc\bd\x7f", "a?b?c?d?"},
      {"\u0080\u009b31m\u009f\u00a0", "??31m?\u00a0"},  // C1 as UTF-8
      {"\x9b"
       "31m",
       "?31m"},                                                   // C1 as a byte
      {"gpj.\u202eexe\u2066\u2069\u200f\u061c", "gpj.?exe????"},  // direction
      {"a\u2028b\u2029c", "a?b?c"},                               // lines and paragraphs
      {"\xc3(", "?("},                                            // cut short
      {"\xc0\x9b[31m", "??[31m"},                                 // an escape in too many bytes
      {"\xe0\x82\x9b", "???"},                                    // C1 in too many bytes
      {"\xed\xa0\x80", "???"},                                    // half of a surrogate pair
      {"\xf4\x90\x80\x80", "????"},                               // beyond Unicode
      {"end \xe2\x80", "end ??"},
      {"\U000e0041", "?"},
  };
  for (const auto& [text, expected] : cases) {
    CAPTURE(expected);
    CHECK(printable_line(text) == expected);
    CHECK(has_control_characters(text) == (text != expected));
  }
  CHECK(printable("two\nlines\n") == "two\nlines\n");
  CHECK(printable_line("two\nlines") == "two?lines");
}

TEST_CASE("random bytes never leave a control character") {
  RandomInputs random(95);
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (int i = 0; i < 40; ++i) text += static_cast<char>(random.engine() % 256);
    const std::string clean = printable_line(text);
    CAPTURE(random.seed, round);
    REQUIRE_FALSE(has_control_characters(clean));
    REQUIRE(printable_line(clean) == clean);
    for (const char c : clean) REQUIRE((static_cast<unsigned char>(c) >= 0x20 && c != 0x7f));
  }
}

TEST_CASE("long words lose their middle and long lines their end, between characters") {
  const std::string word = std::string(5000, 'a') + ".png";
  const std::string cut = printable_line("open " + word + " now");
  CHECK(cut.size() < 1000);
  CHECK(cut.starts_with("open aaa"));
  CHECK(cut.ends_with("aaa.png now"));
  CHECK(cut.find("...") != std::string::npos);
  std::string light;
  for (int i = 0; i < 3000; ++i) light += "\u5149";
  CHECK_FALSE(has_control_characters(printable_line(light)));
  CHECK_FALSE(has_control_characters(printable_line("x" + light)));
  std::string line;
  for (int i = 0; i < 100000; ++i) line += "word ";
  CHECK(printable_line(line).size() <= 8000);
  CHECK(printable(line + "\nnext").ends_with("...\nnext"));
}
