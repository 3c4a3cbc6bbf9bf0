// Hard case 7: the KD-tree against brute force with the same triangle test.
#include "selftest/mesh_set.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

std::vector<TriangleMesh> closed_mesh() { return {torus_mesh(16, 8, 1, 0.4)}; }

/// All of it in one plane, across each axis and aslant.
std::vector<TriangleMesh> coplanar_meshes() {
  std::vector<TriangleMesh> meshes;
  for (int axis = 0; axis < 4; ++axis)
    meshes.push_back(grid_mesh(8, 8, false, [axis](double u, double v) {
      if (axis == 3) return Vec3{u, v, 0.25 * u - 0.5 * v};
      Vec3 p;
      p[axis] = 0.3;
      p[(axis + 1) % 3] = u - 0.5;
      p[(axis + 2) % 3] = v - 0.5;
      return p;
    }));
  return meshes;
}

/// No cut parts them, so that they end in one leaf.
std::vector<TriangleMesh> duplicates() {
  TriangleMesh mesh;
  for (int i = 0; i < 1000; ++i) {
    mesh.push_back(make_triangle({0, 0, 0}, {1, 0, 0.1}, {0, 1, 0}));
    mesh.push_back(make_triangle({1, 1, 0.5}, {1, 0, 0.1}, {0, 1, 0}));
  }
  return {mesh};
}

/// Boxes that share their faces: every plane of the tree holds triangles.
std::vector<TriangleMesh> stacked_boxes() {
  TriangleMesh mesh;
  for (int i = 0; i < 27; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9;
    const Vec3 low{0.25 * x, 0.25 * y, 0.25 * z};
    for (const auto& triangle : box_mesh(low, low + Vec3{0.25, 0.25, 0.25})) mesh.push_back(triangle);
  }
  return {mesh};
}

std::vector<TriangleMesh> few() {
  TriangleMesh boxes = box_mesh({0, 0, 0}, {0.5, 0.5, 0.5});
  for (const auto& triangle : box_mesh({0.5, 0, 0}, {1, 0.5, 0.5})) boxes.push_back(triangle);
  return {boxes,
          {},
          {make_triangle({0, 0, 0}, {1, 0, 0.1}, {0, 1, 0})},
          {make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}};
}

/// A ray of a kind that a tree may get wrong: from a split plane or one number beside it, within it, along
/// the line where two meet, along an axis with zeros of either sign, to a vertex or a point of an edge.
class HardRays {
 public:
  explicit HardRays(const MeshSet& meshes) : meshes_(meshes) {}

  MeshRay operator()(InputRandom& random, std::uint64_t) const {
    const std::uint32_t mesh = random.below(static_cast<std::uint32_t>(meshes_.size()));
    Vec3 origin = around(random, mesh), direction = random.direction();
    const int axis = static_cast<int>(random.below(3)), other = (axis + 1) % 3;
    switch (random.below(8)) {
      case 0:
        break;
      case 1:
        direction = on_mesh(random, mesh) - origin;
        break;
      case 2:
        origin = on_mesh(random, mesh);
        break;
      case 3:
        if (random.below(2)) origin = on_mesh(random, mesh);
        for (int k = 0; k < 3; ++k) direction[k] = (k == axis ? 1 : 0) * (random.below(2) ? -1.0 : 1.0);
        break;
      case 4:
        origin[axis] = plane(random, mesh, axis);
        break;
      case 5:
        origin[axis] = plane(random, mesh, axis);
        direction[axis] = random.below(2) ? -0.0 : 0.0;
        break;
      case 6:
        origin[axis] = plane(random, mesh, axis);
        direction[axis] *= random.scale(-20, -2);
        break;
      default:
        origin[axis] = plane(random, mesh, axis);
        origin[other] = plane(random, mesh, other);
        direction[axis] = direction[other] = 0;
    }
    if (!(length(direction) > 0)) direction = {0, 0, 1};
    direction = normalize(direction);
    MeshRay ray{{}, {}, random.below(5) ? INFINITY : static_cast<float>(random.uniform(0, 1)), mesh};
    for (int k = 0; k < 3; ++k) {
      ray.origin[k] = static_cast<float>(origin[k]);
      ray.direction[k] = static_cast<float>(direction[k]);
    }
    return ray;
  }

