#include "device_scene/space_grid.hpp"

#include <cmath>

namespace causticl {

Grid grid_of(const DeviceScene& scene, double cell, double affordable, std::size_t first_bucket) {
  Grid grid{};
  const double across = std::ceil(2 * length_scale(scene) / cell);
  uint* const axes[] = {&grid.nx, &grid.ny, &grid.nz};
  grid.nx = grid.ny = grid.nz = 1;
  std::size_t buckets = 1;
  for (int doublings = 0; *axes[doublings % 3] < across && 2.0 * static_cast<double>(buckets) <= affordable;
       ++doublings) {
    *axes[doublings % 3] *= 2;
    buckets *= 2;
  }
  grid.origin = {static_cast<float>(scene.center.x), static_cast<float>(scene.center.y),
                 static_cast<float>(scene.center.z), static_cast<float>(1 / cell)};
  grid.first_bucket = static_cast<uint>(first_bucket);
  return grid;
}

}  // namespace causticl
