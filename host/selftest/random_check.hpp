// A check over many random inputs: batches on the device, judged on the host, the first failure kept.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>
#include <type_traits>

#include "base/error.hpp"
#include "base/task_pool.hpp"
#include "selftest/input_random.hpp"
#include "selftest/selftest_check.hpp"

namespace causticl {

/// How many inputs a kernel gets at a time, at most.
constexpr std::size_t check_batch = std::size_t{1} << 18;

/// Sets the argument number `index`, and returns the index of the next.
template <typename Argument>
cl_uint set_argument(cl::Kernel& kernel, cl_uint index, const Argument& argument) {
  kernel.setArg(index, argument);
  return index + 1;
}

/// A kernel with the signature kernel(global const Input*, global Output*, uint count, further arguments...).
class CheckKernel {
 public:
  CheckKernel(CheckContext& context, const cl::Program& program, const char* name)
      : device_(context.device), kernel_(program, name) {}

  /// Sets the arguments after the first three: buffers and scalars.
  template <typename... Arguments>
  CheckKernel& with(const Arguments&... arguments) {
    [[maybe_unused]] cl_uint index = 3;
    ((index = set_argument(kernel_, index, arguments)), ...);
    return *this;
  }

  template <typename Output, typename Input>
  std::vector<Output> run(const std::vector<Input>& inputs) {
    if (inputs.size() > capacity_) {
      capacity_ = inputs.size();
      inputs_ = device_.buffer(capacity_ * sizeof(Input), "inputs of a check");
      outputs_ = device_.buffer(capacity_ * sizeof(Output), "outputs of a check");
    }
    device_.queue().enqueueWriteBuffer(inputs_, CL_TRUE, 0, inputs.size() * sizeof(Input), inputs.data());
    kernel_.setArg(0, inputs_);
    kernel_.setArg(1, outputs_);
    kernel_.setArg(2, static_cast<cl_uint>(inputs.size()));
    device_.launch_pass(kernel_, inputs.size());  // of one size class: see Device::launch_size
    return device_.download<Output>(outputs_, inputs.size());
  }

 private:
  Device& device_;
  cl::Kernel kernel_;
  cl::Buffer inputs_, outputs_;
  std::size_t capacity_ = 0;
};

/// Tries context.inputs inputs. `generate(InputRandom&, index)` makes an Input, which must be nothing but
/// 32-bit words; `evaluate(inputs)` returns an output for each, from the device; `judge(input, output)`
/// returns the error, from an oracle in double precision. An error above `tolerance`, or NaN, is a failure.
template <typename Generate, typename Evaluate, typename Judge>
CheckResult run_random_check(CheckContext& context, double tolerance, const char* unit,
                             const Generate& generate, const Evaluate& evaluate, const Judge& judge) {
  using Input = std::decay_t<decltype(generate(std::declval<InputRandom&>(), std::uint64_t{}))>;
  static_assert(std::is_trivially_copyable_v<Input> && sizeof(Input) % 4 == 0);
  constexpr std::size_t batch = check_batch, chunk = 4096, words = sizeof(Input) / 4;

  CheckResult result;
  result.tolerance = tolerance;
  result.unit = unit;
  const std::uint64_t count = context.replay ? 1 : context.inputs;
  std::uint64_t first_failure = count;
  std::mutex mutex;
  for (std::uint64_t first = 0; first < count; first += batch) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(batch, count - first));
    std::vector<Input> inputs(size);
    if (context.replay) {
      if (context.replay->size() != words)
        throw UserError("--replay: expected the " + std::to_string(words) +
                        " numbers of an input of this check, found " +
                        std::to_string(context.replay->size()));
      context.replayed = true;
      std::memcpy(inputs.data(), context.replay->data(), sizeof(Input));
    } else {
      parallel_chunks(size, chunk, context.threads, [&](std::size_t low, std::size_t high) {
        for (std::size_t i = low; i < high; ++i) {
          InputRandom random(context.seed, first + i);
          inputs[i] = generate(random, first + i);
        }
      });
    }
    const auto outputs = evaluate(std::as_const(inputs));
    parallel_chunks(size, chunk, context.threads, [&](std::size_t low, std::size_t high) {
      double worst = 0;
      std::uint64_t failures = 0, failure = count;
      for (std::size_t i = low; i < high; ++i) {
        const double error = judge(std::as_const(inputs[i]), outputs[i]);
        if (!(error <= tolerance)) {
          if (failures++ == 0) failure = first + i;
        }
        worst = std::isnan(error) ? error : std::max(worst, error);
      }
      const std::lock_guard lock(mutex);
      result.failures += failures;
      if (!std::isnan(result.worst_error) && !(worst <= result.worst_error)) result.worst_error = worst;
      if (failure < first_failure) {
        first_failure = failure;
        std::uint32_t text[words];
        std::memcpy(text, &inputs[failure - first], sizeof(Input));
        result.example = replay_text(text, words);
      }
    });
    result.inputs += size;
  }
  return result;
}

}  // namespace causticl
