#include "selftest/mesh_set.hpp"

#include <stdexcept>

#include "shared/effects.h"

namespace causticl {
namespace {

// A node is tested when it is reached, and again for each child that is left after the nearest two: never
// eight times. So with this limit a ray that takes a wrong turn ends before its time, and its hit is wrong.
constexpr std::size_t step_limit = 1 << 14;

const std::string source = "#define KD_STEP_LIMIT " + std::to_string(step_limit) + R"(
#include "traversal/brute_force.cl"
#include "traversal/geometry.cl"
#include "traversal/kdtree_packet.cl"
#include "traversal/kdtree_stream.cl"
typedef struct {
  float origin[3], direction[3];
  float t_max;
  uint mesh;
} MeshRay;
typedef struct {
  float t;
  uint triangle;
} MeshHit;
// The parts of the buffers that belong to one mesh.
typedef struct {
  uint first_node, first_block;  // of its tree
  uint first_listed, listed;     // blocks with its triangles in order
} MeshRange;

INLINE Ray mesh_ray(global const MeshRay *in) {
  Ray ray = {(real3)(in->origin[0], in->origin[1], in->origin[2]),
             (real3)(in->direction[0], in->direction[1], in->direction[2])};
  return ray;
}
INLINE MeshHit mesh_hit(global const TriangleBlock *blocks, Hit hit) {
  MeshHit result = {hit.diagnostics ? NAN : (float)hit.t, BLOCK_EMPTY};
  if (hit.primitive != HIT_NONE) result.triangle = blocks[hit.primitive / 8u].primitive[hit.primitive % 8u];
  return result;
}

#define MESHES \
  global const MeshRange *ranges, global const KdNode *nodes, global const TriangleBlock *blocks, \
      global const TriangleBlock *list

OUTLINE MeshHit tree_closest(global const MeshRay *in, MESHES) {
  MeshRange range = ranges[in->mesh];
  Hit hit = hit_none(in->t_max);
  kdtree_closest(nodes + range.first_node, blocks + range.first_block, 0, 0, mesh_ray(in), &hit);
  return mesh_hit(blocks + range.first_block, hit);
}
kernel void mesh_closest(global const MeshRay *rays, global MeshHit *hits, uint count, MESHES) {
  uint i = get_global_id(0);
  if (i < count) hits[i] = tree_closest(rays + i, ranges, nodes, blocks, list);
}
#ifndef TRIANGLES_PRECOMPUTED
// As one of sixteen rays from the same point: the others go to all sides of it, some of them far.
OUTLINE MeshHit closest_in_packet(global const MeshRay *in, uint own, MESHES) {
  MeshRange range = ranges[in->mesh];
  RayPacket packet;
  for (uint i = 0; i < PACKET_RAYS; ++i) {
    Ray ray = mesh_ray(in);
    real3 aside = (real3)(i & 1u ? -1 : 1, i & 2u ? -1 : 1, i & 4u ? -1 : 1);
    if (i != own) ray.direction += (i & 8u ? (real)0.1f : (real)0.001f) * aside;
    packet_set(&packet, i, ray, hit_none(in->t_max));
  }
  kdtree_closest_packet(nodes + range.first_node, blocks + range.first_block, 0, 0, &packet, (1u << PACKET_RAYS) - 1u);
  return mesh_hit(blocks + range.first_block, packet_hit(&packet, own));
}
// As one of sixteen that go anywhere, against all of a mesh of few triangles.
OUTLINE MeshHit closest_by_brute_force(global const MeshRay *in, uint own, MESHES) {
  MeshRange range = ranges[in->mesh];
  Ray ray = mesh_ray(in);
  float origin[3][PACKET_RAYS], direction[3][PACKET_RAYS], t[PACKET_RAYS], u[PACKET_RAYS], v[PACKET_RAYS];
  uint primitive[PACKET_RAYS];
  for (uint i = 0; i < PACKET_RAYS; ++i) {
    real3 other = (real3)(i & 1u ? -1 : 1, i & 2u ? -2 : 2, i & 4u ? -3 : 3) * (i & 8u ? (real)0.1f : (real)1);
    real3 d = i == own ? ray.direction : ray.direction.yzx + other;
    origin[0][i] = ray.origin.x, origin[1][i] = ray.origin.y, origin[2][i] = ray.origin.z;
    direction[0][i] = d.x, direction[1][i] = d.y, direction[2][i] = d.z;
    t[i] = in->t_max, u[i] = v[i] = 0, primitive[i] = HIT_NONE;
  }
  RayArrays rays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  uint cut_short = brute_force_closest(nodes + range.first_node, blocks + range.first_block, 0, 0, 0, PACKET_RAYS, &rays);
  Hit hit = {t[own], primitive[own], u[own], v[own], cut_short > 0 ? DIAGNOSTIC_TRAVERSAL_BOUND : 0u};
  return mesh_hit(blocks + range.first_block, hit);
}
#ifdef KDTREE_STREAMS
// As one of a batch that go anywhere.
OUTLINE MeshHit closest_in_stream(global const MeshRay *in, uint own, MESHES) {
  MeshRange range = ranges[in->mesh];
  Ray ray = mesh_ray(in);
  float origin[3][STREAM_CAPACITY], direction[3][STREAM_CAPACITY], t[STREAM_CAPACITY], u[STREAM_CAPACITY], v[STREAM_CAPACITY];
  uint primitive[STREAM_CAPACITY], diagnostics[STREAM_CAPACITY];
  for (uint i = 0; i < STREAM_CAPACITY; ++i) {
    real3 other = (real3)(i & 1u ? -1 : 1, i & 2u ? -2 : 2, i & 4u ? -3 : 3) * (0.05f * (1u + i / 8u));
    real3 d = i == own ? ray.direction : ray.direction.yzx + other;
    origin[0][i] = ray.origin.x, origin[1][i] = ray.origin.y, origin[2][i] = ray.origin.z;
    direction[0][i] = d.x, direction[1][i] = d.y, direction[2][i] = d.z;
    t[i] = in->t_max, u[i] = v[i] = 0, primitive[i] = HIT_NONE;
  }
  RayArrays rays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  kdtree_stream(nodes + range.first_node, blocks + range.first_block, 0, 0, &rays, STREAM_CAPACITY, diagnostics);
  Hit hit = {t[own], primitive[own], u[own], v[own], diagnostics[own]};
  return mesh_hit(blocks + range.first_block, hit);
}
#else
#define closest_in_stream(in, own, ranges, nodes, blocks, list) tree_closest(in, ranges, nodes, blocks, list)
#endif
// A packet takes sixteen times as long as a ray: one ray in sixteen goes in one, or every fourth of these in a batch
// (singly where the device has none), and every second, where a mesh has few triangles, against all of them.
kernel void mesh_packets(global const MeshRay *rays, global MeshHit *hits, uint count, MESHES) {
  uint i = get_global_id(0), own = i / PACKET_RAYS % PACKET_RAYS;
  if (i >= count) return;
  if (i % PACKET_RAYS != 0)
    hits[i] = tree_closest(rays + i, ranges, nodes, blocks, list);
  else if (i % (2u * PACKET_RAYS) == 0 && 8u * ranges[rays[i].mesh].listed <= BRUTE_FORCE_PRIMITIVES)
    hits[i] = closest_by_brute_force(rays + i, own, ranges, nodes, blocks, list);
  else if (i % (4u * PACKET_RAYS) == PACKET_RAYS)
    hits[i] = closest_in_stream(rays + i, i / (4u * PACKET_RAYS) % STREAM_CAPACITY, ranges, nodes, blocks, list);
  else
    hits[i] = closest_in_packet(rays + i, own, ranges, nodes, blocks, list);
}
#endif
OUTLINE uint tree_occluded(global const MeshRay *in, MESHES) {
  MeshRange range = ranges[in->mesh];
  uint diagnostics = 0;
  uint occluded = kdtree_occluded(nodes + range.first_node, blocks + range.first_block, 0, 0, mesh_ray(in), in->t_max,
                                  &diagnostics);
  return diagnostics ? 2u : occluded;
}
kernel void mesh_occluded(global const MeshRay *rays, global uint *did_hit, uint count, MESHES) {
  uint i = get_global_id(0);
  if (i < count) did_hit[i] = tree_occluded(rays + i, ranges, nodes, blocks, list);
}
OUTLINE MeshHit brute_force(global const MeshRay *in, MESHES) {
  MeshRange range = ranges[in->mesh];
  TriangleRay ray = triangle_ray(mesh_ray(in));
  Hit hit = hit_none(in->t_max);
  for (uint b = 0; b < range.listed; ++b) block_closest(list + range.first_listed, b * BLOCK_STRIDE, ray, &hit);
  return mesh_hit(list + range.first_listed, hit);
}
kernel void mesh_brute_force(global const MeshRay *rays, global MeshHit *hits, uint count, MESHES) {
  uint i = get_global_id(0);
  if (i < count) hits[i] = brute_force(rays + i, ranges, nodes, blocks, list);
}
)";

struct MeshRange {
  cl_uint first_node, first_block, first_listed, listed;
};

std::vector<KdTree> built(const std::vector<TriangleMesh>& meshes, unsigned threads, TriangleTest test) {
  std::vector<KdTree> trees;
  for (const auto& mesh : meshes) {
    trees.push_back(build_kdtree({mesh, {}}, threads));
    if (trees.back().nodes.size() * 8 > step_limit) throw std::logic_error("a mesh is too large for its set");
    if (test == TriangleTest::precomputed) add_triangle_transforms(trees.back(), threads);
  }
  return trees;
}

}  // namespace

