// The scalars that every kernel of a render takes.
#pragma once

#include "device.hpp"
#include "scene.hpp"
#include "types.h"
#include "upload.hpp"

namespace causticl {

/// Params as far as the scene decides them; passes fill in the rest.
inline Params scene_params(const Scene& scene, const DeviceScene& device_scene, std::uint32_t seed) {
  Params params{};
  params.camera = device_camera(scene.camera);
  params.width = static_cast<uint>(scene.width);
  params.height = static_cast<uint>(scene.height);
  params.seed = seed;
  params.max_depth = static_cast<uint>(scene.max_depth);
  params.plane_count = device_scene.plane_count;
  params.emitter_count = device_scene.emitter_count;
  params.delta_lights = device_scene.delta_lights;
  params.emitter_density =
      device_scene.emitted_power > 0 ? static_cast<float>(1 / device_scene.emitted_power) : 0.0f;
  return params;
}

/// Work-items of one launch: on a CPU what stays in cache; a GPU needs many more to fill it.
inline std::size_t launch_chunk(const Device& device) {
  return std::size_t{1} << (device.info().type == "cpu" ? 16 : 20);
}

}  // namespace causticl
