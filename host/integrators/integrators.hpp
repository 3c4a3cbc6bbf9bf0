// The integrators of INTEGRATOR_TABLE, by their rows.
#pragma once

#include <memory>
#include <string>

#include "accuracy/error_estimate.hpp"
#include "device_scene/device_scene.hpp"
#include "film/film.hpp"
#include "integrators/integrator.hpp"
#include "opencl/programs.hpp"
#include "photons/pilot.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// What an integrator is made of, on one device.
struct IntegratorInputs {
  const Scene& scene;
  DeviceScene& device_scene;
  Device& device;
  Film& film;
  Programs& programs;
  std::uint32_t seed = 1;
  bool with_photons = false;     // the plan of passes.hpp says when photons change no picture
  const Pilot* pilot = nullptr;  // what it decided on another device, which holds here; none: it runs
};

// What the file of each row holds.
#define FUNCTIONS_OF_INTEGRATOR(name, ...)                                 \
  std::unique_ptr<PassIntegrator> make_##name(const IntegratorInputs& in); \
  ErrorRates rates_of_##name(const RendererSpec& renderer);                \
  std::string text_of_##name(const RendererSpec& renderer);
INTEGRATOR_TABLE(FUNCTIONS_OF_INTEGRATOR)
#undef FUNCTIONS_OF_INTEGRATOR

/// The integrator that the scene names.
std::unique_ptr<PassIntegrator> make_integrator(const IntegratorInputs& in);

/// How its error is expected to go down.
ErrorRates expected_rates(const RendererSpec& renderer);

/// What `info` says of it and its settings.
std::string integrator_text(const RendererSpec& renderer);

}  // namespace causticl
