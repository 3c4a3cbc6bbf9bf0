// The programs of a render, built in the background while the host does other things.
#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <map>
#include <thread>

#include "opencl/kernels.hpp"

namespace causticl {

/// What became of a program.
struct ProgramBuild {
  std::string pass;
  unsigned effects = 0;  // EFFECT_* bits that it was built for
  double seconds = 0;    // to build it and to make its kernels ready to run
};

/// Builds the programs of `passes` on threads of their own, in this order: one thread where the driver
/// compiles one at a time whatever it is asked for, else one a program; at once where the device takes no
/// threads. Each kernel is launched once with all scalars 0, upon which it must return at once, since drivers
/// compile much at the first launch.
class Programs {
 public:
  Programs(Device& device, const KernelOptions& options, const std::vector<std::string>& passes);
  ~Programs();
  Programs(const Programs&) = delete;
  Programs& operator=(const Programs&) = delete;

  const KernelOptions& options() const { return options_; }

  /// Waits until the first program is built, or `seconds` are over; says whether it is.
  bool first_is_built_within(double seconds) const;

  /// Waits until the program is built. Throws what building it threw.
  cl::Kernel kernel(const std::string& pass, const char* name);

  /// Waits for all of them. Throws what building one threw.
  std::vector<ProgramBuild> builds() const;

 private:
  struct Build {
    std::string pass;
    std::promise<cl::Program> promise;
    std::shared_future<cl::Program> program;
    double seconds = 0;
  };
  Device& device_;
  KernelOptions options_;
  std::vector<Build> builds_;
  std::atomic<std::size_t> next_{0};
  std::vector<std::jthread> threads_;

  void work(const std::stop_token& stop);
  void build(Build& build);
};

}  // namespace causticl
