// Includes go one way: from higher rooms of the tree to lower ones.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tree/rooms.hpp"

using namespace causticl;
namespace fs = std::filesystem;

namespace {

const fs::path root = CAUSTICL_SOURCE_DIR;

/// "file:line: fault" for each include of a text that the rooms do not allow.
std::vector<std::string> faults_in(const std::string& tree, const std::string& file, std::istream& text) {
  std::vector<std::string> faults;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.rfind("#include \"", 0) != 0) continue;
    const std::string included = line.substr(10, line.rfind('"') - 10);
    if (const auto fault = fault_of_include(tree, file, included))
      faults.push_back(tree + "/" + file + ":" + std::to_string(number) + ": " + *fault);
  }
  return faults;
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
  const auto faults = [](const std::string& tree, const std::string& file, const std::string& line) {
    std::istringstream text("// A comment.\n#include \"" + line + "\"\n");
    return faults_in(tree, file, text);
  };
  CHECK(faults("host", "scene/scene.hpp", "base/error.hpp").empty());
  CHECK(faults("host", "opencl/kernels.cpp", "shared/effects.h").empty());
  CHECK(faults("host", "scene/scene.hpp", "render/render.hpp") ==
        std::vector<std::string>{"host/scene/scene.hpp:2: host/scene may not include host/render"});
  CHECK(faults("cl", "materials/bsdf.cl", "photons/grid.cl") ==
        std::vector<std::string>{
            "cl/materials/bsdf.cl:2: cl/materials may not include cl/photons, which lies above it"});
  CHECK(faults("host", "study/study.cpp", "app/options.hpp").size() == 1);
  CHECK(faults("host", "study/study.cpp", "study.hpp").size() == 1);
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
