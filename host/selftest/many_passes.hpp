// Checks that let a few items run through context.inputs passes on the device, and through the same on the
// host.
#pragma once

#include <algorithm>
#include <string>

#include "selftest/selftest_check.hpp"

namespace causticl {

/// A linear congruential generator that makes the same samples on both sides.
inline std::uint32_t next_state(std::uint32_t state) { return state * 1664525u + 1013904223u; }
inline const std::string next_state_source = R"(
#include "core/prelude.cl"
INLINE uint next_state(uint state) { return state * 1664525u + 1013904223u; }
)";

/// Runs kernel(buffers..., items, passes) until all passes are done, in launches that are short enough for
/// the watchdog of a GPU that draws a screen.
template <typename... Buffers>
void launch_passes(CheckContext& context, cl::Kernel& kernel, cl_uint items, const Buffers&... buffers) {
  constexpr std::uint64_t longest = 1 << 16;
  for (std::uint64_t done = 0; done < context.inputs; done += longest) {
    set_arguments(kernel, buffers..., items, static_cast<cl_uint>(std::min(longest, context.inputs - done)));
    context.device.launch(kernel, items);
  }
}

/// The result of items with these relative errors, of which 10^-6 is granted.
inline CheckResult result_of_passes(const CheckContext& context, const std::vector<double>& errors) {
  CheckResult result;
  result.tolerance = 1e-6;
  result.unit = "relative";
  result.inputs = context.inputs;
  for (const double error : errors) {
    result.failures += !(error <= result.tolerance);
    result.worst_error = std::max(result.worst_error, error);
  }
  return result;
}

}  // namespace causticl