 private:
  const MeshSet& meshes_;

  Vec3 around(InputRandom& random, std::size_t mesh) const {
    const Bounds& bounds = meshes_.tree(mesh).bounds;
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const double low = bounds.low[k], high = bounds.high[k], margin = 0.3 * (high - low) + 0.1;
      p[k] = random.uniform(low - margin, high + margin);
    }
    return p;
  }

  Vec3 on_mesh(InputRandom& random, std::size_t mesh) const {
    const TriangleMesh& triangles = meshes_.mesh(mesh);
    if (triangles.empty()) return around(random, mesh);
    const auto& triangle = triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
    const Vec3 a = triangle_vertex(triangle, 0), b = triangle_vertex(triangle, 1),
               c = triangle_vertex(triangle, 2);
    const std::uint32_t kind = random.below(4);
    const double s = kind == 0 ? 0 : random.uniform(), t = kind < 3 ? 0 : random.uniform() * (1 - s);
    return a + (b - a) * s + (c - a) * t;
  }

  /// A plane of some cell, or the number before or after it.
  double plane(InputRandom& random, std::size_t mesh, int axis) const {
    const KdTree& tree = meshes_.tree(mesh);
    const KdNode& node = tree.nodes[random.below(static_cast<std::uint32_t>(tree.nodes.size()))];
    const float x = node.bounds[axis + 3 * random.below(2)][random.below(8)];
    const int step = static_cast<int>(random.below(3)) - 1;
    return next_float(std::fabs(x) < 1e30f ? x : tree.bounds.low[axis], step);
  }
};

/// The same test of the same triangle gives the same bits, so distances must be equal; at equal distances
/// either triangle will do. Any hit must be found for shadow rays as well, and packets and batches must find
/// the same triangle.
template <std::vector<TriangleMesh> (*meshes_of)()>
CheckResult equals_brute_force(CheckContext& context) {
  struct Answers {
    MeshHit tree, packet, brute_force;
    std::uint32_t occluded;
  };
  MeshSet meshes(context, meshes_of());
  return run_random_check(
      context, 0, "", HardRays(meshes),
      [&](const auto& rays) {
        const auto tree = meshes.closest(rays), packet = meshes.closest_in_packets(rays);
        const auto brute_force = meshes.brute_force(rays);
        const auto occluded = meshes.occluded(rays);
        std::vector<Answers> answers(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i)
          answers[i] = {tree[i], packet[i], brute_force[i], occluded[i]};
        return answers;
      },
      [](const MeshRay&, const Answers& found) {
        const std::uint32_t did_hit = found.brute_force.triangle != BLOCK_EMPTY;
        const bool nearest =
            found.tree.t == found.brute_force.t && (found.tree.triangle != BLOCK_EMPTY) == (did_hit != 0);
        const bool same = found.packet.t == found.tree.t && found.packet.triangle == found.tree.triangle;
        return nearest && same && found.occluded == did_hit ? 0.0 : 1.0;
      });
}

}  // namespace

std::vector<Check> kdtree_checks() {
  return {{7, "tree equals brute force: a closed mesh", 2, equals_brute_force<closed_mesh>},
          {7, "tree equals brute force: coplanar meshes", 2, equals_brute_force<coplanar_meshes>},
          {7, "tree equals brute force: 1000 duplicates", 40, equals_brute_force<duplicates>},
          {7, "tree equals brute force: stacked boxes", 2, equals_brute_force<stacked_boxes>},
          {7, "tree equals brute force: few triangles or none", 1, equals_brute_force<few>}};
}

}  // namespace causticl
