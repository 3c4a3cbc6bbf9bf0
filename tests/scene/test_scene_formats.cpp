// Which reader a scene file gets, and what is said where none fits.
#include "base/source_location.hpp"
#include "catch2.hpp"
#include "format/scene_formats.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

/// A format of one line, "LIST WIDTH HEIGHT"; its reader tells the line of a fault.
Scene load_list(const std::string& file, const SceneOptions&) {
  Scene scene;
  scene.file = file;
  std::ifstream in(file);
  std::string word;
  if (!(in >> word >> scene.width >> scene.height))
    SourceLocation{file, 1, "LIST"}.fail("expected a width and a height");
  return scene;
}

std::vector<SceneFormat> with_list() {
  std::vector<SceneFormat> formats = scene_formats();
  formats.push_back({"a list",
                     {".list", ".lst"},
                     [](const std::string& beginning) { return beginning.starts_with("LIST"); },
                     load_list});
  return formats;
}

std::string format_of(const std::string& file) { return scene_format_of(file, with_list()).name; }

}  // namespace

TEST_CASE("a format is found by extension, in any case, whatever the contents are") {
  const TemporaryFolder folder;
  CHECK(format_of(folder.write("a.json", "LIST")) == "CaustiCL JSON");
  CHECK(format_of(folder.write("a.JSON", "\x89PNG")) == "CaustiCL JSON");
  CHECK(format_of(folder.write("a.list", "{}")) == "a list");
  CHECK(format_of(folder.write("a.Lst", "")) == "a list");
  CHECK(format_of(folder.path("nowhere.list")) == "a list");
}

TEST_CASE("where the extension tells no format the contents do") {
  const TemporaryFolder folder;
  for (const char* text : {"{}", "\xef\xbb\xbf {", "// a\n{", "\r\n\t/* a */ {", "[1]", "", " \n"})
    CHECK(format_of(folder.write("scene", text)) == "CaustiCL JSON");
  CHECK(format_of(folder.write("scene.txt", "LIST 1 2")) == "a list");
  CHECK(format_of(folder.path("")) == "CaustiCL JSON");  // whose reader says that it is a folder
  CHECK(format_of("/dev/null") == "CaustiCL JSON");
}

TEST_CASE("one extension of several formats is told apart by the contents") {
  const TemporaryFolder folder;
  auto formats = with_list();
  formats.back().extensions.emplace_back(".json");
  CHECK(scene_format_of(folder.write("a.json", "LIST 1 2"), formats).name == std::string("a list"));
  CHECK(scene_format_of(folder.write("b.json", "{}"), formats).name == std::string("CaustiCL JSON"));
}

TEST_CASE("a file of no known format gets one line that names those there are") {
  const TemporaryFolder folder;
  const std::string file = folder.write("model.blend", "BLENDER-v293");
  CHECK(user_error_of([&] { scene_format_of(file, with_list()); }, file) ==
        "model.blend: is no scene of a known format; expected CaustiCL JSON (.json) or a list (.list, .lst)");
  CHECK(user_error_of([&] { load_scene(file); }, file) ==
        "model.blend: is no scene of a known format; expected CaustiCL JSON (.json)");
}

TEST_CASE("a reader of its own makes a scene, and its errors tell the place") {
  const TemporaryFolder folder;
  const std::string good = folder.write("a.list", "LIST 20 10"), bad = folder.write("b.list", "LIST 20");
  CHECK(scene_format_of(good, with_list()).load(good, {}).width == 20);
  CHECK(user_error_of([&] { scene_format_of(bad, with_list()).load(bad, {}); }, bad) ==
        "b.list:1: LIST: expected a width and a height");
}
