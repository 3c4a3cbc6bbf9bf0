// Packets of rays against every primitive, as photons meet small scenes: the hits of kdtree_closest() to the
// bit. That those are right is checked in test_kdtree.cpp and test_sphere.cpp.
#include <cstring>

#include "kernels/traversal_scene.hpp"

using namespace causticl;

namespace {

// As "closest" of traversal_kernels.hpp, by 32 rays an item, of which the last may have fewer. Arrays have
// NaN where there is no ray.
const std::string kernels = "#include \"shapes/shape.cl\"\n" + std::string(traversal_kernels) + R"(
#include "traversal/brute_force.cl"
#define RAYS 32u
kernel void packets(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                     global const float4 *rays, global float4 *hits, uint count, uint first_shape, global uint *cut_short,
                    global uint *outside) {
  uint first = get_global_id(0) * RAYS;
  if (first >= count) return;
  uint size = min(RAYS, count - first);
  float origin[3][RAYS], direction[3][RAYS], t[RAYS], u[RAYS], v[RAYS];
  uint primitive[RAYS];
  for (uint k = 0; k < RAYS; ++k) {
    float4 from = k < size ? rays[2 * (first + k)] : (float4)NAN, to = k < size ? rays[2 * (first + k) + 1] : (float4)NAN;
    origin[0][k] = from.x, origin[1][k] = from.y, origin[2][k] = from.z;
    direction[0][k] = to.x, direction[1][k] = to.y, direction[2][k] = to.z;
    t[k] = from.w, u[k] = v[k] = 0, primitive[k] = HIT_NONE;
  }
  for (uint k = size; k < RAYS; ++k) u[k] = 42;
  RayArrays arrays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  uint cut = brute_force_closest(nodes, blocks, shapes, 0, first_shape, size, &arrays);
  if (cut > 0) atomic_add(cut_short, cut);
  for (uint k = size; k < RAYS; ++k)
    if (!isnan(t[k]) || u[k] != 42 || primitive[k] != HIT_NONE) *outside = 1;
  for (uint k = 0; k < size; ++k) {
    Hit hit = {t[k], primitive[k], u[k], v[k], 0};
    store_hit(hits, first + k, blocks, hit);
  }
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(kernels, EFFECT_TRIANGLES | EFFECT_SPHERES | EFFECT_DISKS);
  return built;
}

struct BothHits {
  std::vector<TestHit> single, packet;
  uint cut_short;
  uint outside;  // whether arrays were changed where there is no ray
};

BothHits trace(const Traversal& scene, const std::vector<TestRay>& rays, uint first_shape) {
  auto& device = test_device();
  const auto count = static_cast<cl_uint>(rays.size());
  const auto buffer = Traversal::upload(rays);
  const auto single = device.buffer(rays.size() * sizeof(TestHit), "single"),
             packet = device.buffer(rays.size() * sizeof(TestHit), "packet"),
             cut_short = device.buffer(sizeof(uint), "cut short"),
             outside = device.buffer(sizeof(uint), "outside");
  device.clear(cut_short, sizeof(uint));
  device.clear(outside, sizeof(uint));
  run_kernel(program(), "closest", rays.size(), scene.nodes, scene.blocks, scene.shapes, buffer, single,
             count);
  run_kernel(program(), "packets", (rays.size() + 31) / 32, scene.nodes, scene.blocks, scene.shapes, buffer,
             packet, count, first_shape, cut_short, outside);
  return {device.download<TestHit>(single, rays.size()), device.download<TestHit>(packet, rays.size()),
          device.download<uint>(cut_short, 1)[0], device.download<uint>(outside, 1)[0]};
}

void check_packets(const TreeInput& input, const std::vector<Shape>& shapes, RandomInputs& random,
                   uint first_shape = 0) {
  REQUIRE(input.triangles.size() + input.shapes.size() <= BRUTE_FORCE_PRIMITIVES);
  const Traversal scene(input, shapes);
  const auto rays = hard_rays(scene, random, 64 * 1024 - 5);  // the last packet is not full
  const auto [single, packet, cut_short, outside] = trace(scene, rays, first_shape);
  const auto hits = check_same_hits(rays, single, packet);
  CHECK(cut_short == 0);
  CHECK(outside == 0);
  if (!input.triangles.empty() || !input.shapes.empty()) CHECK(hits > rays.size() / 100);
}

void add(TriangleMesh& mesh, const TriangleMesh& more) { mesh.insert(mesh.end(), more.begin(), more.end()); }

}  // namespace

TEST_CASE("incoherent packets against all find what rays find in the tree: a room with boxes and spheres") {
  RandomInputs random(60);
  auto [input, shapes] = random_spheres(random, 3, 0.4);
  add(input.triangles, box_mesh({-1, -1, -1}, {1, 1, 1}));
  add(input.triangles, box_mesh({-0.7, -1, -0.6}, {-0.1, 0.2, 0}));
  check_packets(input, shapes, random);
}