Vec3 triangle_vertex(const TreeTriangle& triangle, int vertex) {
  const auto& p = triangle.position[vertex];
  return {p[0], p[1], p[2]};
}

MeshRay make_mesh_ray(Vec3 origin, Vec3 target, std::size_t mesh) {
  MeshRay ray{{}, {}, INFINITY, static_cast<std::uint32_t>(mesh)};
  for (int k = 0; k < 3; ++k) ray.origin[k] = static_cast<float>(origin[k]);
  const Vec3 from{ray.origin[0], ray.origin[1], ray.origin[2]};
  const Vec3 direction = target == from ? Vec3{0, 0, 1} : normalize(target - from);
  for (int k = 0; k < 3; ++k) ray.direction[k] = static_cast<float>(direction[k]);
  return ray;
}

std::string triangle_test_define(TriangleTest test) {
  return test == TriangleTest::precomputed ? "#define TRIANGLES_PRECOMPUTED\n" : "";
}

std::vector<TriangleBlock> blocks_in_order(const TriangleMesh& mesh, TriangleTest test) {
  KdTree list;
  list.blocks.resize((mesh.size() + 7) / 8);
  for (std::size_t i = 0; i < list.blocks.size() * 8; ++i) {
    auto& block = list.blocks[i / 8];
    block.primitive[i % 8] = i < mesh.size() ? static_cast<std::uint32_t>(i) : BLOCK_EMPTY;
    for (int v = 0; v < 3; ++v)
      for (int k = 0; k < 3; ++k)
        block.position[v][k][i % 8] = i < mesh.size() ? mesh[i].position[v][k] : NAN;
  }
  if (test == TriangleTest::precomputed) add_triangle_transforms(list, 1);
  return list.blocks;
}

