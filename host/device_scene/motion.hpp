// Motion blur: one time for all paths of a pass.
#pragma once

#include <cstdint>

#include "device_scene/device_scene.hpp"

namespace causticl {

/// The time of pass number `pass`, of a sequence that fills the shutter's interval evenly in any range of
/// passes: k (sqrt(5) - 1) / 2 plus a start of the seed's own, modulo 1.
double pass_time(const CameraSpec& camera, std::uint32_t seed, std::uint32_t pass);

/// Places the scene for one pass after another. Photons and camera paths of a pass see the same still, so
/// that the mean of all passes is the scene blurred by motion, caustics and shadows included. A scene without
/// motion stays as it was uploaded.
class Motion {
 public:
  Motion(const Scene& scene, Device& device, DeviceScene& device_scene, std::uint32_t seed)
      : scene_(scene), device_(device), device_scene_(device_scene), seed_(seed), moves_(has_motion(scene)) {}

  /// Waits for what is enqueued, where something moves. Buffers may change: kernels take them anew.
  void begin_pass(std::uint32_t pass) {
    if (moves_) place_flat_scene(scene_, pass_time(scene_.camera, seed_, pass), device_, device_scene_);
  }

 private:
  const Scene& scene_;
  Device& device_;
  DeviceScene& device_scene_;
  const std::uint32_t seed_;
  const bool moves_;
};

}  // namespace causticl
