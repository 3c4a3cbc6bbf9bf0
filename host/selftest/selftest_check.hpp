// What a stability check is: a claim about one of the hard cases of numerics, tried on a device.
//
// The checks themselves are in tests/stability, a library without a test framework: `causticl selftest` runs
// them on the user's device and the tests run them in CI.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "opencl/device.hpp"

namespace causticl {

/// What one check found: a line of the table of `causticl selftest`.
struct CheckResult {
  std::uint64_t inputs = 0, failures = 0;
  double worst_error = 0;  // the largest of all inputs, in units of `tolerance`'s `unit`
  double tolerance = 0;    // an input fails where its error is above this, or NaN
  std::string unit;        // "ulp", "relative"; empty for checks that are right or wrong
  std::string example;     // the first input that failed, as a `--replay` argument; empty where none did
  std::string note;        // what else the user should see, as a count of unresolved roots
  std::string skipped;     // why the check did not run on this device; empty where it did
  double seconds = 0;

  bool passed() const { return failures == 0 && skipped.empty(); }
};

/// What a check runs on.
struct CheckContext {
  Device& device;
  std::string kernel_dir;    // read cl/ live from here; empty: the embedded sources
  std::uint64_t inputs = 0;  // random inputs to try
  std::uint32_t seed = 1;
  unsigned threads = 0;                                // of the host's oracles; 0: all of the machine
  std::optional<std::vector<std::uint32_t>> replay{};  // the words of the only input to try
  bool replayed = false;                               // set by a check that took them

  /// Builds a check's own OpenCL text; its #include "name.cl" lines take the shipped kernel files. `effects`
  /// are the bits of effects.h that HAS() sees; `options` go to the compiler: -DCAUSTICL_DOUBLE makes the
  /// double build of the same kernels, where device.info().fp64 says that there is one.
  cl::Program program(const std::string& text, unsigned effects = ~0u, const std::string& options = "") const;
};

struct Check {
  int hard_case;             // its number in the table of docs/numerics.md
  std::string name;          // what is claimed, in a few words
  std::uint64_t input_cost;  // how many of the cheapest check's inputs take the time of one of this
  CheckResult (*run)(CheckContext&);
  std::string programs =
      {};  // checks that share kernel programs, which take seconds to compile, have the same
  double input_fraction =
      1;  // of its hard case's inputs, where these are shared so that all its checks take equally long
};

/// Words as the argument of `--replay`: each as a hexadecimal float, or as #hexadecimal bits where it is no
/// finite float.
std::string replay_text(const std::uint32_t* words, std::size_t count);
/// The words of such a text. Throws UserError.
std::vector<std::uint32_t> parse_replay(const std::string& text);

/// The name of a hard case: "far or small sphere".
const char* hard_case_name(int hard_case);
constexpr int hard_case_count = 27;

}  // namespace causticl
