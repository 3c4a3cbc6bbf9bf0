// What is reported of Metropolis photons.
#pragma once

#include <cstdint>

namespace causticl {

/// What became of the pilot paths of Metropolis photons in the last pass that had any: see
/// cl/photons/metropolis_photons.cl.
struct MetropolisStatistics {
  double fraction = 0;  // of the pilot paths, that landed where the camera sees
  std::uint32_t copies = 0;
};

}  // namespace causticl
