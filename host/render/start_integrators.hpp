// The integrators of a render, one for each device.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "photons/pilot.hpp"
#include "render/several_devices.hpp"

namespace causticl {

/// Makes the integrator of each of `parts`. Its pilot, if it has one, runs on the first of them, and all hold
/// to that: returned, and told to `notice`.
std::optional<Pilot> start_integrators(const std::vector<std::unique_ptr<RenderDevice>>& parts,
                                       const Scene& scene, std::uint32_t seed, bool with_photons,
                                       const std::function<void(const std::string&)>& notice);

}  // namespace causticl
