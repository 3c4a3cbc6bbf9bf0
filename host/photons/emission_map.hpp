// Where useful photons start: cells of the unit cube of the numbers that decide it, see
// cl/photons/emission_map.cl.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/types.h"

namespace causticl {

using StartNumbers = std::array<float, START_NUMBERS>;

/// A map of `photons` photons that were drawn by the map `drawn_by` (none: evenly), of which those with the
/// numbers `useful` were of use. Three quarters of all photons start by the map: half of these in
/// proportion to the useful photons of a cell, half to what minimises the variance of a sum over useful ones,
/// sqrt(volume * useful). The others start evenly, so that nothing is missed and no photon carries more than
/// four times the usual flux. Cells are halves of cells, cut across the number in which the useful photons
/// are least even, as long as the halves hold enough of them.
std::vector<EmissionCell> emission_map(std::span<const StartNumbers> useful, std::size_t photons,
                                       std::span<const EmissionCell> drawn_by);

/// The flux of a photon that starts at `numbers`, relative to one without a map.
double emission_map_weight(std::span<const EmissionCell> cells, const StartNumbers& numbers);

}  // namespace causticl
