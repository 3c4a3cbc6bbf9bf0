#include "device_scene/motion.hpp"

#include <cmath>
#include <numbers>

namespace causticl {

double pass_time(const CameraSpec& camera, std::uint32_t seed, std::uint32_t pass) {
  const double u = seed * std::numbers::sqrt3 + pass * (std::numbers::phi - 1);
  return camera.shutter[0] + (camera.shutter[1] - camera.shutter[0]) * (u - std::floor(u));
}

}  // namespace causticl
