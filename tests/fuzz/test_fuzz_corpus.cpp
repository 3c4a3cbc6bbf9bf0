// Every file that the fuzzers begin from, read by the fuzzers' own functions.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "catch2.hpp"
#include "fuzz_input.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(CAUSTICL_SOURCE_DIR) / "tests/fuzz";

}  // namespace

TEST_CASE("every file of the fuzz corpus keeps the promises of its reader") {
  for (const FuzzTarget& target : fuzz_targets()) {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder / "corpus" / target.name)) {
      INFO(entry.path().string());
      CHECK_NOTHROW(target.run(bytes_of(entry.path())));
      ++files;
    }
    INFO(target.name);
    CHECK(files >= 3);
  }
}

TEST_CASE("the fuzz corpus is small, and every folder of it has a target") {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "corpus"))
    if (entry.is_regular_file()) bytes += entry.file_size();
  CHECK(bytes < 300'000);
  for (const auto& entry : fs::directory_iterator(folder / "corpus"))
    CHECK_NOTHROW(fuzz_target(entry.path().filename().string()));
}

TEST_CASE("the fuzz targets refuse messages that a terminal would obey") {
  CHECK_NOTHROW(promise_one_line("scene.json:3: expected a number"));
  CHECK_THROWS_AS(promise_one_line(""), BrokenPromise);
  CHECK_THROWS_AS(promise_one_line("two\nlines"), BrokenPromise);
  CHECK_NOTHROW(promise_one_line("\x1b[31m"));  // what prints it cleans it
  CHECK_THROWS_AS(promise_for_terminal("\x1b[31m"), BrokenPromise);
  CHECK_THROWS_AS(promise_for_terminal("\xc2\x9b"), BrokenPromise);
  CHECK_THROWS_AS(promise_for_terminal("\xe2\x80\xae"), BrokenPromise);
  CHECK_THROWS_AS(promise_for_terminal(std::string(10'000, 'a')), BrokenPromise);
}

}  // namespace causticl
