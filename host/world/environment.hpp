// Maps of radiance as kernels draw from them: the environment's, and those of surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

/// The integral over all directions of the map's largest channel, interpolated as the kernels do.
double environment_integral(const Image& map);

/// One entry a texel: radiance, and how many of `numbers` it owns, in proportion to the largest channel of
/// its radiance and to the solid angle of its row.
std::vector<EnvironmentTexel> environment_table(const Image& map, std::uint64_t numbers);

/// The mean of the texels' largest channels.
double mean_radiance(const Image& map);

/// The same of a map on a flat surface, whose texels are all of one size.
std::vector<EnvironmentTexel> flat_table(const Image& map, std::uint64_t numbers);

}  // namespace causticl
