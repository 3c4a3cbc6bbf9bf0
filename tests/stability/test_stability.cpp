// Every hard case on this machine's device: the checks of `causticl selftest`, at 10^6 inputs each in CI and
// at 10^8 a case in the opt-in run.
#include <map>
#include <set>

#include "device_fixture.hpp"
#include "selftest/selftest.hpp"
#include "selftest/stability_checks.hpp"

using namespace causticl;

namespace {

// What takes longest, in parts that ctest runs beside the others.
const std::set<int> pictures{9, 14, 15, 20, 22}, searches{7, 10};

std::set<int> all_cases() {
  std::set<int> numbers;
  for (int number = 1; number <= hard_case_count; ++number) numbers.insert(number);
  return numbers;
}

std::set<int> other_cases() {
  std::set<int> numbers = all_cases();
  for (const auto& part : {pictures, searches})
    for (const int number : part) numbers.erase(number);
  return numbers;
}

void check_cases(const std::set<int>& hard_cases, SelftestOptions::Effort effort) {
  SelftestOptions options;
  options.effort = effort;
  for (const int hard_case : hard_cases) options.checks.push_back(std::to_string(hard_case));
  std::printf("%s", selftest_heading(test_device().info(), options).c_str());
  const auto checks = wanted_checks(stability_checks(), options);
  run_selftest(test_device(), checks, options, [](const SelftestRow& row) {
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
  std::map<int, double> fractions;
  for (const auto& check : stability_checks()) {
    numbers.insert(check.hard_case);
    CHECK(names.insert(check.name).second);
    CHECK(check.input_cost > 0);
    fractions[check.hard_case] += check.input_fraction;
  }
  for (const auto& [hard_case, sum] : fractions) CHECK(sum == Approx(1));
  CHECK(numbers == all_cases());
}

TEST_CASE("hard cases at 10^6 inputs a check: pictures", "[part:pictures]") {
  check_cases(pictures, SelftestOptions::Effort::normal);
}

TEST_CASE("hard cases at 10^6 inputs a check: trees and curves", "[part:searches]") {
  check_cases(searches, SelftestOptions::Effort::normal);
}

TEST_CASE("hard cases at 10^6 inputs a check: all others") {
  check_cases(other_cases(), SelftestOptions::Effort::normal);
}

TEST_CASE("hard cases at 10^8 inputs a case", "[long]") {
  check_cases(all_cases(), SelftestOptions::Effort::full);
}
