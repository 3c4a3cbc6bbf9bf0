// The scalars that every kernel of a render takes.
#pragma once

#include "device_scene/channel_shifts.hpp"
#include "device_scene/device_scene.hpp"
#include "opencl/device.hpp"
#include "scene/scene.hpp"
#include "scene/spectrum.hpp"
#include "shared/types.h"

namespace causticl {

/// The part of Params that changes where what is bounded moves, since that is what distant lights shine on.
inline void set_emission(Params& params, const DeviceScene& device_scene) {
  params.emitter_density =
      device_scene.emitted_power > 0 ? static_cast<float>(1 / device_scene.emitted_power) : 0.0f;
}

/// What paths are told of dielectrics that touch or hold something; nothing where none does.
void set_nested(Params& params, const Dielectrics& dielectrics);

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
  set_emission(params, device_scene);
  params.sobol = scene.renderer.sampler == Sampler::sobol;
  params.emission_met = has_visible_light(scene);
  set_nested(params, device_scene.dielectrics);
  params.channel_shifts = channel_shifts(scene);
  const auto to_float = [](double x) { return static_cast<float>(x); };
  const Vec3 scattering = scene.medium.scattering, extinction = scene.medium.absorption + scattering;
  params.extinction = {to_float(extinction.x), to_float(extinction.y), to_float(extinction.z),
                       to_float(scene.medium.g)};
  params.scattering = {to_float(scattering.x), to_float(scattering.y), to_float(scattering.z), 0};
  return params;
}

/// Params of pass number `pass`.
inline void begin_pass(Params& params, std::uint32_t pass) {
  params.pass = pass;
  const auto wavelengths = pass_wavelengths(params.seed, pass);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double micrometres = 1e-3 * wavelengths[channel];
    params.inverse_wavelength2[channel] = static_cast<float>(1 / (micrometres * micrometres));
  }
}

/// Work-items of one launch: on a CPU what stays in cache; a GPU needs many more to fill it.
inline std::size_t launch_chunk(const Device& device) {
  return std::size_t{1} << (device.info().type == "cpu" ? 16 : 20);
}

}  // namespace causticl
