// What calls for EFFECT_WALLS.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace causticl {

/// The first object that may have photons on two sides, or nothing.
std::string walls_reason(const Scene& scene);

}  // namespace causticl
