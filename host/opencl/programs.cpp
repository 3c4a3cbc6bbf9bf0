#include "opencl/programs.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

/// Bytes of a scalar argument of a pass, by the name of its type; 0 for a type that no pass has.
std::size_t scalar_size(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{{"Params", sizeof(Params)},
                                                        {"PhotonGrids", sizeof(PhotonGrids)},
                                                        {"Grid", sizeof(Grid)},
                                                        {"uint", 4},
                                                        {"int", 4},
                                                        {"float", 4}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

/// OpenCL's names may end with a NUL.
std::string text_of(std::string text) {
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

/// Sets every buffer to `empty` and every scalar to zeros. False where a scalar is of unknown size.
bool set_zero_arguments(cl::Kernel& kernel, const cl::Buffer& empty) {
  const std::vector<unsigned char> zeros(std::max(sizeof(Params), sizeof(PhotonGrids)), 0);
  const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
  for (cl_uint i = 0; i < count; ++i) {
    if (kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(i) == CL_KERNEL_ARG_ADDRESS_GLOBAL) {
      kernel.setArg(i, empty);
      continue;
    }
    const std::size_t size = scalar_size(text_of(kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i)));
    if (size == 0) return false;
    kernel.setArg(i, size, zeros.data());
  }
  return true;
}

/// Launches each kernel of the program over as many items as passes do at least, on a queue of its own.
void launch_once(Device& device, const cl::Program& program) {
  cl::CommandQueue queue(device.context(), device.cl_device());
  const cl::Buffer empty(device.context(), CL_MEM_READ_WRITE, 16);
  std::vector<cl::Kernel> kernels;
  cl::Program(program).createKernels(&kernels);
  for (auto& kernel : kernels)
    if (set_zero_arguments(kernel, empty))
      queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(device.launch_size(1)),
                                 cl::NDRange(device.local_size()));
  queue.finish();
}

}  // namespace

Programs::Programs(Device& device, const KernelOptions& options, const std::vector<std::string>& passes)
    : device_(device), options_(options), builds_(passes.size()) {
  for (std::size_t i = 0; i < passes.size(); ++i) {
    builds_[i].pass = passes[i];
    builds_[i].program = builds_[i].promise.get_future().share();
  }
  if (!device.takes_threads()) {
    work({});
    return;
  }
  const std::size_t threads =
      device.compiles_in_parallel() ? passes.size() : std::min<std::size_t>(passes.size(), 1);
  for (std::size_t i = 0; i < threads; ++i)
    threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

Programs::~Programs() {
  for (auto& thread : threads_) thread.request_stop();
}

void Programs::work(const std::stop_token& stop) {
  for (std::size_t i; !stop.stop_requested() && (i = next_++) < builds_.size();) build(builds_[i]);
}

void Programs::build(Build& build) {
  const auto start = std::chrono::steady_clock::now();
  try {
    if (interruption_requested()) throw Interrupted();
    const cl::Program program = build_pass(device_, build.pass, options_);
    launch_once(device_, program);
    build.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    build.promise.set_value(program);
  } catch (...) {
    build.promise.set_exception(std::current_exception());
    return;
  }
  device_.store_compiled();
}

bool Programs::first_is_built_within(double seconds) const {
  return builds_.empty() || builds_.front().program.wait_for(std::chrono::duration<double>(seconds)) ==
                                std::future_status::ready;
}

cl::Kernel Programs::kernel(const std::string& pass, const char* name) {
  const auto found =
      std::find_if(builds_.begin(), builds_.end(), [&](const Build& build) { return build.pass == pass; });
  if (found == builds_.end()) throw std::logic_error("the pass " + pass + " was not planned");
  return cl::Kernel(found->program.get(), name);
}

std::vector<ProgramBuild> Programs::builds() const {
  std::vector<ProgramBuild> result;
  for (const auto& build : builds_) {
    build.program.get();
    result.push_back({build.pass, options_.effects & effects_of_pass(build.pass), build.seconds});
  }
  return result;
}

}  // namespace causticl
