#include "scene/integrators.hpp"

#include <algorithm>

#include "base/spelling.hpp"

namespace causticl {

std::vector<std::string> programs_of(Integrator integrator) { return words_of(row_of(integrator).programs); }

bool traces_photons(Integrator integrator) {
  const auto programs = programs_of(integrator);
  return std::find(programs.begin(), programs.end(), "photon") != programs.end();
}

}  // namespace causticl
