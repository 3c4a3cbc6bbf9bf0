// Colour channels that all light of a scene is poor in, and lights whose photons carry a channel coarsely.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

/// Params::channel_shifts: see cl/photons/channel_shifts.cl.
uint channel_shifts(const Scene& scene);

/// A line for each light that has so little of a channel, beside its largest and beside what other lights
/// have, that photon mapping shows that channel of its light by noise alone: "the green of /objects/3 ...".
std::vector<std::string> coarse_channel_notices(const Scene& scene);

}  // namespace causticl
