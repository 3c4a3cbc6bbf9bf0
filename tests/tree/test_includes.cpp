// Includes go one way: from higher rooms of the tree to lower ones.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch2.hpp"
#include "tree/rooms.hpp"

using namespace causticl;
namespace fs = std::filesystem;

namespace {

const fs::path root = CAUSTICL_SOURCE_DIR;

/// "file:line: fault" for each include of a text that the rooms do not allow.
std::vector<std::string> faults_in(const std::string& tree, const std::string& file, std::istream& text) {
  std::vector<std::string> diagnostics;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.rfind("#include \"", 0) != 0) continue;
    const std::string included = line.substr(10, line.rfind('"') - 10);
    if (const auto fault = fault_of_include(tree, file, included))
      diagnostics.push_back(tree + "/" + file + ":" + std::to_string(number) + ": " + *fault);
  }
  return diagnostics;
}

}  // namespace

TEST_CASE("no include goes up") {
  int files = 0;
  for (const std::string tree : {"host", "cl"})
    for (const auto& entry : fs::recursive_directory_iterator(root / tree)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() ||
          !(extension == ".cpp" || extension == ".hpp" || extension == ".cl" || extension == ".h"))
        continue;
      std::ifstream text(entry.path());
      for (const auto& fault : faults_in(tree, fs::relative(entry.path(), root / tree).string(), text))
        FAIL_CHECK(fault);
      ++files;
    }
  CHECK(files > 250);
}

TEST_CASE("an include that goes up is told with its file, its line and the rule") {
  const auto diagnostics = [](const std::string& tree, const std::string& file, const std::string& line) {
    std::istringstream text("// A comment.\n#include \"" + line + "\"\n");
    return faults_in(tree, file, text);
  };
  CHECK(diagnostics("host", "scene/scene.hpp", "base/error.hpp").empty());
  CHECK(diagnostics("host", "opencl/kernels.cpp", "shared/effects.h").empty());
  CHECK(diagnostics("host", "scene/scene.hpp", "render/render.hpp") ==
        std::vector<std::string>{"host/scene/scene.hpp:2: host/scene may not include host/render"});
  CHECK(diagnostics("cl", "materials/bsdf.cl", "photons/grid.cl") ==
        std::vector<std::string>{
            "cl/materials/bsdf.cl:2: cl/materials may not include cl/photons, which lies above it"});
  CHECK(diagnostics("host", "study/study.cpp", "app/options.hpp").size() == 1);
  CHECK(diagnostics("host", "study/study.cpp", "study.hpp").size() == 1);
}

TEST_CASE("every file stands in a room") {
  for (const auto& entry : fs::directory_iterator(root / "host")) {
    INFO(entry.path().filename());
    CHECK((entry.is_directory() ? host_rooms().count(entry.path().filename().string()) == 1
                                : entry.path().filename() == "main.cpp"));
  }
  for (const auto& entry : fs::directory_iterator(root / "cl")) {
    INFO(entry.path().filename());
    CHECK(std::count(kernel_rooms.begin(), kernel_rooms.end(), entry.path().filename().string()) == 1);
  }
}
