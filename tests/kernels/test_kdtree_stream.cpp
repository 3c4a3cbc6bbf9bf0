// Waves of rays through the tree against single ones: the same hits to the bit, whatever the rays.
#include <cstring>

#include "kernels/traversal_scene.hpp"

using namespace causticl;

namespace {

// As "closest" of traversal_kernels.hpp, by batches: item number i traces a batch of 1 + i % STREAM_CAPACITY
// rays and then the rest of STREAM_CAPACITY. Arrays have NaN where there is no ray, but what is found there
// must stay.
const std::string kernels =
    "#define KD_STEP_LIMIT (1u << 12)\n" + std::string(sphere_stand_in) + traversal_kernels + R"(
#include "traversal/kdtree_stream.cl"
#ifdef KDTREE_STREAMS
uint batch(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
          global const float4 *rays, global float4 *hits, global uint *diagnostics, uint first, uint size) {
  float origin[3][STREAM_CAPACITY], direction[3][STREAM_CAPACITY], t[STREAM_CAPACITY], u[STREAM_CAPACITY], v[STREAM_CAPACITY];
  uint primitive[STREAM_CAPACITY], found[STREAM_CAPACITY], changed = 0;
  for (uint k = 0; k < STREAM_CAPACITY; ++k) {
    float4 from = k < size ? rays[2 * (first + k)] : (float4)NAN, to = k < size ? rays[2 * (first + k) + 1] : (float4)NAN;
    origin[0][k] = from.x, origin[1][k] = from.y, origin[2][k] = from.z;
    direction[0][k] = to.x, direction[1][k] = to.y, direction[2][k] = to.z;
    t[k] = k < size ? from.w : 42, u[k] = v[k] = k < size ? 0 : 42, primitive[k] = HIT_NONE, found[k] = 42;
  }
  RayArrays arrays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  kdtree_stream(nodes, blocks, shapes, 0, &arrays, size, found);
  for (uint k = size; k < STREAM_CAPACITY; ++k)
    changed |= t[k] != 42 || u[k] != 42 || v[k] != 42 || primitive[k] != HIT_NONE || found[k] != 42;
  for (uint k = 0; k < size; ++k) {
    Hit hit = {t[k], primitive[k], u[k], v[k], 0};
    store_hit(hits, first + k, blocks, hit);
    diagnostics[first + k] = found[k];
  }
  return changed;
}
kernel void batches(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                  global const float4 *rays, global float4 *hits, uint count, global uint *diagnostics, global uint *outside) {
  uint first = (uint)get_global_id(0) * STREAM_CAPACITY;
  if (first >= count) return;
  uint size = min(STREAM_CAPACITY, count - first), head = min(size, 1u + (uint)get_global_id(0) % STREAM_CAPACITY);
  uint changed = batch(nodes, blocks, shapes, rays, hits, diagnostics, first, head);
  if (head < size) changed |= batch(nodes, blocks, shapes, rays, hits, diagnostics, first + head, size - head);
  if (changed) *outside = 1;
}
#endif
kernel void single(global const KdNode *nodes, global const TriangleBlock *blocks, global const Shape *shapes,
                   global const float4 *rays, global float4 *hits, uint count, global uint *diagnostics) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Hit hit = hit_none(rays[2 * i].w);
  kdtree_closest(nodes, blocks, shapes, 0, load_ray(rays, i), &hit);
  diagnostics[i] = hit.diagnostics;
  store_hit(hits, i, blocks, hit);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(kernels, EFFECT_TRIANGLES | EFFECT_SPHERES | EFFECT_DISKS);
  return built;
}

// Only devices that run the items of a work-group in turn have batches.
bool has_waves() {
  if (test_device().has_serial_work_items()) return true;
  WARN("no batches on this device: not tested");
  return false;
}

struct StreamHits {
  std::vector<TestHit> single, batch;
  std::vector<uint> single_diagnostics, stream_diagnostics;
  uint outside;  // whether arrays were changed where there is no ray
};

StreamHits trace(const Traversal& scene, const std::vector<TestRay>& rays) {
  auto& device = test_device();
  const auto count = static_cast<cl_uint>(rays.size());
  const auto buffer = Traversal::upload(rays);
  const auto single = device.buffer(rays.size() * sizeof(TestHit), "single"),
             batch = device.buffer(rays.size() * sizeof(TestHit), "batch"),
             single_diagnostics = device.buffer(rays.size() * sizeof(uint), "faults of single rays"),
             stream_diagnostics = device.buffer(rays.size() * sizeof(uint), "faults"),
             outside = device.buffer(sizeof(uint), "outside");
  device.clear(outside, sizeof(uint));
  run_kernel(program(), "single", rays.size(), scene.nodes, scene.blocks, scene.shapes, buffer, single, count,
             single_diagnostics);
  run_kernel(program(), "batches", (rays.size() + 63) / 64, scene.nodes, scene.blocks, scene.shapes, buffer,
             batch, count, stream_diagnostics, outside);
  return {device.download<TestHit>(single, rays.size()), device.download<TestHit>(batch, rays.size()),
          device.download<uint>(single_diagnostics, rays.size()),
          device.download<uint>(stream_diagnostics, rays.size()), device.download<uint>(outside, 1)[0]};
}

