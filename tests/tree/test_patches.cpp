// The patches that put naive methods into copies of the kernels still fit the kernels.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "catch2.hpp"

namespace fs = std::filesystem;

namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const fs::path& file) {
  std::ifstream stream(file);
  Lines lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What a patch finds in each file that it changes: the lines of every hunk that it keeps or takes out.
std::multimap<std::string, Lines> hunks_of(const fs::path& patch) {
  std::multimap<std::string, Lines> hunks;
  std::string file;
  Lines hunk;
  const auto end_hunk = [&] {
    if (!hunk.empty()) hunks.emplace(file, hunk);
    hunk.clear();
  };
  std::size_t left = 0;  // lines of the hunk
  for (const std::string& line : lines_of(patch)) {
    if (left == 0 && line.starts_with("--- ")) {
      file = line.substr(line.find('/') + 1);
    } else if (line.starts_with("@@")) {
      // "@@ -FIRST,LINES +FIRST,LINES @@"
      const std::string old = line.substr(0, line.find('+'));
      left = old.find(',') == std::string::npos ? 1 : std::stoul(old.substr(old.find(',') + 1));
    } else if (left > 0 && (line.empty() || line[0] == ' ' || line[0] == '-')) {
      hunk.push_back(line.empty() ? "" : line.substr(1));
      if (--left == 0) end_hunk();
    }
  }
  return hunks;
}

}  // namespace

TEST_CASE("every patch of mutations and of the benchmark fits the kernels") {
  std::size_t patches = 0;
  for (const char* folder : {"/tests/stability/mutations", "/tests/bench"})
    for (const auto& entry : fs::directory_iterator(std::string(CAUSTICL_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".patch") continue;
      ++patches;
      INFO(entry.path().filename());
      const auto hunks = hunks_of(entry.path());
      CHECK(!hunks.empty());
      for (const auto& [file, hunk] : hunks) {
        INFO(file << ": there is no \"" << hunk.front() << "\" with what follows");
        const Lines lines = lines_of(fs::path(CAUSTICL_SOURCE_DIR) / file);
        CHECK(std::search(lines.begin(), lines.end(), hunk.begin(), hunk.end()) != lines.end());
      }
    }
  CHECK(patches > 80);
}
