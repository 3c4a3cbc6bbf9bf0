// Hard case 10: revolved Bezier curves.
#include "stability_checks.hpp"

namespace causticl {

std::vector<Check> bezier_checks() { return {}; }

}  // namespace causticl
