// Hard case 12: Fresnel equations at their limits.
#include "stability_checks.hpp"

namespace causticl {

std::vector<Check> fresnel_checks() { return {}; }

}  // namespace causticl
