// What is reported of guided photons.
#pragma once

#include <cstdint>

namespace causticl {

/// What became of the scouts of guided photons in the last pass that had any: see
/// cl/photons/metropolis_photons.cl.
struct SeedStatistics {
  double share = 0;  // of the scouts, that landed where the camera sees
  std::uint32_t copies = 0;
};

}  // namespace causticl
