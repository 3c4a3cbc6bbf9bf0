// The tree against brute force with the same triangle test, on meshes that are hard for a tree.
#include <cstring>
#include <sstream>

#include "device_fixture.hpp"
#include "kernels/traversal_kernels.hpp"
#include "mesh_set.hpp"
#include "meshes.hpp"

using namespace causticl;

namespace {

struct TestRay {
  Vec3 origin, direction;
  float t_max = INFINITY;
};

struct TestHit {
  float t, u, v;
  uint primitive;
};

// A scene with its tree on the device, and rays through it.
struct Traversal {
  cl::Program& program;
  TreeInput input;
  KdTree tree;
  cl::Buffer nodes, blocks, list, shapes;

  Traversal(const TreeInput& in, const std::vector<Shape>& shape_list)
      : program(shared_program()), input(in), tree(build_kdtree(in, 2)) {
    nodes = test_device().upload(tree.nodes, "nodes");
    blocks = test_device().upload(tree.blocks, "blocks");
    list = test_device().upload(blocks_in_order(in.triangles, TriangleTest::watertight), "list");
    shapes = test_device().upload(shape_list, "shapes");
  }

  static cl::Program& shared_program() {
    static cl::Program program = build_test_program(std::string(sphere_stand_in) + traversal_kernels);
    return program;
  }

  struct Results {
    std::vector<TestHit> tree, brute;
    std::vector<uint> occluded;
  };

  Results trace(const std::vector<TestRay>& rays) {
    std::vector<float4> data;
    for (const auto& ray : rays) {
      data.push_back({static_cast<float>(ray.origin.x), static_cast<float>(ray.origin.y),
                      static_cast<float>(ray.origin.z), ray.t_max});
      data.push_back({static_cast<float>(ray.direction.x), static_cast<float>(ray.direction.y),
                      static_cast<float>(ray.direction.z), 0});
    }
    auto& device = test_device();
    const auto ray_buffer = device.upload(data, "rays");
    const auto hits = device.buffer(rays.size() * sizeof(TestHit), "hits");
    const auto flags = device.buffer(rays.size() * sizeof(uint), "flags");
    const auto count = static_cast<cl_uint>(rays.size());
    Results results;
    run_kernel(program, "closest", rays.size(), nodes, blocks, shapes, ray_buffer, hits, count);
    results.tree = device.download<TestHit>(hits, rays.size());
    run_kernel(program, "occluded", rays.size(), nodes, blocks, shapes, ray_buffer, flags, count);
    results.occluded = device.download<uint>(flags, rays.size());
    run_kernel(program, "brute_force", rays.size(), list,
               static_cast<cl_uint>((input.triangles.size() + 7) / 8), shapes,
               static_cast<cl_uint>(input.shapes.size()), ray_buffer, hits, count);
    results.brute = device.download<TestHit>(hits, rays.size());
    return results;
  }
};

Vec3 random_direction(RandomInputs& random) {
  for (;;) {
    const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double n = length(v);
    if (n > 0.01 && n < 1) return v / n;
  }
}

// Rays of every kind that a tree can get wrong: random, along axes with +0 and -0, from vertices and split
// planes, within planes of the tree, at vertices and edges, with short t_max.
std::vector<TestRay> hard_rays(const Traversal& scene, RandomInputs& random, std::size_t count) {
  const auto& bounds = scene.tree.bounds;
  const auto inside = [&] {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
      const double low = bounds.low[k], high = bounds.high[k], margin = 0.3 * (high - low) + 0.01;
      p[k] = random.uniform(low - margin, high + margin);
    }
    return p;
  };
  const auto pick = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(n)));
  };
  const auto on_mesh = [&]() -> Vec3 {  // a vertex, or a point of an edge or inside
    if (scene.input.triangles.empty()) return inside();
    const auto& t = scene.input.triangles[pick(scene.input.triangles.size())].position;
    const double kind = random.uniform();
    const double a = kind < 0.4 ? 0 : random.uniform(), b = kind < 0.7 ? 0 : random.uniform() * (1 - a);
    Vec3 p;
    for (int k = 0; k < 3; ++k)
      p[k] = static_cast<float>(t[0][k] + a * (double(t[1][k]) - t[0][k]) + b * (double(t[2][k]) - t[0][k]));
    return p;
  };
  const auto plane = [&](int k) -> double {  // a plane of some cell
    const auto& node = scene.tree.nodes[pick(scene.tree.nodes.size())];
    const float x = node.bounds[k + (random.uniform() < 0.5 ? 3 : 0)][pick(8)];
    return std::fabs(x) < 1e30f ? x : bounds.low[k];
  };
  std::vector<TestRay> rays;
  while (rays.size() < count) {
    TestRay ray{inside(), random_direction(random)};
    const double kind = random.uniform();
    const int axis = static_cast<int>(pick(3));
    if (kind < 0.2) {
      const Vec3 to = on_mesh();
      if (length(to - ray.origin) > 0) ray.direction = normalize(to - ray.origin);
    } else if (kind < 0.4) {  // along an axis, zeros of either sign
      for (int k = 0; k < 3; ++k)
        ray.direction[k] =
            k == axis ? (random.uniform() < 0.5 ? -1 : 1) : (random.uniform() < 0.5 ? -0.0 : 0.0);
      if (random.uniform() < 0.5) ray.origin = on_mesh();
    } else if (kind < 0.6) {  // from a plane of the tree, perhaps along it
      ray.origin[axis] = plane(axis);
      const double along = random.uniform();
      if (along < 0.6) {
        ray.direction[axis] =
            along < 0.3 ? 0 : (random.uniform() - 0.5) * std::pow(10, random.uniform(-20, -2));
        ray.direction = normalize(ray.direction);
      }
    } else if (kind < 0.7) {
      ray.origin = on_mesh();
    } else if (kind < 0.8) {  // along the edge of two planes
      const int other = (axis + 1) % 3;
      ray.origin[axis] = plane(axis);
      ray.origin[other] = plane(other);
      ray.direction[axis] = ray.direction[other] = 0;
      ray.direction = normalize(ray.direction);
    }
    if (random.uniform() < 0.2)
      ray.t_max = static_cast<float>(random.uniform(0, bounds.high[0] - bounds.low[0]));
    rays.push_back(ray);
  }
  return rays;
}

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

