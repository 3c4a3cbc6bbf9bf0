// Which lit sides a wall rises over.
#pragma once

#include <vector>

#include "device_scene/wall_parting.hpp"

namespace causticl {

/// On which sides of `other` the wall rises so that they face it. `wall_polygon` is what of a flat wall
/// counts.
WallSides faced_by(const WallPrimitive& other, const WallPrimitive& wall,
                   const std::vector<Vec3>& wall_polygon, const WallReach& reach);

}  // namespace causticl
