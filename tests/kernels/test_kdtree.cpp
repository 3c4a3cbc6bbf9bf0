// The tree against brute force with the same triangle test, on meshes that are hard for a tree.
#include <cstring>
#include <sstream>

#include "kernels/traversal_scene.hpp"

using namespace causticl;

namespace {

void check_against_brute_force(Traversal& scene, RandomInputs& random, std::size_t count) {
  const auto rays = hard_rays(scene, random, count);
  const auto results = scene.trace(rays);
  std::ostringstream examples;
  examples.precision(9);
  std::size_t lost = 0, extra = 0, occlusion = 0, hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& tree = results.tree[i];
    const auto& brute = results.brute[i];
    // The same test on the same triangle gives the same bits: distances must be equal.
    const bool worse = tree.t > brute.t, better = tree.t < brute.t;
    if ((worse || better) && lost + extra < 3) {
      const auto& r = rays[i];
      examples << "\nray " << i << ": o " << r.origin.x << " " << r.origin.y << " " << r.origin.z << " d "
               << r.direction.x << " " << r.direction.y << " " << r.direction.z << " tree " << tree.t
               << " of " << tree.primitive << " brute force " << brute.t << " of " << brute.primitive;
    }
    lost += worse;
    extra += better;
    hits += brute.primitive != BLOCK_EMPTY;
    occlusion += (brute.primitive != BLOCK_EMPTY) != (results.occluded[i] != 0);
  }
  INFO("depth " << scene.tree.depth << ", " << scene.tree.nodes.size() << " nodes, " << hits << " hits"
                << examples.str());
  CHECK(scene.tree.depth <= KD_LEVELS);
  CHECK(lost == 0);
  CHECK(extra == 0);
  CHECK(occlusion == 0);
  if (!scene.input.triangles.empty() || !scene.input.shapes.empty()) CHECK(hits > count / 100);
}

void check_mesh(const TriangleMesh& mesh, unsigned seed, std::size_t count = 100000) {
  RandomInputs random(seed);
  Traversal scene({mesh, {}}, {});
  check_against_brute_force(scene, random, count);
}

}  // namespace

TEST_CASE("the tree finds what brute force finds: closed meshes") {
  check_mesh(torus_mesh(48, 24, 1, 0.4), 1);
  check_mesh(icosphere_mesh(3, 2), 2);
  check_mesh(torus_knot_mesh(4000), 3);
}

TEST_CASE("the tree finds what brute force finds: flat meshes") {
  for (int axis = 0; axis < 3; ++axis) check_mesh(flat_mesh(axis), 10 + axis);
}

TEST_CASE("the tree finds what brute force finds: duplicates, needles, thin boxes, walls round a mesh") {
  SECTION("five thousand times the same two triangles") {
    TriangleMesh mesh;
    for (int i = 0; i < 2500; ++i) {
      mesh.push_back(make_triangle({0, 0, 0}, {1, 0, 0.1}, {0, 1, 0}));
      mesh.push_back(make_triangle({1, 1, 0.5}, {1, 0, 0.1}, {0, 1, 0}));
    }
    check_mesh(mesh, 20, 2000);
  }
  SECTION("needles") {
    RandomInputs random(21);
    TriangleMesh mesh;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const Vec3 b{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      mesh.push_back(
          make_triangle(a, b, b + random_direction(random) * std::pow(10, random.uniform(-6, -1))));
    }
    check_mesh(mesh, 21);
  }
  SECTION("thin boxes") {
    RandomInputs random(22);
    TriangleMesh mesh;
    for (int i = 0; i < 100; ++i) {
      const Vec3 c{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      Vec3 h{0.4, 0.4, 0.4};
      h[i % 3] = i % 2 ? 0 : 1e-5;
      for (int axis = 0; axis < 3; ++axis)
        for (int side : {-1, 1}) {
          Vec3 corner[4];
          for (int k = 0; k < 4; ++k) {
            corner[k] = c;
            corner[k][axis] += side * h[axis];
            corner[k][(axis + 1) % 3] += (k & 1 ? 1 : -1) * h[(axis + 1) % 3];
            corner[k][(axis + 2) % 3] += (k & 2 ? 1 : -1) * h[(axis + 2) % 3];
          }
          mesh.push_back(make_triangle(corner[0], corner[1], corner[3]));
          mesh.push_back(make_triangle(corner[0], corner[3], corner[2]));
        }
    }
    check_mesh(mesh, 22);
  }
  SECTION("a mesh in a large room") {
    auto mesh = torus_mesh(40, 20, 1, 0.3);
    for (const auto& t : grid_mesh(1, 1, false, [](double u, double v) {
           return Vec3{u * 40 - 20, v * 40 - 20, -1};
         }))
      mesh.push_back(t);
    for (const auto& t : grid_mesh(1, 1, false, [](double u, double v) {
           return Vec3{-20, u * 40 - 20, v * 40 - 1};
         }))
      mesh.push_back(t);
    check_mesh(mesh, 23);
  }
  SECTION("a mesh moved by a million") {
    auto mesh = torus_mesh(40, 20, 100, 30);
    for (auto& t : mesh)
      for (auto& vertex : t.position) vertex[0] += 1e6f;
    check_mesh(mesh, 24);
  }
}

TEST_CASE("the tree finds what brute force finds: one triangle, none, and such without area") {
  check_mesh({make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})}, 30, 20000);
  check_mesh({}, 31, 1000);
  const TriangleMesh degenerate(100, make_triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2}));
  const auto tree = build_kdtree({degenerate, {}}, 1);
  CHECK(tree.skipped == 100);
  CHECK(tree.references == 0);
  TriangleMesh broken(100, make_triangle({0, 0, 0}, {1, NAN, 1}, {2, 0, INFINITY}));
  CHECK(build_kdtree({broken, {}}, 2).skipped == 100);
}

TEST_CASE("the tree finds what brute force finds: spheres, and spheres among triangles") {
  RandomInputs random(40);
  auto [input, shapes] = random_spheres(random, 1000, 0.1);
  {
    Traversal scene(input, shapes);
    check_against_brute_force(scene, random, 50000);
  }
  for (const auto& t : torus_mesh(40, 20, 0.8, 0.3)) input.triangles.push_back(t);
  Traversal scene(input, shapes);
  check_against_brute_force(scene, random, 50000);
}

TEST_CASE("the tree depends on the input alone, not on the number of threads") {
  const auto mesh = torus_knot_mesh(60000);
  const auto one = build_kdtree({mesh, {}}, 1);
  for (unsigned threads : {2u, 3u, 8u}) {
    const auto other = build_kdtree({mesh, {}}, threads);
    REQUIRE(one.nodes.size() == other.nodes.size());
    REQUIRE(one.blocks.size() == other.blocks.size());
    CHECK(std::memcmp(one.nodes.data(), other.nodes.data(), one.nodes.size() * sizeof(KdNode)) == 0);
    CHECK(std::memcmp(one.blocks.data(), other.blocks.data(), one.blocks.size() * sizeof(TriangleBlock)) ==
          0);
  }
}
