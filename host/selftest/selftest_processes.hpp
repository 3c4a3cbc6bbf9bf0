// Checks in several processes: PoCL compiles one kernel at a time in each, and most of a first selftest is
// that.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "selftest/selftest.hpp"

namespace causticl {

/// Forked copies of this process that run checks as well. They know of no device before run() asks them to: a
/// driver does not survive a fork.
class SelftestProcesses {
 public:
  /// Forks. To be called before anything asks for OpenCL or starts a thread. `device` is what find_device
  /// takes, and `keep_kernels` what KernelCache takes.
  SelftestProcesses(std::vector<Check> checks, SelftestOptions options, const std::string& device,
                    bool keep_kernels);
  ~SelftestProcesses();
  SelftestProcesses(const SelftestProcesses&) = delete;
  SelftestProcesses& operator=(const SelftestProcesses&) = delete;

  /// Runs the checks on `device`, here and, where it compiles one kernel at a time, in the other processes.
  /// Checks that share programs run in one of them, one after another. `report` gets the rows in the order of
  /// the checks. What a process leaves undone when it ends early is done here, so that its fault shows.
  std::vector<SelftestRow> run(Device& device, const std::function<void(const SelftestRow&)>& report);

  /// With the number of its check.
  using NumberedResult = std::pair<std::size_t, CheckResult>;

 private:
  struct Helper {
    pid_t process;
    int rows;  // a pipe: the results of its checks
  };
  std::vector<Check> checks_;
  SelftestOptions options_;
  std::vector<std::vector<std::size_t>> groups_;  // of checks that share programs
  int groups_in_ = -1, groups_out_ = -1;          // a pipe: the groups that nobody has taken yet, a byte each
  std::vector<Helper> helpers_;

  [[noreturn]] void help(const std::string& device, bool keep_kernels, int rows) const;
  static void end(const Helper& helper);
  /// The next result of any helper, waited for so long (-1: for ever). None when that is over or all have
  /// ended.
  std::optional<NumberedResult> receive_any(int milliseconds);
};

}  // namespace causticl