void check_streams(const TreeInput& input, const std::vector<Shape>& shapes, RandomInputs& random,
                   std::size_t count = 96 * 1024 - 5) {
  if (!has_waves()) return;
  const Traversal scene(input, shapes);
  const auto rays = hard_rays(scene, random, count);
  const auto found = trace(scene, rays);
  const auto hits = check_same_hits(rays, found.single, found.batch);
  CHECK(found.single_diagnostics == found.stream_diagnostics);
  CHECK(found.outside == 0);
  if (!input.triangles.empty() || !input.shapes.empty()) CHECK(hits > rays.size() / 100);
}

void check_mesh_waves(const TriangleMesh& mesh, unsigned seed, std::size_t count = 96 * 1024 - 5) {
  RandomInputs random(seed);
  check_streams({mesh, {}}, {}, random, count);
}

}  // namespace

TEST_CASE("batches find what single rays find: closed meshes") {
  check_mesh_waves(torus_mesh(48, 24, 1, 0.4), 1);
  check_mesh_waves(icosphere_mesh(3, 2), 2);
  check_mesh_waves(torus_knot_mesh(20000), 3);
}

TEST_CASE("batches find what single rays find: coplanar triangles, duplicates, boxes that share faces") {
  for (int axis = 0; axis < 3; ++axis) check_mesh_waves(flat_mesh(axis), 10 + axis, 32 * 1024);
  check_mesh_waves(duplicate_triangles(300), 20, 16 * 1024);
  check_mesh_waves(boxes_that_share_faces(), 21);
}

TEST_CASE("batches find what single rays find: far from the origin, one triangle, none") {
  check_mesh_waves(far_torus(), 30);
  check_mesh_waves({make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}, 31, 32 * 1024);
  check_mesh_waves({}, 32, 1000);
}

TEST_CASE("batches find what single rays find: spheres among triangles") {
  RandomInputs random(40);
  auto [input, shapes] = random_spheres(random, 300, 0.1);
  check_streams(input, shapes, random, 32 * 1024);
  for (const auto& t : torus_mesh(40, 20, 0.8, 0.3)) input.triangles.push_back(t);
  check_streams(input, shapes, random);
}

TEST_CASE("batches find what single rays find: disks among spheres and triangles") {
  RandomInputs random(43);
  auto [input, shapes] = random_spheres(random, 40, 0.2);
  for (uint i = 40; i < 120; ++i) {
    const auto to_world = Transform::scale({random.uniform(0.1, 0.4), random.uniform(0.1, 0.4), 1})
                              .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
                              .followed_by(Transform::shift(random_offset(random, 0.9)));
    add_disk(input, shapes, to_world);
  }
  for (const auto& t : torus_mesh(40, 20, 0.8, 0.3)) input.triangles.push_back(t);
  check_streams(input, shapes, random);
}

TEST_CASE("a batch finds nothing that is as far as what its rays have met before") {
  if (!has_waves()) return;
  RandomInputs random(41);
  const Traversal scene({torus_knot_mesh(4000), {}}, {});
  auto rays = hard_rays(scene, random, 16 * 1024);
  const auto first = trace(scene, rays).single;
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].t_max = first[i].t;
  const auto found = trace(scene, rays);
  CHECK(check_same_hits(rays, found.single, found.batch) == 0);
}

TEST_CASE("a ray that is not finite is cut short, and changes nothing for the others of its batch") {
  if (!has_waves()) return;
  RandomInputs random(42);
  const Traversal scene({torus_knot_mesh(4000), {}}, {});
  const auto rays = hard_rays(scene, random, 64 * 64);
  auto changed = rays;
  const auto broken = break_rays(changed, 64, random);
  const auto whole = trace(scene, rays), found = trace(scene, changed);
  std::size_t different = 0, cut_short = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    different += !broken[i] && (std::memcmp(&whole.single[i], &found.batch[i], sizeof(TestHit)) != 0 ||
                                found.stream_diagnostics[i] != 0);
    cut_short += found.stream_diagnostics[i] != 0;
  }
  CHECK(different == 0);
  // Some of them walk round for ever.
  CHECK(cut_short > 0);
  CHECK(found.stream_diagnostics == found.single_diagnostics);
}
