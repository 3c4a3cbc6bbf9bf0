// Nothing that a file holds or is called reaches the terminal as a control character.
#include "catch2.hpp"

#include "base/printable.hpp"
#include "image/image.hpp"
#include "small_render.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

const std::string escape = "\033]0;pwned\a\033[31mX";

std::string scene_of(const std::string& keys, const std::string& objects) {
  return "{" + keys + R"( "camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 40}, "objects": [)" +
         objects + "]}";
}

/// The file of a grey picture whose channels are called by control characters in place of R, G and B.
std::string exr_with_odd_channels(const TemporaryFolder& folder) {
  write_picture(folder.path("grey.exr"), {4, 2, std::vector<float>(24, 0.5f)}, {});
  std::string bytes = bytes_of(folder.path("grey.exr"));
  std::size_t at = bytes.find(std::string("chlist\0", 7)) + 7 + 4;
  for (const char name : {'\x07', '\x1b', '\x7f'}) {
    bytes[at] = name;
    at += 2 + 16;
  }
  return folder.write("odd.exr", bytes);
}

/// Runs it and looks at every byte that it printed: of a terminal, only what the bar itself needs is left
/// over.
Finished run_clean(const Words& words, const TemporaryFolder& folder) {
  const Finished run = run_causticl(words, folder.path(""), no_device);
  for (std::string text : {run.output, run.errors}) {
    CAPTURE(words);
    std::erase(text, '\n');
    CHECK_FALSE(has_control_characters(text));
  }
  return run;
}

}  // namespace

TEST_CASE("escapes in scenes, in names of files and in channels are harmless in every message") {
  const TemporaryFolder folder;
  const std::string sphere = R"({"type": "sphere", "radius": 1, "material": {"type": "diffuse"}})";
  const std::string json_escape = "\\u001b]0;pwned\\u0007\\u001b[31mX\\u202e\\u009b\\u2028";
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("ok.obj", mesh);
  folder.write("a" + escape + ".obj", mesh);
  folder.write("b" + escape + ".obj", "v 0 0 0\nv " + escape + " 0 0\n");
  exr_with_odd_channels(folder);
  const std::vector<std::string> scenes{
      scene_of("\"" + json_escape + "\": 1,", sphere),
      scene_of("", R"({"type": ")" + json_escape + "\"}"),
      scene_of("", R"({"type": "sphere", "radius": 1, "material": ")" + json_escape + "\"}"),
      scene_of("\"materials\": {\"" + json_escape + R"(": {"type": "diffuse", "emission": 1}},)",
               R"({"type": "sphere", "radius": 1, "material": ")" + json_escape + "\"}"),
      scene_of("\"materials\": {\"a\\nnote x\": {\"type\": \"glass\"}},",
               R"({"type": "sphere", "radius": 1, "material": "a\nnote x"})"),
      scene_of("", R"({"type": "mesh", "material": {"type": "mirror"}, "path": "a)" +
                       std::string("\\u001b]0;pwned\\u0007\\u001b[31mX") + ".obj\"}"),
      scene_of("", R"({"type": "mesh", "material": {"type": "mirror"}, "path": "b)" +
                       std::string("\\u001b]0;pwned\\u0007\\u001b[31mX") + ".obj\"}"),
      scene_of("", R"({"type": "mesh", "material": {"type": "mirror"}, "path": "missing)" + json_escape +
                       ".obj\"}"),
      scene_of(
          "",
          R"({"type": "box", "material": {"type": "diffuse", "color": {"type": "image", "path": "odd.exr"}}})"),
      "{\"path\": \"" + escape + "\"}",
      "{" + escape + "}",
      "\x9b\xff\xfe",
      escape};
  for (const auto& text : scenes)
    for (const char* command : {"info", "explain", "render"}) {
      CAPTURE(text);
      run_clean({command, folder.write("scene.json", text)}, folder);
      run_clean({command, folder.write("s" + escape + "\xff.json", text)}, folder);
    }
  CHECK_THAT(run_clean({"info", folder.write("scene.json", scenes[8])}, folder).errors,
             Contains("nor one layer of them, but: '?' '?' '?'"));
  for (const Words& words :
       {Words{escape}, Words{"render", "a.json", "--" + escape}, Words{"render", "a.json", "-D", escape},
        Words{"compare", escape + ".exr", "b"}, Words{"compare", "odd.exr", "odd.exr"},
        Words{"info", cornell_box, "-D", "a" + escape + "=1"},
        Words{"info", cornell_box, "-D", "path=" + escape + ".png"},
        Words{"study", escape + ".json", "-o", escape}, Words{"selftest", "--case", escape},
        Words{"explain", cornell_box, "--json", "no/" + escape}})
    CHECK(run_clean(words, folder).exit_code >= 2);
}

TEST_CASE("a table keeps its lines whatever names hold") {
  const TemporaryFolder folder;
  folder.write("a\nnote        all is well.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string scene = folder.write(
      "scene.json",
      scene_of(
          "",
          R"({"type": "mesh", "path": "a\nnote        all is well.obj", "material": {"type": "diffuse", "emission": 1}})"));
  const Finished info = run_causticl({"info", scene}, folder.path(""), no_device);
  CHECK(info.exit_code == 0);
  CHECK_THAT(info.output, Contains("a?note        all is well.obj: 1 triangle") && !Contains("\nnote"));
}

TEST_CASE("long names are cut") {
  const TemporaryFolder folder;
  const Finished run = run_clean({"info", std::string(100000, 'x') + ".json"}, folder);
  CHECK(run.exit_code == 2);
  CHECK(run.errors.size() < 1200);
  const std::string scene =
      folder.write("scene.json", scene_of("\"" + std::string(100000, 'k') + "\": 1,", R"({"type": "box"})"));
  CHECK(run_clean({"info", scene}, folder).errors.size() < 1200);
}
