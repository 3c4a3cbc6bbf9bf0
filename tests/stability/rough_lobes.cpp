// Hard case 13: rough lobes as their width goes to zero.
#include "stability_checks.hpp"

namespace causticl {

std::vector<Check> rough_lobe_checks() { return {}; }

}  // namespace causticl
