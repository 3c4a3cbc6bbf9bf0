// What the tests of gathering share: photons and points, and the sums around these on the device and by brute
// force.
#pragma once

#include "selftest/photon_grid.hpp"
#include "vector_inputs.hpp"

namespace causticl {

inline cl::Program& gather_program() {
  static cl::Program built = build_test_program(gather_source);
  return built;
}

inline std::vector<GatherSums> gather(const std::vector<GatherPoint>& points,
                                      const std::vector<Photon>& photons, const Grid& grid, float radius2) {
  return gather_photons(test_device(), gather_program(), points, photons, grid, radius2);
}

inline std::vector<GatherSums> brute_force(const std::vector<GatherPoint>& points,
                                           const std::vector<Photon>& photons, float radius2) {
  std::vector<GatherSums> result;
  for (const GatherPoint& point : points) result.push_back(gather_brute_force(point, photons, radius2));
  return result;
}

/// Where photons and points lie: in a box of half size `extent` about `center`, normals along the axes or
/// anyhow.
struct Space {
  Vec3 center;
  double extent;
  Vec3 position(RandomInputs& random) const {
    return center + Vec3{random.uniform(-extent, extent), random.uniform(-extent, extent),
                         random.uniform(-extent, extent)};
  }
};

inline uint random_normal(RandomInputs& random) {
  if (random.uniform() < 0.5) return pack_normal(random_direction(random));
  Vec3 n;
  n[static_cast<int>(random.uniform(0, 3))] = random.uniform() < 0.5 ? -1 : 1;
  return pack_normal(n);
}

inline Photon photon_at(RandomInputs& random, Vec3 p) {
  return {{float(p.x), float(p.y), float(p.z)},
          random_normal(random),
          static_cast<uint>(random.engine()),
          static_cast<uint>(random.engine()) & 0xffffu};
}

/// Points, half of them beside photons, so that the smallest radii find some too.
inline std::vector<GatherPoint> points_near(RandomInputs& random, const std::vector<Photon>& photons,
                                            const Space& space, double radius, std::size_t count) {
  std::vector<GatherPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p = space.position(random);
    uint normal = random_normal(random);
    if (i % 2 && !photons.empty()) {
      const Photon& photon = photons[random.engine() % photons.size()];
      p = Vec3{photon.position[0], photon.position[1], photon.position[2]} +
          random_direction(random) * (radius * random.uniform());
      normal = photon.normal;
    }
    points.push_back({float(p.x), float(p.y), float(p.z), normal});
  }
  return points;
}

}  // namespace causticl
