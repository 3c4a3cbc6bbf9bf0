// Hard case 21: random numbers.
#include "stability_checks.hpp"

namespace causticl {

std::vector<Check> random_number_checks() { return {}; }

}  // namespace causticl