std::pair<TreeInput, std::vector<Shape>> random_spheres(RandomInputs& random, int count, double radius) {
  TreeInput input;
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    Shape shape{};
    const float r = static_cast<float>(radius * random.uniform(0.2, 1));
    shape.sphere = {float(random.uniform(-1, 1)), float(random.uniform(-1, 1)), float(random.uniform(-1, 1)),
                    r};
    shape.type = SHAPE_SPHERE;
    const float c[3] = {shape.sphere.x, shape.sphere.y, shape.sphere.z};
    TreeShape entry{{}, static_cast<uint>(i)};
    for (int k = 0; k < 3; ++k) {
      entry.bounds.low[k] = std::nextafter(c[k] - r, -INFINITY);
      entry.bounds.high[k] = std::nextafter(c[k] + r, INFINITY);
    }
    input.shapes.push_back(entry);
    shapes.push_back(shape);
  }
  return {input, shapes};
}

}  // namespace

TEST_CASE("the tree finds what brute force finds: closed meshes") {
  check_mesh(torus_mesh(48, 24, 1, 0.4), 1);
  check_mesh(icosphere_mesh(3, 2), 2);
  check_mesh(torus_knot_mesh(4000), 3);
}

TEST_CASE("the tree finds what brute force finds: flat meshes") {
  for (int axis = 0; axis < 3; ++axis)
    check_mesh(grid_mesh(20, 20, false,
                         [axis](double u, double v) {
                           Vec3 p;
                           p[axis] = 0.25;
                           p[(axis + 1) % 3] = u - 0.5;
                           p[(axis + 2) % 3] = v - 0.5;
                           return p;
                         }),
               10 + axis);
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