TEST_CASE("incoherent packets against all find what rays find in the tree: as many as there may be") {
  RandomInputs random(61);
  const auto [input, shapes] = random_spheres(random, BRUTE_FORCE_PRIMITIVES, 0.5);
  check_packets(input, shapes, random);
  TriangleMesh mesh = icosphere_mesh(0, 1);
  add(mesh, icosphere_mesh(0, 0.6));
  REQUIRE(mesh.size() == BRUTE_FORCE_PRIMITIVES);
  check_packets({mesh, {}}, {}, random);
}

TEST_CASE(
    "incoherent packets against all find what rays find in the tree: faces shared, duplicates, flat, "
    "needles") {
  RandomInputs random(62);
  TriangleMesh boxes;
  for (int i = 0; i < 3; ++i) add(boxes, box_mesh({0.5 * i, 0, 0}, {0.5 * i + 0.5, 0.5, 0.5}));
  check_packets({boxes, {}}, {}, random);
  check_packets({duplicate_triangles(10), {}}, {}, random);
  TriangleMesh slivers;
  for (int i = 0; i < 20; ++i)
    slivers.push_back(make_triangle({0.05 * i, 0, 0}, {0.05 * i + 1e-5, 0, 1}, {0.05 * i, 1, 0.5}));
  check_packets({slivers, {}}, {}, random);
}

TEST_CASE(
    "incoherent packets against all find what rays find in the tree: shapes after planes, the same sphere "
    "twice") {
  RandomInputs random(63);
  auto [input, shapes] = random_spheres(random, 8, 0.6);
  input.shapes.push_back(input.shapes[2]);
  shapes.push_back(shapes[2]);
  input.shapes.back().shape = 8;
  constexpr uint planes = 70;  // more than bits to tell spheres apart by
  for (auto& entry : input.shapes) entry.shape += planes;
  shapes.insert(shapes.begin(), planes, Shape{});
  check_packets(input, shapes, random, planes);
}

TEST_CASE(
    "incoherent packets against all find what rays find in the tree: far from the origin, one triangle, "
    "none") {
  RandomInputs random(64);
  auto far = box_mesh({1e6, 1e6, -1e6}, {1e6 + 50, 1e6 + 20, 30 - 1e6});
  check_packets({far, {}}, {}, random);
  check_packets({{make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}, {}}, {}, random);
  check_packets({}, {}, random);
}

TEST_CASE(
    "incoherent packets against all find what rays find in the tree: disks among spheres and triangles") {
  RandomInputs random(66);
  auto [input, shapes] = random_spheres(random, 6, 0.4);
  for (uint i = 6; i < 14; ++i) {
    const auto to_world = Transform::scale({random.uniform(0.1, 0.6), random.uniform(0.1, 0.6), 1})
                              .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
                              .followed_by(Transform::rotate(1, i % 2 ? random.uniform(0, 6.28) : 0))
                              .followed_by(Transform::shift(random_offset(random, 0.8)));
    add_disk(input, shapes, to_world);
  }
  add(input.triangles, box_mesh({-1, -1, -1}, {1, 1, 1}));
  check_packets(input, shapes, random);
}

TEST_CASE("what is as far as what a ray has met before changes nothing") {
  RandomInputs random(67);
  auto [input, shapes] = random_spheres(random, 4, 0.5);
  add(input.triangles, box_mesh({-1, -1, -1}, {1, 1, 1}));
  const Traversal scene(input, shapes);
  auto rays = hard_rays(scene, random, 8192);
  const auto first = trace(scene, rays, 0).single;
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].t_max = first[i].t;
  const auto [single, packet, cut_short, outside] = trace(scene, rays, 0);
  CHECK(check_same_hits(rays, single, packet) == 0);
}

TEST_CASE("a ray that is not finite changes nothing for the other fifteen") {
  RandomInputs random(65);
  auto [input, shapes] = random_spheres(random, 4, 0.5);
  add(input.triangles, box_mesh({-1, -1, -1}, {1, 1, 1}));
  const Traversal scene(input, shapes);
  const auto rays = hard_rays(scene, random, 8192);
  auto changed = rays;
  const auto broken = break_rays(changed, 16, random);
  const auto hits = trace(scene, rays, 0).single;
  // Alone, a ray of NaN goes round in the tree up to the limit; here it meets nothing.
  const auto others = trace(scene, changed, 0).packet;
  std::size_t different = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    different += !broken[i] && std::memcmp(&hits[i], &others[i], sizeof(TestHit)) != 0;
  CHECK(different == 0);
}
