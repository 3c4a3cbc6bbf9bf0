#include "stability_checks.hpp"

#include <algorithm>

namespace causticl {

std::vector<Check> stability_checks() {
  std::vector<Check> all;
  for (const auto& group : {sphere_checks(), arithmetic_checks()})
    all.insert(all.end(), group.begin(), group.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const Check& a, const Check& b) { return a.hard_case < b.hard_case; });
  return all;
}

}  // namespace causticl
