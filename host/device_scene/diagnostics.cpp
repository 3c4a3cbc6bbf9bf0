#include "device_scene/diagnostics.hpp"

namespace causticl {

std::vector<std::string> fault_warnings(const Faults& faults) {
  std::vector<std::string> warnings;
  for (const auto& kind : fault_kinds)
    if (faults.*kind.count) warnings.push_back(std::to_string(faults.*kind.count) + " " + kind.meaning);
  return warnings;
}

}  // namespace causticl
