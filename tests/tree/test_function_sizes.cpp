// Functions that read as the algorithm: at most 80 lines, at most eight parameters.
#include <filesystem>
#include <fstream>
#include <map>

#include "catch2.hpp"
#include "tree/functions.hpp"

using namespace causticl;

namespace {

constexpr int most_lines = 80, most_parameters = 8;

/// Functions that are allowed more, and why.
const std::map<std::string, std::string>& exceptions() {
  static const std::map<std::string, std::string> reasons{
      {"gather_photons", "a kernel: OpenCL C 1.2 passes no structure that holds buffers"},
      {"trace_photons", "a kernel, as gather_photons"},
      {"study_parameters", "a table, a row for each parameter"}};
  return reasons;
}

}  // namespace

TEST_CASE("functions, their lines and their parameters are found in a text") {
  const auto found = functions_of(R"code(#include <x>
#define MACRO(a, b) \
  { a(b); }
// comment with { and (
namespace n {
struct S {
  int member(const std::map<int, int>& a, char b) const { return '{'; }
};
}
constexpr int list[] = {1, 2};
kernel void two(
    SCENE_PARAMETERS, uint b) {
  if (b) { call(")");
}
}
static real none(void) { return 0; }
)code");
  REQUIRE(found.size() == 3);
  CHECK(found[0].name == "member");
  CHECK(found[0].parameters == 2);
  CHECK(found[0].lines == 1);
  CHECK(found[1].name == "two");
  CHECK(found[1].line == 11);
  CHECK(found[1].lines == 5);
  CHECK(found[1].parameters == 2);
  CHECK(found[2].name == "none");
  CHECK(found[2].parameters == 0);
}

TEST_CASE("no function has more than 80 lines or eight parameters") {
  namespace fs = std::filesystem;
  const fs::path root = CAUSTICL_SOURCE_DIR;
  std::map<std::string, int> excepted;
  for (const std::string tree : {"host", "cl"})
    for (const auto& entry : fs::recursive_directory_iterator(root / tree)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".cl") continue;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      for (const auto& [name, line, lines, parameters] : functions_of(text)) {
        if (lines <= most_lines && parameters <= most_parameters) continue;
        if (exceptions().count(name)) {
          ++excepted[name];
          continue;
        }
        INFO(fs::relative(entry.path(), root).string() << ":" << line << ": " << name << " has " << lines
                                                       << " lines and " << parameters << " parameters");
        CHECK(lines <= most_lines);
        CHECK(parameters <= most_parameters);
      }
    }
  for (const auto& [name, reason] : exceptions()) {
    INFO(name << " is no exception any more");
    CHECK(excepted[name] > 0);
  }
}
