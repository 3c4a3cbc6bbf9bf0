// Packets of rays through the tree against single ones: the same hits to the bit, whatever the rays.
#include <cstring>

#include "kernels/traversal_scene.hpp"

using namespace causticl;

namespace {

// Sixteen rays at a time from one of hard_rays(): that ray and others of about its direction, from its origin
// or from the points of a lens around it, some of them the same. Others are sixteen that have nothing in
// common.
std::vector<TestRay> hard_packets(const Traversal& scene, RandomInputs& random, std::size_t packets) {
  const auto seeds = hard_rays(scene, random, 16 * packets);
  const double extent = scene.tree.bounds.high[0] - scene.tree.bounds.low[0];
  std::vector<TestRay> rays;
  for (std::size_t packet = 0; packet < packets; ++packet) {
    const double kind = random.uniform();
    const double spread = std::pow(10, random.uniform(-7, 0));
    const double lens = random.uniform() < 0.7 ? 0 : extent * std::pow(10, random.uniform(-6, -1));
    for (std::size_t i = 0; i < 16; ++i) {
      const TestRay& other = seeds[16 * packet + i];
      if (kind < 0.15) {
        rays.push_back(other);
        continue;
      }
      TestRay ray = seeds[16 * packet];
      if (i > 0 && random.uniform() < 0.9) {
        ray.direction = ray.direction + random_offset(random, spread);
        if (length(ray.direction) > 0) ray.direction = normalize(ray.direction);
        if (lens > 0) ray.origin = ray.origin + random_offset(random, lens);
        if (random.uniform() < 0.1) ray.t_max = other.t_max;
      }
      if (kind > 0.9 && i % 5 == 4) ray = other;
      rays.push_back(ray);
    }
  }
  return rays;
}

void check_packets(const TreeInput& input, const std::vector<Shape>& shapes, RandomInputs& random,
                   std::size_t packets = 6000) {
  Traversal scene(input, shapes);
  auto rays = hard_packets(scene, random, packets);
  rays.resize(rays.size() - 5);  // the last packet is not full
  const auto buffer = Traversal::upload(rays);
  const auto single = scene.closest("closest", buffer, rays.size());
  const auto packet = scene.closest("closest_packets", buffer, rays.size());
  const auto hits = check_same_hits(rays, single, packet);
  if (!input.triangles.empty()) CHECK(hits > rays.size() / 100);
}

void check_mesh_packets(const TriangleMesh& mesh, unsigned seed, std::size_t packets = 6000) {
  RandomInputs random(seed);
  check_packets({mesh, {}}, {}, random, packets);
}

}  // namespace

TEST_CASE("packets find what single rays find: closed meshes") {
  check_mesh_packets(torus_mesh(48, 24, 1, 0.4), 1);
  check_mesh_packets(icosphere_mesh(3, 2), 2);
  check_mesh_packets(torus_knot_mesh(20000), 3);
}

TEST_CASE("packets find what single rays find: coplanar triangles, duplicates, boxes that share faces") {
  for (int axis = 0; axis < 3; ++axis) check_mesh_packets(flat_mesh(axis), 10 + axis);
  check_mesh_packets(duplicate_triangles(300), 20, 1000);
  check_mesh_packets(boxes_that_share_faces(), 21);
}

TEST_CASE("packets find what single rays find: far from the origin, one triangle, none") {
  check_mesh_packets(far_torus(), 30);
  check_mesh_packets({make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}, 31, 2000);
  check_mesh_packets({}, 32, 100);
}

TEST_CASE("packets find what single rays find: spheres among triangles") {
  RandomInputs random(40);
  auto [input, shapes] = random_spheres(random, 300, 0.1);
  check_packets(input, shapes, random, 2000);
  for (const auto& t : torus_mesh(40, 20, 0.8, 0.3)) input.triangles.push_back(t);
  check_packets(input, shapes, random);
}

TEST_CASE("a ray that is not finite changes nothing for the others of its packet") {
  RandomInputs random(50);
  Traversal scene({torus_knot_mesh(4000), {}}, {});
  auto rays = hard_packets(scene, random, 500);
  break_rays(rays, 16, random);
  const auto buffer = Traversal::upload(rays);
  const auto single = scene.closest("closest", buffer, rays.size());
  const auto packet = scene.closest("closest_packets", buffer, rays.size());
  CHECK(std::memcmp(single.data(), packet.data(), single.size() * sizeof(TestHit)) == 0);
}
