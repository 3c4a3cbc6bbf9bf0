// `causticl selftest`: the stability checks on the user's device, as a table and as JSON.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "selftest/selftest_check.hpp"

namespace causticl {

/// What to run.
struct SelftestOptions {
  enum class Effort { quick, normal, full };  // 10^5 inputs a check at most, 10^6, or 10^8 a case
  Effort effort = Effort::normal;
  std::uint64_t inputs = 0;         // a check; 0: what `effort` says
  std::vector<std::string> checks;  // numbers of hard cases, or parts of checks' names; empty: all
  std::string replay;               // the words of one input, for one check; empty: random inputs
  std::uint32_t seed = 1;
  unsigned threads = 0;
  std::string kernel_dir;
};

struct SelftestRow {
  Check check;
  CheckResult result;
};

/// Those of `checks` that the options name. Throws UserError where they name none, or not the one of
/// `replay`.
std::vector<Check> wanted_checks(std::vector<Check> checks, const SelftestOptions& options);

/// Runs one. Throws UserError for a `replay` that the check cannot take.
SelftestRow run_check(Device& device, const Check& check, const SelftestOptions& options);

/// Runs the checks in order, and hands each row to `report` when it is done.
std::vector<SelftestRow> run_selftest(Device& device, const std::vector<Check>& checks,
                                      const SelftestOptions& options,
                                      const std::function<void(const SelftestRow&)>& report = {});

/// The head of the table, one row of it, and the lines below it: examples of failures, and the verdict after
/// `seconds` on the clock.
std::string selftest_heading(const DeviceInfo& device, const SelftestOptions& options);
std::string selftest_line(const SelftestRow& row);
std::string selftest_verdict(const std::vector<SelftestRow>& rows, const SelftestOptions& options,
                             double seconds);

/// The same as one object: device, driver, seed, seconds, passed, and checks with all their numbers.
std::string selftest_json(const DeviceInfo& device, const std::vector<SelftestRow>& rows,
                          const SelftestOptions& options, double seconds);

bool selftest_passed(const std::vector<SelftestRow>& rows);

}  // namespace causticl
