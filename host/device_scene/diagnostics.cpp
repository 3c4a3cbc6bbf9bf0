#include "device_scene/diagnostics.hpp"

namespace causticl {

std::vector<std::string> diagnostic_warnings(const Diagnostics& diagnostics) {
  std::vector<std::string> warnings;
  for (const auto& kind : diagnostic_kinds)
    if (diagnostics.*kind.count)
      warnings.push_back(std::to_string(diagnostics.*kind.count) + " " + kind.meaning);
  return warnings;
}

}  // namespace causticl
