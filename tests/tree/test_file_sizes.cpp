// One concept a file: at most 300 lines.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include "catch2.hpp"

namespace {

constexpr int most_lines = 300;

/// Files that are longer, and why.
const std::map<std::string, std::string> exceptions{
    {"tests/cli/test_report.cpp", "one report, key by key"},
    {"tests/kernels/test_medium.cpp", "one oracle for all that a medium does"},
    {"tests/kernels/test_light.cpp", "one table of lights"},
    {"tests/kernels/test_kernel_area.cpp", "one oracle of covered area"},
    {"tests/kernels/test_gather.cpp", "one brute-force oracle"},
    {"tests/kernels/test_metropolis_photons.cpp", "one scene, stage by stage"},
    {"tests/kernels/test_bsdf.cpp", "one table of materials"},
    {"tests/scene/test_image.cpp", "one table of formats"},
    {"host/selftest/slabs.cpp", "one check with its oracle"},
};

}  // namespace

TEST_CASE("no file is longer than 300 lines but for those with a reason") {
  namespace fs = std::filesystem;
  const fs::path root = CAUSTICL_SOURCE_DIR;
  for (const std::string tree : {"host", "cl", "tests", "scripts", "cmake"})
    for (const auto& entry : fs::recursive_directory_iterator(root / tree)) {
      const std::string extension = entry.path().extension().string(),
                        file = fs::relative(entry.path(), root).string();
      if (!entry.is_regular_file() || file.find("/corpus/") != file.npos || extension == ".patch" ||
          extension == ".pyc")
        continue;
      std::ifstream text(entry.path(), std::ios::binary);
      const auto lines = std::count(std::istreambuf_iterator<char>(text), {}, '\n');
      INFO(file << " has " << lines << " lines");
      if (exceptions.count(file))
        CHECK(lines > most_lines);  // else it is no exception any more
      else
        CHECK(lines <= most_lines);
    }
}
