// The tree that keeps lines and pointers.
#include "catch2.hpp"

#include "format/json_reader.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {

std::string error_of(const std::string& text) {
  return user_error_of([&] { json_parse("t", text); });
}

}  // namespace

TEST_CASE("every value knows its line") {
  const JsonDocument document = json_parse("t", R"(// 1
{
  "a": 1,
  "b": [
    2
    ,
    3.5e0

    , "x", true, null], /* 9
  */ "c"
  :
  {
    "d": -7}
}
)");
  const JsonReader root(document);
  CHECK(root.value().line == 2);
  CHECK(root.at("a").value().line == 3);
  CHECK(root.at("b").value().line == 4);
  const auto items = root.at("b").items(6 - 1, 5, "values");
  CHECK(items[0].value().line == 5);
  CHECK(items[1].value().line == 7);
  CHECK(items[2].value().line == 9);
  CHECK(items[4].value().line == 9);
  CHECK(root.value().members[2].line == 10);
  CHECK(root.at("c").value().line == 12);
  CHECK(root.at("c").at("d").value().line == 13);
  CHECK(root.at("c").at("d").location().text() == "t:13: /c/d");
  CHECK(root.at("c").at("d").number() == -7);
}

TEST_CASE("a number read to the last character has its own line") {
  for (const char* text : {"[1,\n2", "[1,\n2\n", "[1,\n2]", "[1,\n2\n]", "[1,\n2 ]"}) {
    INFO(text);
    const std::string message = error_of(text);
    if (!message.empty()) CHECK(message.substr(0, 4) == "t:2:");
    if (message.empty()) CHECK(json_parse("t", text).root.items[1].line == 2);
  }
}

TEST_CASE("a byte order mark, carriage returns and comments are skipped") {
  CHECK(json_parse("t", "\xef\xbb\xbf{\"a\": 1}").root.member("a")->number == 1);
  CHECK(json_parse("t", "{\r\n\"a\":\r\n1 // one\r\n}\r\n").root.member("a")->line == 3);
}

TEST_CASE("pointers escape as RFC 6901 says") {
  const JsonDocument document = json_parse("t", R"({"a/b": {"c~d": [0, "x"]}})");
  const JsonReader item = JsonReader(document).at("a/b").at("c~d").items(2, 2, "values")[1];
  CHECK(item.pointer() == "/a~1b/c~0d/1");
  CHECK(user_error_of([&] { item.number(); }) ==
        "t:1: /a~1b/c~0d/1: expected a number from -1e12 to 1e12, got \"x\"");
}

TEST_CASE("integers may be written as floats without fraction") {
  const JsonDocument document = json_parse("t", R"([1e5, 12.0, -3, 2.5, 1e300])");
  const auto items = JsonReader(document).items(5, 5, "values");
  CHECK(items[0].integer(0, 1 << 20) == 100000);
  CHECK(items[1].integer(0, 20) == 12);
  CHECK(items[2].integer(-3, 0) == -3);
  CHECK_THROWS_AS(items[3].integer(0, 20), UserError);
  CHECK_THROWS_AS(items[4].integer(0, 20), UserError);
}

TEST_CASE("messages are one line of valid text whatever the input") {
  CHECK(one_line("a\nb\x01\x7f") == "a?b??");
  CHECK(one_line("caf\xe9 \xc3\xa9") == "caf\xef\xbf\xbd \xc3\xa9");
  CHECK(json_quote("a\"b\n") == "\"a\\\"b\\n\"");
  CHECK(json_quote("\xc3\xa9\xc3\xa9", 3) == "\"\xc3\xa9...\"");
  const std::string message = error_of("{\"a\": tr\xff\x02ue}");
  CHECK(message == "t:1: expected a value, got \"\xef\xbf\xbd\"");
  CHECK(error_of(std::string("{\"a\": 1}\0", 9)) == "t: expected a scene in JSON, got binary data");
}

TEST_CASE("the nearest key is suggested") {
  const std::vector<std::string> keys{"radius", "radius_decay", "rounds", "x"};
  CHECK(suggestion("raduis", keys) == "did you mean \"radius\"?");
  CHECK(suggestion("Rounds", keys) == "did you mean \"rounds\"?");
  CHECK(suggestion("radius_deca", keys) == "did you mean \"radius_decay\"?");
  CHECK(suggestion("y", keys) == "use one of \"radius\", \"radius_decay\", \"rounds\" or \"x\"");
  CHECK(suggestion(std::string(100000, 'r'), {"a", "b"}) == "use \"a\" or \"b\"");
}

TEST_CASE("options lay values over the file") {
  JsonDocument document = json_parse("t", R"({"a": {"b": 1}, "c": [1, {"d": 2}]})");
  json_override(document, "a.b", "2");
  json_override(document, "c.1.d", "[3, 4]");
  json_override(document, "c.0", "text that is not JSON");
  json_override(document, "new.key.deep", "true");
  json_override(document, "a.s", "\"1\"");
  const JsonReader root(document);
  CHECK(root.at("a").at("b").number() == 2);
  CHECK(root.at("a").at("b").location().text() == "-D a.b=2: /a/b");
  CHECK(root.at("a").at("s").string() == "1");
  const auto items = root.at("c").items(2, 2, "values");
  CHECK(items[0].string() == "text that is not JSON");
  CHECK(items[1].at("d").items(2, 2, "numbers")[1].number() == 4);
  CHECK(items[1].at("d").items(2, 2, "numbers")[1].location().text() == "-D c.1.d=[3, 4]: /c/1/d/1");
  CHECK(items[1].location().text() == "t:1: /c/1");
  CHECK(root.at("new").at("key").at("deep").boolean());
}

}  // namespace causticl
