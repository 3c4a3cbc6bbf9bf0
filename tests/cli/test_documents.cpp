// What the documents point to is there, and the scenes that they show load.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "catch2.hpp"
#include "format/load_scene.hpp"
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

}  // namespace

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

TEST_CASE("the scenes of README and of getting-started load") {
  const TemporaryFolder folder;
  const std::string tutorial = text_of(root / "docs/getting-started.md");
  for (const auto& mesh : blocks(tutorial, "obj")) folder.write("pyramid.obj", mesh);
  fs::copy(root / "scenes/assets/maple_srgb.jpg", folder.path("wood.jpg"));
  int scenes = 0;
  for (const std::string& text : {text_of(root / "README.md"), tutorial})
    for (const auto& scene : blocks(text, "json")) {
      if (scene.find("\"camera\"") == scene.npos) continue;
      INFO(scene);
      CHECK_NOTHROW(load_scene(folder.write("scene.json", scene)));
      ++scenes;
    }
  CHECK(scenes >= 4);
}
