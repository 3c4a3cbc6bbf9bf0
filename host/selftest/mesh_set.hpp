// Meshes on the device, each with a tree of its own, and rays through them.
#pragma once

#include <optional>

#include "accel/triangle_transforms.hpp"
#include "selftest/meshes.hpp"
#include "selftest/random_check.hpp"

namespace causticl {

/// A ray for one mesh of a set.
struct MeshRay {
  float origin[3], direction[3];
  float t_max;
  std::uint32_t mesh;
};

/// What it meets first; t is t_max and `triangle` BLOCK_EMPTY where that is nothing. A walk through the tree
/// that was cut short has t = NaN.
struct MeshHit {
  float t;
  std::uint32_t triangle;  // of its mesh
};

class MeshSet {
 public:
  MeshSet(CheckContext& context, std::vector<TriangleMesh> meshes,
          TriangleTest triangle_test = TriangleTest::watertight);

  const TriangleMesh& mesh(std::size_t index) const { return meshes_[index]; }
  const KdTree& tree(std::size_t index) const { return trees_[index]; }
  std::size_t size() const { return meshes_.size(); }

  std::vector<MeshHit> closest(const std::vector<MeshRay>& rays);
  /// As closest(), one ray in sixteen in a packet with others that go about its way, against all triangles of
  /// a small mesh, or in a batch with others that go anywhere. By the watertight test alone.
  std::vector<MeshHit> closest_in_packets(const std::vector<MeshRay>& rays);
  /// 1 for each ray that meets something before t_max, 2 where the walk was cut short.
  std::vector<std::uint32_t> occluded(const std::vector<MeshRay>& rays);
  /// As closest(), by trying every triangle.
  std::vector<MeshHit> brute_force(const std::vector<MeshRay>& rays);

 private:
  std::vector<TriangleMesh> meshes_;
  std::vector<KdTree> trees_;
  cl::Program program_;
  cl::Buffer ranges_, nodes_, blocks_, list_;
  CheckKernel closest_, occluded_, brute_force_;
  std::optional<CheckKernel> packets_;  // of the watertight test
};

/// A vertex of the triangle.
Vec3 triangle_vertex(const TreeTriangle& triangle, int vertex);

/// A ray from `origin` in the direction of `target`, both rounded.
MeshRay make_mesh_ray(Vec3 origin, Vec3 target, std::size_t mesh);

/// The text that kernels begin with where they are to use `test`.
std::string triangle_test_define(TriangleTest test);

/// Blocks that hold the triangles in order, as kernels with `test` want them.
std::vector<TriangleBlock> blocks_in_order(const TriangleMesh& mesh, TriangleTest test);

}  // namespace causticl