MeshSet::MeshSet(CheckContext& context, std::vector<TriangleMesh> meshes, TriangleTest triangle_test)
    : meshes_(std::move(meshes)),
      trees_(built(meshes_, context.threads, triangle_test)),
      program_(context.program(triangle_test_define(triangle_test) + source, EFFECT_TRIANGLES)),
      closest_(context, program_, "mesh_closest"),
      occluded_(context, program_, "mesh_occluded"),
      brute_force_(context, program_, "mesh_brute_force") {
  if (triangle_test == TriangleTest::watertight) packets_.emplace(context, program_, "mesh_packets");
  std::vector<MeshRange> ranges;
  std::vector<KdNode> nodes;
  std::vector<TriangleBlock> blocks, list;
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    const auto listed = blocks_in_order(meshes_[i], triangle_test);
    ranges.push_back({static_cast<cl_uint>(nodes.size()), static_cast<cl_uint>(blocks.size()),
                      static_cast<cl_uint>(list.size()), static_cast<cl_uint>((meshes_[i].size() + 7) / 8)});
    nodes.insert(nodes.end(), trees_[i].nodes.begin(), trees_[i].nodes.end());
    blocks.insert(blocks.end(), trees_[i].blocks.begin(), trees_[i].blocks.end());
    list.insert(list.end(), listed.begin(), listed.end());
  }
  Device& device = context.device;
  ranges_ = device.upload(ranges, "ranges of meshes");
  nodes_ = device.upload(nodes, "tree nodes");
  blocks_ = device.upload(blocks, "triangle blocks");
  list_ = device.upload(list, "triangle blocks");
}

std::vector<MeshHit> MeshSet::closest(const std::vector<MeshRay>& rays) {
  return closest_.with(ranges_, nodes_, blocks_, list_).run<MeshHit>(rays);
}

std::vector<MeshHit> MeshSet::closest_in_packets(const std::vector<MeshRay>& rays) {
  return packets_.value().with(ranges_, nodes_, blocks_, list_).run<MeshHit>(rays);
}

std::vector<std::uint32_t> MeshSet::occluded(const std::vector<MeshRay>& rays) {
  return occluded_.with(ranges_, nodes_, blocks_, list_).run<std::uint32_t>(rays);
}

std::vector<MeshHit> MeshSet::brute_force(const std::vector<MeshRay>& rays) {
  return brute_force_.with(ranges_, nodes_, blocks_, list_).run<MeshHit>(rays);
}

}  // namespace causticl
