// Cutting space into cubes, whose buckets hold what lies in them: see Grid of cl/shared/photon_records.h.
#pragma once

#include <cstddef>

#include "device_scene/device_scene.hpp"
#include "shared/types.h"

namespace causticl {

inline std::size_t buckets_of(const Grid& grid) { return std::size_t{grid.nx} * grid.ny * grid.nz; }

/// Cubes of that size, as many along each axis as the scene is wide, but with no more than `affordable`
/// buckets in all. These begin at `first_bucket`.
Grid grid_of(const DeviceScene& scene, double cell, double affordable, std::size_t first_bucket = 0);

}  // namespace causticl
