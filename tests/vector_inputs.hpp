// Vectors as test inputs and as what comes back from the device.
#pragma once

#include <algorithm>
#include <cmath>

#include "device_fixture.hpp"
#include "selftest/vectors.hpp"

namespace causticl {

/// A uniform number that a float holds exactly, in [0, 1), as the kernels draw theirs.
inline float uniform24(RandomInputs& random) {
  return static_cast<float>(std::floor(random.uniform() * 16777216.0) / 16777216.0);
}
inline std::vector<float4> uniform_tuples(RandomInputs& random, std::size_t count) {
  std::vector<float4> result(count);
  for (auto& u : result) u = {uniform24(random), uniform24(random), uniform24(random), uniform24(random)};
  return result;
}

/// What `kernel`, with the signature kernel(global const Input*, global Output*, uint count, further
/// arguments...), makes of each input.
template <typename Output, typename Input, typename... Arguments>
std::vector<Output> outputs_of(cl::Program& program, const char* kernel, const std::vector<Input>& inputs,
                               const Arguments&... arguments) {
  const auto in = test_device().upload(inputs, "inputs");
  const auto out = test_device().buffer(inputs.size() * sizeof(Output), "outputs");
  run_kernel(program, kernel, inputs.size(), in, out, static_cast<cl_uint>(inputs.size()), arguments...);
  return test_device().download<Output>(out, inputs.size());
}

/// A direction with uniform density over the sphere.
inline Vec3 random_direction(RandomInputs& random) {
  const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * M_PI), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A direction at `angle` from the unit vector `axis`, at a random turn about it.
inline Vec3 tilted_direction(RandomInputs& random, Vec3 axis, double angle) {
  const double around = random.uniform(0, 2 * M_PI);
  return Frame(axis).to_world(
      {std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around), std::cos(angle)});
}

/// The number of values in a range that `bad` says yes to.
template <typename Range, typename Predicate>
std::size_t count_where(const Range& range, Predicate bad) {
  return static_cast<std::size_t>(std::count_if(range.begin(), range.end(), bad));
}

}  // namespace causticl
