// A scene with its tree on the device, and rays of every kind that a tree can get wrong.
#pragma once

#include <cstring>
#include <sstream>
#include <utility>

#include "catch2.hpp"
#include "device_fixture.hpp"
#include "kernels/traversal_kernels.hpp"
#include "selftest/mesh_set.hpp"
#include "selftest/meshes.hpp"
#include "selftest/shape_inputs.hpp"

namespace causticl {

struct TestRay {
  Vec3 origin, direction;
  float t_max = INFINITY;
};

struct TestHit {
  float t, u, v;
  uint primitive;
};

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
    // No ray takes more steps in these trees, but one of NaN.
    static cl::Program program = build_test_program("#define KD_STEP_LIMIT (1u << 16)\n" +
                                                    std::string(sphere_stand_in) + traversal_kernels);
    return program;
  }

  struct Results {
    std::vector<TestHit> tree, brute;
    std::vector<uint> occluded;
  };

  static cl::Buffer upload(const std::vector<TestRay>& rays) {
    std::vector<float4> data;
    for (const auto& ray : rays) {
      data.push_back({static_cast<float>(ray.origin.x), static_cast<float>(ray.origin.y),
                      static_cast<float>(ray.origin.z), ray.t_max});
      data.push_back({static_cast<float>(ray.direction.x), static_cast<float>(ray.direction.y),
                      static_cast<float>(ray.direction.z), 0});
    }
    return test_device().upload(data, "rays");
  }

  /// The hits that a kernel finds which takes what "closest" takes, over one item a ray.
  std::vector<TestHit> closest(const char* kernel, const cl::Buffer& rays, std::size_t count) {
    const auto hits = test_device().buffer(count * sizeof(TestHit), "hits");
    run_kernel(program, kernel, count, nodes, blocks, shapes, rays, hits, static_cast<cl_uint>(count));
    return test_device().download<TestHit>(hits, count);
  }

  Results trace(const std::vector<TestRay>& rays) {
    auto& device = test_device();
    const auto ray_buffer = upload(rays);
    const auto hits = device.buffer(rays.size() * sizeof(TestHit), "hits");
    const auto flags = device.buffer(rays.size() * sizeof(uint), "flags");
    const auto count = static_cast<cl_uint>(rays.size());
    Results results;
    results.tree = closest("closest", ray_buffer, rays.size());
    run_kernel(program, "occluded", rays.size(), nodes, blocks, shapes, ray_buffer, flags, count);
    results.occluded = device.download<uint>(flags, rays.size());
    run_kernel(program, "brute_force", rays.size(), list,
               static_cast<cl_uint>((input.triangles.size() + 7) / 8), shapes,
               static_cast<cl_uint>(input.shapes.size()), ray_buffer, hits, count);
    results.brute = device.download<TestHit>(hits, rays.size());
    return results;
  }
};

inline Vec3 random_direction(RandomInputs& random) {
  for (;;) {
    const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double n = length(v);
    if (n > 0.01 && n < 1) return v / n;
  }
}

inline Vec3 random_offset(RandomInputs& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

// Checks that rays in packets have the hits of single ones to the bit, and returns how many hit.
inline std::size_t check_same_hits(const std::vector<TestRay>& rays, const std::vector<TestHit>& single,
                                   const std::vector<TestHit>& packet) {
  std::ostringstream examples;
  examples.precision(9);
  std::size_t different = 0, hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    hits += single[i].primitive != BLOCK_EMPTY;
    if (std::memcmp(&single[i], &packet[i], sizeof(TestHit)) == 0) continue;
    if (++different > 3) continue;
    const auto& r = rays[i];
    examples << "\nray " << i << ": o " << r.origin.x << " " << r.origin.y << " " << r.origin.z << " d "
             << r.direction.x << " " << r.direction.y << " " << r.direction.z << " single " << single[i].t
             << " of " << single[i].primitive << " packet " << packet[i].t << " of " << packet[i].primitive;
  }
  INFO(different << " of " << rays.size() << " rays, " << hits << " hits" << examples.str());
  CHECK(different == 0);
  return hits;
}

// Rays of every kind that a tree can get wrong: random, along axes with +0 and -0, from vertices and split
// planes, within planes of the tree, at vertices and edges, with short t_max.
inline std::vector<TestRay> hard_rays(const Traversal& scene, RandomInputs& random, std::size_t count) {
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

/// The same two triangles, each `count` times.
inline TriangleMesh duplicate_triangles(int count) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    mesh.push_back(make_triangle({0, 0, 0}, {1, 0, 0.1}, {0, 1, 0}));
    mesh.push_back(make_triangle({1, 1, 0.5}, {1, 0, 0.1}, {0, 1, 0}));
  }
  return mesh;
}

inline TriangleMesh boxes_that_share_faces() {
  TriangleMesh mesh;
  for (int i = 0; i < 27; ++i) {
    const Vec3 low{0.25 * (i % 3), 0.25 * (i / 3 % 3), 0.25 * (i / 9)};
    for (const auto& triangle : box_mesh(low, low + Vec3{0.25, 0.25, 0.25})) mesh.push_back(triangle);
  }
  return mesh;
}

inline TriangleMesh far_torus() {
  auto mesh = torus_mesh(40, 20, 100, 30);
  for (auto& t : mesh)
    for (auto& vertex : t.position) vertex[0] += 1e6f;
  return mesh;
}

/// Makes one of every `group` rays have a component that is not finite. Returns which.
inline std::vector<bool> break_rays(std::vector<TestRay>& rays, std::size_t group, RandomInputs& random) {
  std::vector<bool> broken(rays.size(), false);
  for (std::size_t i = 0; i < rays.size(); i += group) {
    const auto k = i + static_cast<std::size_t>(random.uniform(0, static_cast<double>(group)));
    const int axis = static_cast<int>(random.uniform(0, 3));
    (random.uniform() < 0.5 ? rays[k].origin : rays[k].direction)[axis] =
        random.uniform() < 0.5 ? NAN : INFINITY;
    broken[k] = true;
  }
  return broken;
}

inline std::pair<TreeInput, std::vector<Shape>> random_spheres(RandomInputs& random, int count,
                                                               double radius) {
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

/// Adds a unit disk, moved by `to_world`.
inline void add_disk(TreeInput& input, std::vector<Shape>& shapes, const Transform& to_world) {
  shapes.push_back(make_shape(SHAPE_DISK, to_world));
  TreeShape entry{{}, static_cast<uint>(shapes.size() - 1)};
  for (int k = 0; k < 3; ++k) {
    const double half = std::hypot(to_world.rows[k].x, to_world.rows[k].y) * 1.00001;
    entry.bounds.low[k] = static_cast<float>(to_world.translation[k] - half);
    entry.bounds.high[k] = static_cast<float>(to_world.translation[k] + half);
  }
  input.shapes.push_back(entry);
}

}  // namespace causticl
