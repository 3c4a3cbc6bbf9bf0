// One concept a file: at most 300 lines.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "catch2.hpp"

namespace {

constexpr int most_lines = 300;

}  // namespace

TEST_CASE("no file is longer than 300 lines") {
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
      CHECK(lines <= most_lines);
    }
}
