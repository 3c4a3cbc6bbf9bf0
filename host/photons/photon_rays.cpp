#include "photons/photon_rays.hpp"

#include <algorithm>

#include "scene/shape_kind.hpp"
#include "shared/types.h"
#include "world/flat_scene.hpp"

namespace causticl {

bool brute_force_chosen(PhotonRays wanted, const Scene& scene, const Device& device,
                        const KernelOptions& options) {
  static_assert(BRUTE_FORCE_PRIMITIVES <= 64, "brute_force.cl has a bit for each");
  const bool batched = std::none_of(scene.objects.begin(), scene.objects.end(), [](const Object& object) {
    return (effect_of(object.shape) & EFFECTS_NOT_BATCHED(SCALAR_HITS)) != 0;
  });
  const bool possible = batched && bounded_primitives(scene) <= BRUTE_FORCE_PRIMITIVES &&
                        options.precision == Precision::float32 &&
                        options.triangle_test == TriangleTest::watertight && device.has_serial_work_items();
  // A GPU's items are not helped by vectors within each.
  return possible && (wanted == PhotonRays::brute_force ||
                      (wanted == PhotonRays::automatic && device.info().type == "cpu"));
}

std::string photon_rays_text(const KernelOptions& options, const Device& device) {
  if (options.brute_force) return "sixteen at a time, each meets every primitive";
  const bool streams = device.has_serial_work_items() && options.precision == Precision::float32 &&
                       options.triangle_test == TriangleTest::watertight;
  return streams ? "in streams through the tree" : "one at a time";
}

}  // namespace causticl
