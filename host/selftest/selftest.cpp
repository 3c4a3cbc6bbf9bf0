#include "selftest/selftest.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/spelling.hpp"

namespace causticl {
namespace {

std::uint64_t inputs_of(const Check& check, const SelftestOptions& options) {
  if (options.inputs) return options.inputs;
  switch (options.effort) {
    case SelftestOptions::Effort::quick:
      return std::max<std::uint64_t>(100000 / check.input_cost, 1000);
    case SelftestOptions::Effort::full:
      return std::max<std::uint64_t>(std::llround(1e8 * check.input_fraction), 1000000);
    default:
      return 1000000;
  }
}

bool is_wanted(const Check& check, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return true;
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& text) {
    return text == std::to_string(check.hard_case) ||
           (text.find_first_not_of("0123456789") != std::string::npos &&
            check.name.find(text) != std::string::npos);
  });
}

std::vector<std::string> names_of(const std::vector<Check>& checks) {
  std::vector<std::string> names;
  for (const auto& check : checks) names.push_back(check.name);
  return names;
}

std::string verdict_of(const CheckResult& result) {
  return !result.skipped.empty() ? "skipped" : result.failures ? "FAILED" : "ok";
}

template <typename... Arguments>
std::string format(const char* pattern, Arguments... arguments) {
  char line[512];
  std::snprintf(line, sizeof line, pattern, arguments...);
  return line;
}

}  // namespace

std::vector<Check> wanted_checks(std::vector<Check> checks, const SelftestOptions& options) {
  for (const auto& text : options.checks)
    if (std::none_of(checks.begin(), checks.end(),
                     [&](const Check& check) { return is_wanted(check, {text}); }))
      throw UserError("--case " + text + ": no such check; expected a number from 1 to " +
                      std::to_string(hard_case_count) + " or part of the name of a check" +
                      did_you_mean(text, names_of(checks)));
  std::erase_if(checks, [&](const Check& check) { return !is_wanted(check, options.checks); });
  if (!options.replay.empty() && checks.size() != 1)
    throw UserError("--replay: expected --case with the name of the one check that the input is for, found " +
                    std::to_string(checks.size()) + " checks");
  return checks;
}

SelftestRow run_check(Device& device, const Check& check, const SelftestOptions& options) {
  CheckContext context{device,       options.kernel_dir, inputs_of(check, options),
                       options.seed, options.threads,    {}};
  if (!options.replay.empty()) context.replay = parse_replay(options.replay);
  const auto start = std::chrono::steady_clock::now();
  SelftestRow row{check, check.run(context)};
  row.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (context.replay && !context.replayed)
    throw UserError("--replay: the check \"" + check.name +
                    "\" has no inputs to replay; expected one that printed them");
  return row;
}

std::vector<SelftestRow> run_selftest(Device& device, const std::vector<Check>& checks,
                                      const SelftestOptions& options,
                                      const std::function<void(const SelftestRow&)>& report) {
  std::vector<SelftestRow> rows;
  for (const auto& check : checks) {
    rows.push_back(run_check(device, check, options));
    if (report) report(rows.back());
  }
  return rows;
}

bool selftest_passed(const std::vector<SelftestRow>& rows) {
  return std::none_of(rows.begin(), rows.end(),
                      [](const SelftestRow& row) { return row.result.failures > 0; });
}

std::string selftest_heading(const DeviceInfo& device, const SelftestOptions& options) {
  return format("causticl %s on %s (%s, driver %s), seed %u\n", CAUSTICL_VERSION, device.name.c_str(),
                device.platform_name.c_str(), device.driver.c_str(), options.seed) +
         format("%4s  %-52s %11s %9s %11s %11s  %s\n", "case", "check", "inputs", "failures", "worst error",
                "tolerance", "verdict");
}

std::string selftest_line(const SelftestRow& row) {
  const CheckResult& result = row.result;
  std::string line = format("%4d  %-52s %11llu %9llu", row.check.hard_case, row.check.name.c_str(),
                            static_cast<unsigned long long>(result.inputs),
                            static_cast<unsigned long long>(result.failures));
  if (result.unit.empty())
    line += format(" %11s %11s", "", "");
  else
    line += format(" %11.3g %11.3g", result.worst_error, result.tolerance);
  line += "  " + verdict_of(result);
  if (!result.unit.empty()) line += " (" + result.unit + ")";
  const std::string& remark = result.skipped.empty() ? result.note : result.skipped;
  return line + (remark.empty() ? "" : "; " + remark) + "\n";
}

std::string selftest_verdict(const std::vector<SelftestRow>& rows, const SelftestOptions& options,
                             double seconds) {
  std::string text;
  std::size_t failed = 0, skipped = 0;
  for (const auto& row : rows) {
    skipped += !row.result.skipped.empty();
    if (row.result.failures == 0) continue;
    ++failed;
    text += format("\nhard case %d (%s): \"%s\" failed\n", row.check.hard_case,
                   hard_case_name(row.check.hard_case), row.check.name.c_str());
    if (!row.result.example.empty())
      text += "  replay the first failure: causticl selftest --case \"" + row.check.name +
              "\" --replay=" + row.result.example + "\n";
    else
      text += format("  again: causticl selftest --case \"%s\" --seed %u\n", row.check.name.c_str(),
                     options.seed);
  }
  text +=
      format("\n%zu of %zu checks passed in %.1f s", rows.size() - failed - skipped, rows.size(), seconds);
  if (skipped) text += format(", %zu were skipped", skipped);
  if (failed)
    text +=
        format("; %zu FAILED: pictures rendered on this device may be wrong where these cases arise", failed);
  return text + "\n";
}

std::string selftest_json(const DeviceInfo& device, const std::vector<SelftestRow>& rows,
                          const SelftestOptions& options, double seconds) {
  nlohmann::ordered_json checks = nlohmann::ordered_json::array();
  for (const auto& [check, result] : rows) {
    checks.push_back({{"case", check.hard_case},
                      {"hard_case", hard_case_name(check.hard_case)},
                      {"check", check.name},
                      {"inputs", result.inputs},
                      {"failures", result.failures},
                      {"worst_error", result.worst_error},
                      {"tolerance", result.tolerance},
                      {"unit", result.unit},
                      {"verdict", verdict_of(result)},
                      {"note", result.skipped.empty() ? result.note : result.skipped},
                      {"example", result.example},
                      {"seconds", result.seconds}});
  }
  const nlohmann::ordered_json object = {
      {"version", CAUSTICL_VERSION},     {"device", device.name}, {"platform", device.platform_name},
      {"driver", device.driver},         {"seed", options.seed},  {"seconds", seconds},
      {"passed", selftest_passed(rows)}, {"checks", checks}};
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace causticl
