// What kernels know of a light of the scene's key `lights`.
#pragma once

#include "scene/scene.hpp"
#include "shared/types.h"

namespace causticl {

/// Where light from beyond the scene has to go.
struct LitRegion {
  float4 sphere;    // centre and radius
  float reach = 1;  // how far the farthest infinite plane is from its centre, in radii, 1 at least
};

/// All but what an emitter shares with the others: its numbers and its probability.
Emitter light_record(const Scene& scene, const LightSpec& light, const LitRegion& region);

}  // namespace causticl
