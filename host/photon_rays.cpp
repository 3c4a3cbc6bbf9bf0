#include "photon_rays.hpp"

#include <optional>

#include "types.h"

namespace causticl {
namespace {

/// Bounded primitives as build_world() makes them; none where a revolved curve is among them.
std::optional<std::size_t> primitives_but_curves(const Scene& scene) {
  std::size_t count = 0;
  for (const auto& object : scene.objects) switch (object.shape) {
      case Object::Shape::plane:
        break;
      case Object::Shape::sphere:
      case Object::Shape::disk:
        count += 1;
        break;
      case Object::Shape::rectangle:
        count += 2;
        break;
      case Object::Shape::box:
        count += 12;
        break;
      case Object::Shape::mesh:
        count += scene.meshes[object.mesh].triangles();
        break;
      case Object::Shape::bezier:
        return {};
    }
  return count;
}

}  // namespace

bool brute_force_chosen(PhotonRays wanted, const Scene& scene, const Device& device,
                        const KernelOptions& options) {
  const auto primitives = primitives_but_curves(scene);
  const bool possible = primitives && *primitives > 0 && *primitives <= BRUTE_FORCE_PRIMITIVES &&
                        options.precision == Precision::float32 &&
                        options.triangle_test == TriangleTest::watertight;
  // A GPU's items are not helped by vectors within each.
  return possible && (wanted == PhotonRays::brute_force ||
                      (wanted == PhotonRays::automatic && device.info().type == "cpu"));
}

std::string photon_rays_text(const KernelOptions& options) {
  return options.brute_force_photons ? "sixteen at a time, each meets every primitive" : "one by one";
}

}  // namespace causticl
