// Every hard case on this machine's device: the checks of `causticl selftest`, at 10^6 inputs each in CI and
// at 10^8 in the opt-in run.
#include <set>

#include "device_fixture.hpp"
#include "selftest.hpp"
#include "stability_checks.hpp"

using namespace causticl;

namespace {

void check_all(SelftestOptions::Effort effort) {
  SelftestOptions options;
  options.effort = effort;
  std::printf("%s", selftest_heading(test_device().info(), options).c_str());
  run_selftest(test_device(), stability_checks(), options, [](const SelftestRow& row) {
    std::printf("%s", selftest_line(row).c_str());
    std::fflush(stdout);
    INFO(row.check.name << "; replay: " << row.result.example);
    CHECK(row.result.failures == 0);
    CHECK(row.result.skipped == "");
    CHECK(row.result.inputs > 0);
  });
}

}  // namespace

TEST_CASE("every hard case has a check") {
  std::set<int> numbers;
  std::set<std::string> names;
  for (const auto& check : stability_checks()) {
    numbers.insert(check.hard_case);
    CHECK(names.insert(check.name).second);
    CHECK(check.input_cost > 0);
  }
  CHECK(numbers.size() == hard_case_count);
}

TEST_CASE("hard cases at 10^6 inputs a check") { check_all(SelftestOptions::Effort::normal); }

TEST_CASE("hard cases at 10^8 inputs a check", "[long]") { check_all(SelftestOptions::Effort::full); }
