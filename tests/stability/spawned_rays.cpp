// Hard case 8: rays that leave a surface do not meet it again, nor pass through it.
#include "stability_checks.hpp"

namespace causticl {

std::vector<Check> spawned_ray_checks() { return {}; }

}  // namespace causticl
