// What the kernel tests share: one device, quick programs, and random inputs from a printed seed.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "catch2.hpp"
#include "opencl/device.hpp"
#include "opencl/kernel_sources.hpp"
#include "shared/effects.h"
#include "shared/types.h"

namespace causticl {

/// The device that tests run on: CAUSTICL_DEVICE names it, else the first CPU, else the first device.
Device& test_device();

/// Puts the test device's work-group size back when a test that changes it ends.
struct WorkGroupSize {
  std::size_t size = test_device().local_size();
  ~WorkGroupSize() { test_device().set_local_size(size); }
};

/// Builds a test's own OpenCL text; its #include "name.cl" lines take the shipped kernel files. `effects` are
/// the bits of effects.h that HAS() sees.
cl::Program build_test_program(const std::string& text, unsigned effects = EFFECT_ALL,
                               const std::string& options = "");

/// A generator with a fixed seed (CAUSTICL_TEST_SEED overrides it) that is printed when a check fails.
struct RandomInputs {
  explicit RandomInputs(unsigned default_seed);
  unsigned seed;
  std::mt19937_64 engine;
  double uniform(double low = 0, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
};

/// Runs `kernel` of `program` over `items` work-items with these arguments, and waits.
template <typename... Arguments>
void run_kernel(cl::Program& program, const char* name, std::size_t items, const Arguments&... arguments) {
  cl::Kernel kernel(program, name);
  set_arguments(kernel, arguments...);
  test_device().launch(kernel, items);
  test_device().queue().finish();
}

}  // namespace causticl
