// What the documents point to is there, and the scenes that they show load and keep to the JSON Schema.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "catch2.hpp"
#include "format/load_scene.hpp"
#include "process.hpp"
#include "scene/schema_examples.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
namespace fs = std::filesystem;

namespace {

const fs::path root = CAUSTICL_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<fs::path> documents() {
  std::vector<fs::path> result{root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") result.push_back(entry.path());
  return result;
}

/// The texts between ```KIND and ``` of a document.
std::vector<std::string> blocks(const std::string& text, const std::string& kind) {
  std::vector<std::string> result;
  const std::string begin = "```" + kind + "\n";
  for (auto at = text.find(begin); at != text.npos; at = text.find(begin, at + 1)) {
    const auto from = at + begin.size();
    result.push_back(text.substr(from, text.find("```", from) - from));
  }
  return result;
}

/// An example of the scene format as a whole scene. It is one already, or objects, or a key: of a scene, an
/// object or a material.
nlohmann::ordered_json whole_scene(const std::string& example) {
  auto scene = parse_scene(R"({"camera": {"position": [0, 1, 5], "target": [0, 0, 0], "fov": 40}})");
  if (example[0] == '"') {
    auto sphere = parse_scene(R"({"type": "sphere", "radius": 1, "material": {"type": "diffuse"}})");
    const auto key = parse_scene("{" + example + "}");
    (key.contains("transform") ? sphere : key.contains("color") ? sphere["material"] : scene).update(key);
    scene["objects"].push_back(sphere);
    return scene;
  }
  std::string list = "[" + example + "]";
  for (std::size_t at; (at = list.find("}\n{")) != list.npos;) list.insert(at + 1, ",");
  const auto parts = parse_scene(list);
  if (parts[0].contains("camera")) return parts[0];
  for (const char* name : {"glass", "floor", "glow", "mirror", "wood", "gold"})
    scene["materials"][name] = {{"type", "mirror"}};
  scene["objects"] = parts;
  return scene;
}

}  // namespace

TEST_CASE("docs/scene.schema.json is what `causticl schema` prints") {
  const Finished run = run_causticl({"schema"}, root);
  CHECK(run.exit_code == 0);
  INFO("regenerate it: build/causticl schema > docs/scene.schema.json");
  CHECK((run.output == text_of(root / "docs/scene.schema.json")));
}

TEST_CASE("every example of the scene format loads and keeps to the JSON Schema") {
  const TemporaryFolder folder;
  folder.write("queen.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  fs::copy(root / "scenes/assets/maple_srgb.jpg", folder.path("wood.jpg"));
  fs::copy(root / "scenes/assets/maple_srgb.jpg", folder.path("painting.png"));
  fs::copy(root / "scenes/assets/maple_srgb.jpg", folder.path("sky.hdr"));  // the contents decide
  auto scenes = nlohmann::ordered_json::array();
  for (const std::string& example : blocks(text_of(root / "docs/scene-format.md"), "json")) {
    scenes.push_back(whole_scene(example));
    INFO(scenes.back());
    CHECK(user_error_of([&] { load_scene(folder.write("scene.json", scenes.back().dump())); }) == "");
  }
  CHECK(scenes.size() >= 11);
  const auto verdicts = schema_verdicts(scenes);
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    INFO(scenes[i]);
    CHECK(verdicts[i] == "ok");
  }
}

TEST_CASE("the scene format names every key of the tables") {
  const std::string page = text_of(root / "docs/scene-format.md");
  for (const auto& [name, table] : all_tables())
    for (const SceneKey& key : table->keys)
      for (const char* word : {key.name, key.alias}) {
        INFO(name << ": " << (word ? word : ""));
        CHECK((!word || page.find("`" + std::string(word) + "`") != page.npos));
      }
}

TEST_CASE("every file that a document links to, and every script that it names, exists") {
  const std::regex link(R"(\]\(([^)#]+)[^)]*\))"), script(R"((scripts/[a-z_]+\.(sh|py)))");
  int links = 0;
  for (const fs::path& document : documents()) {
    const std::string text = text_of(document);
    for (const auto& pattern : {link, script})
      for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
        const std::string target = (*match)[1];
        if (target.rfind("http", 0) == 0) continue;
        INFO(document << ": " << target);
        CHECK(fs::exists((target.rfind("scripts/", 0) == 0 ? root : document.parent_path()) / target));
        ++links;
      }
  }
  CHECK(links > 60);
}

TEST_CASE("every source file that a document names exists") {
  const std::regex source(R"(`((?:host|cl|tests)/[a-z0-9_/]+\.(?:cpp|hpp|cl|h))`)");
  int names = 0;
  // The log and the changes name files of earlier versions.
  for (const fs::path& document : documents()) {
    if (document.filename() == "performance-log.md" || document.filename() == "CHANGELOG.md") continue;
    const std::string text = text_of(document);
    for (std::sregex_iterator match(text.begin(), text.end(), source), end; match != end; ++match, ++names) {
      INFO(document << ": " << (*match)[1]);
      CHECK(fs::exists(root / (*match)[1].str()));
    }
  }
  CHECK(names > 20);
}

TEST_CASE("the scenes of README and of getting-started load and keep to the JSON Schema") {
  const TemporaryFolder folder;
  const std::string tutorial = text_of(root / "docs/getting-started.md");
  for (const auto& mesh : blocks(tutorial, "obj")) folder.write("pyramid.obj", mesh);
  fs::copy(root / "scenes/assets/maple_srgb.jpg", folder.path("wood.jpg"));
  auto scenes = nlohmann::ordered_json::array();
  for (const std::string& text : {text_of(root / "README.md"), tutorial})
    for (const auto& scene : blocks(text, "json")) {
      if (scene.find("\"camera\"") == scene.npos) continue;
      INFO(scene);
      CHECK_NOTHROW(load_scene(folder.write("scene.json", scene)));
      scenes.push_back(parse_scene(scene));
    }
  CHECK(scenes.size() >= 4);
  for (const std::string& verdict : schema_verdicts(scenes)) CHECK(verdict == "ok");
}
