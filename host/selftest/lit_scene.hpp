// What checks of lights share: a scene on the device, as the kernels that draw from its lights take it, and
// the numbers to draw by.
#pragma once

#include <concepts>

#include "device_scene/device_scene.hpp"
#include "selftest/input_random.hpp"

namespace causticl {

/// A scene whose kernels end in `Params params, SCENE_PARAMETERS`: it is set as one argument.
struct LitScene {
  Scene scene;
  DeviceScene uploaded;
  Params params{};

  void upload(Device& device) {
    uploaded = update_device_scene(scene, device, 1);
    params.emitter_count = uploaded.emitter_count;
    params.emitter_density = static_cast<float>(1 / uploaded.emitted_power);
  }
};

/// Sets the arguments from `index` on, and returns the index of the next.
template <std::derived_from<LitScene> Lit>
cl_uint set_argument(cl::Kernel& kernel, cl_uint index, const Lit& lit) {
  kernel.setArg(index, lit.params);
  return set_scene_arguments(kernel, lit.uploaded, index + 1);
}

/// The random numbers of one light_sample.
struct Numbers {
  float u[4];
};
inline Numbers random_numbers(InputRandom& random, std::uint64_t) {
  Numbers numbers;
  for (float& u : numbers.u) u = random.uniform24();
  return numbers;
}

}  // namespace causticl
