// `causticl selftest` as a user meets it: the table, the JSON, exit codes, replaying a failure.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "catch2.hpp"
#include "process.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;
using Catch::StartsWith;

namespace {

Finished selftest(const TemporaryFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "selftest");
  if (const char* device = std::getenv("CAUSTICL_DEVICE")) words.insert(words.end(), {"--device", device});
  return run_causticl(words, folder.path(""));
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A copy of cl/ in which `from` has become `to` in one file.
std::string mutated_kernels(const TemporaryFolder& folder, const std::string& file, const std::string& from,
                            const std::string& to) {
  const std::string copy = folder.path("cl");
  std::filesystem::copy(CAUSTICL_SOURCE_DIR "/cl", copy, std::filesystem::copy_options::recursive);
  std::string text = text_of(copy + "/" + file);
  const auto at = text.find(from);
  REQUIRE(at != text.npos);
  std::ofstream(copy + "/" + file) << text.replace(at, from.size(), to);
  return copy;
}

}  // namespace

TEST_CASE("selftest prints a row for each check and writes the same as JSON") {
  const TemporaryFolder folder;
  const auto run =
      selftest(folder, {"--case", "24", "--inputs", "1000", "--seed", "7", "--json", "report.json"});
  CAPTURE(run.output, run.errors);
  CHECK(run.exit_code == 0);
  CHECK(run.errors.empty());
  CHECK_THAT(run.output, Contains("seed 7") && Contains("fma rounds once") && Contains("ok (ulp)"));
  const auto report = nlohmann::json::parse(text_of(folder.path("report.json")));
  CHECK(report["passed"] == true);
  CHECK(report["seed"] == 7);
  REQUIRE(report["checks"].size() >= 6);
  for (const auto& check : report["checks"]) {
    CHECK(check["case"] == 24);
    CHECK(check["failures"] == 0);
    CHECK(check["verdict"] == "ok");
    CHECK_THAT(run.output, Contains(check["check"].get<std::string>()));
  }
}

TEST_CASE("several processes find what one finds, in the same order") {
  const TemporaryFolder folder;
  // Files of checks, which are divided among the processes; a number of threads asks for one process.
  std::vector<nlohmann::json> reports;
  for (const bool alone : {false, true}) {
    std::vector<std::string> words{"--inputs", "2000", "--seed", "3",       "--json", "report.json",
                                   "--case",   "1",    "--case", "12",      "--case", "16",
                                   "--case",   "21",   "--case", "division"};
    if (alone) words.insert(words.end(), {"--threads", "1"});
    const auto run = selftest(folder, words);
    CAPTURE(run.output, run.errors);
    CHECK(run.exit_code == 0);
    reports.push_back(nlohmann::json::parse(text_of(folder.path("report.json"))));
    for (auto& check : reports.back()["checks"]) check.erase("seconds");
  }
  CHECK(reports[0]["checks"].size() >= 10);
  CHECK(reports[0]["checks"] == reports[1]["checks"]);
}

TEST_CASE("a check that fails is named, with exit code 3 and an input that fails again") {
  const TemporaryFolder folder;
  const std::string kernels = mutated_kernels(folder, "core/prelude.cl", "FP_CONTRACT OFF", "FP_CONTRACT ON");
  const std::vector<std::string> one{"--case", "products and sums", "--kernel-dir", kernels};
  auto words = one;
  words.insert(words.end(), {"--inputs", "1000"});
  const auto run = selftest(folder, words);
  CAPTURE(run.output, run.errors);
  if (run.exit_code == 0) return;  // a device without a fused operation has nothing to contract
  CHECK(run.exit_code == 3);
  CHECK_THAT(run.output, Contains("FAILED") && Contains("hard case 24 (arithmetic of the device)"));
  const auto at = run.output.find("--replay=");
  REQUIRE(at != run.output.npos);
  words = one;
  words.push_back(run.output.substr(at, run.output.find('\n', at) - at));
  const auto again = selftest(folder, words);
  CAPTURE(again.output, again.errors);
  CHECK(again.exit_code == 3);
  CHECK_THAT(again.output, Contains("          1         1"));
}

TEST_CASE("what selftest cannot do gets one line and exit code 2") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--case", "99"}, "--case 99: no such check; expected a number from 1 to 27"},
      {{"--case", "no check has this name"}, "no such check"},
      {{"--case", "24", "--replay", "1"}, "expected --case with the name of the one check"},
      {{"--case", "square root", "--replay", "1,2"},
       "expected the 1 numbers of an input of this check, found 2"},
      {{"--case", "square root", "--replay", "one"}, "expected numbers separated by commas"},
      {{"--case", "denormals", "--replay", "1"}, "has no inputs to replay"},
      {{"--quick", "--full"}, "--quick"},
      {{"--inputs", "0"}, "expected a whole number from 1"},
      {{"--json", "no/such/folder.json", "--case", "24"}, "no/such"},
      {{"--seed", "-1"}, "expected a whole number from 0"}};
  for (const auto& [words, part] : cases) {
    const auto run = selftest(folder, words);
    CAPTURE(part, run.output, run.errors);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.errors, StartsWith("causticl: error: ") && Contains(part));
    CHECK(std::count(run.errors.begin(), run.errors.end(), '\n') == 1);
  }
}
