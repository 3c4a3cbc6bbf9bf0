#include "bench/bench_traversal.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include "bench/bench_traversal_kernels.hpp"
#include "bench/embree_reference.hpp"
#include "mesh/mesh.hpp"
#include "opencl/kernel_sources.hpp"
#include "selftest/meshes.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

BenchRay make_ray(Vec3 origin, Vec3 direction, double t_max) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(origin.x), f(origin.y), f(origin.z), f(t_max)},
          {f(direction.x), f(direction.y), f(direction.z), 0}};
}

// A mesh with its tree on the device and in Embree.
class MeshBench {
 public:
  MeshBench(Device& device, std::string name, TriangleMesh triangles, const TraversalBenchOptions& options,
            TraversalBench& results)
      : device_(device),
        options_(options),
        results_(results),
        name_(std::move(name)),
        tree_(timed_build(triangles)),
        embree_(triangles, device.info().compute_units) {
    program_ = device.build("#define EFFECTS " + std::to_string(EFFECT_TRIANGLES) + "u\n" +
                            flatten_kernel_text(bench_traversal_kernels, options.kernel_dir));
    nodes_ = device.upload(tree_.nodes, "nodes");
    blocks_ = device.upload(tree_.blocks, "blocks");
    none_ = device.buffer(0, "nothing");
    const double n = static_cast<double>(triangles.size());
    results.trees.push_back({name_, triangles.size(), tree_.build_seconds,
                             static_cast<double>(tree_.bytes()) / n + sizeof(TriangleAttributes),
                             static_cast<double>(tree_.references) / n, tree_.nodes.size(),
                             tree_.blocks.size(), tree_.depth, embree_.build_time().wall, build_time_.cpu});
    for (int k = 0; k < 3; ++k) {
      center_[k] = 0.5 * (double(tree_.bounds.low[k]) + tree_.bounds.high[k]);
      extent_[k] = double(tree_.bounds.high[k]) - tree_.bounds.low[k];
    }
  }

  void run() {
    const auto camera = camera_rays();
    const auto distances = measure("camera", camera);
    measure("packets", camera);
    const auto random = random_rays();
    measure("random", random);
    if (device_.has_serial_work_items()) measure("waves", random);
    measure("shadow", shadow_rays(camera, distances));
  }

 private:
  Device& device_;
  const TraversalBenchOptions& options_;
  TraversalBench& results_;
  std::string name_;
  Elapsed build_time_;
  KdTree tree_;
  EmbreeReference embree_;
  cl::Program program_;
  cl::Buffer nodes_, blocks_, none_;
  Vec3 center_, extent_;
  std::mt19937_64 engine_{7};

  KdTree timed_build(const TriangleMesh& triangles) {
    const Stopwatch watch;
    KdTree tree = build_kdtree({triangles, {}}, device_.info().compute_units);
    build_time_ = watch.elapsed();
    return tree;
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

  Vec3 random_direction() {
    const double z = uniform(-1, 1), r = std::sqrt(1 - z * z), angle = uniform(0, tau);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  // A square pinhole image that the mesh fills, in scan lines.
  std::vector<BenchRay> camera_rays() {
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(options_.rays)));
    const Vec3 view = normalize({0.3, 0.4, 1}), eye = center_ + view * (1.1 * length(extent_));
    const Vec3 right = normalize(cross({0, 1, 0}, view)), up = cross(view, right);
    std::vector<BenchRay> rays;
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = 0; x < side; ++x) {
        const double u = (static_cast<double>(x) + 0.5) / static_cast<double>(side) - 0.5;
        const double v = (static_cast<double>(y) + 0.5) / static_cast<double>(side) - 0.5;
        rays.push_back(make_ray(eye, normalize(right * u * 0.7 + up * v * 0.7 - view), INFINITY));
      }
    return rays;
  }

  // From anywhere in the bounds to anywhere.
  std::vector<BenchRay> random_rays() {
    std::vector<BenchRay> rays;
    while (rays.size() < options_.rays) {
      Vec3 origin = center_;
      for (int k = 0; k < 3; ++k) origin[k] += uniform(-0.5, 0.5) * extent_[k];
      rays.push_back(make_ray(origin, random_direction(), INFINITY));
    }
    return rays;
  }

  // From what the camera sees to a large light above.
  std::vector<BenchRay> shadow_rays(const std::vector<BenchRay>& camera,
                                    const std::vector<float>& distances) {
    std::vector<BenchRay> rays;
    for (std::size_t i = 0; i < camera.size(); ++i) {
      if (!std::isfinite(distances[i])) continue;
      const Vec3 o{camera[i].origin.x, camera[i].origin.y, camera[i].origin.z};
      const Vec3 d{camera[i].direction.x, camera[i].direction.y, camera[i].direction.z};
      const Vec3 from = o + d * (distances[i] * (1 - 1e-4));
      const Vec3 light =
          center_ + Vec3{uniform(-0.5, 0.5) * extent_.x, 1.5 * extent_.y, uniform(-0.5, 0.5) * extent_.z};
      rays.push_back(make_ray(from, normalize(light - from), length(light - from)));
    }
    return rays;
  }

  // Alternates between the device and Embree; returns distances, or flags for shadow rays.
  std::vector<float> measure(const char* kind, const std::vector<BenchRay>& rays) {
    const bool any = std::string(kind) == "shadow", packets = std::string(kind) == "packets";
    const auto ray_buffer = device_.upload(rays, "rays");
    const auto result_buffer = device_.buffer(rays.size() * sizeof(float), "results");
    const bool waves = std::string(kind) == "waves";
    cl::Kernel kernel(program_, any       ? "occluded"
                                : packets ? "closest_packets"
                                : waves   ? "closest_streams"
                                          : "closest");
    set_arguments(kernel, nodes_, blocks_, none_, none_, none_, ray_buffer, result_buffer,
                  static_cast<cl_uint>(rays.size()));
    // Tiles at the edges of the picture are not full.
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(rays.size())) + 0.5) + 3;
    const std::size_t items = packets ? side * side : rays.size();
    const auto trace = [&] {
      const Stopwatch watch;
      device_.launch(kernel, items);
      device_.queue().finish();
      return watch.elapsed();
    };
    trace();  // compiles
    std::vector<float> embree_distances;
    std::vector<uint> embree_flags;
    std::vector<double> ours, cpus, embrees, ratios;
    for (int i = 0; i < options_.repetitions; ++i) {
      const Elapsed our = trace();
      const Elapsed embree =
          any ? embree_.occluded(rays, embree_flags) : embree_.closest(rays, embree_distances);
      ours.push_back(our.wall);
      embrees.push_back(embree.wall);
      // Where both run on the CPU, its time is disturbed less by what else the machine does.
      ratios.push_back(device_.info().type == "cpu" ? embree.cpu / our.cpu : embree.wall / our.wall);
      cpus.push_back(our.cpu);
    }
    const double millions = 1e-6 * static_cast<double>(rays.size());
    TraversalBenchResult result{name_, kind, millions / median(ours), millions / median(cpus)};
    const auto distances = device_.download<float>(result_buffer, rays.size());
    std::vector<uint> flags(rays.size());
    std::memcpy(flags.data(), distances.data(), flags.size() * sizeof(uint));
    for (std::size_t i = 0; i < rays.size(); ++i)
      result.hits += any ? flags[i] != 0 : std::isfinite(distances[i]);
    if (bench_has_embree()) {
      result.embree_mrays = millions / median(embrees);
      result.ratio = median(ratios);
      for (std::size_t i = 0; i < rays.size(); ++i)
        result.disagreements +=
            any ? flags[i] != embree_flags[i]
                : !(distances[i] == embree_distances[i] ||
                    std::fabs(distances[i] - embree_distances[i]) < 1e-4 * length(extent_));
    }
    results_.rays.push_back(result);
    return distances;
  }
};

TriangleMesh mesh_of_file(const std::string& file) {
  const Mesh mesh = read_mesh(file);
  TriangleMesh result;
  for (const auto& corners : mesh.position_index) {
    TreeTriangle triangle;
    for (int v = 0; v < 3; ++v)
      for (int axis = 0; axis < 3; ++axis)
        triangle.position[v][axis] = static_cast<float>(mesh.positions[corners[v]][axis]);
    result.push_back(triangle);
  }
  return result;
}

}  // namespace

TraversalBench bench_traversal(Device& device, const TraversalBenchOptions& options) {
  TraversalBench results;
  for (const auto count : options.generated)
    MeshBench(device, "knot " + std::to_string(count), torus_knot_mesh(count), options, results).run();
  for (const auto& file : options.mesh_files)
    MeshBench(device, std::filesystem::path(file).filename().string(), mesh_of_file(file), options, results)
        .run();
  return results;
}

std::string traversal_table(const TraversalBench& bench) {
  std::string table;
  char line[256];
  for (const auto& tree : bench.trees) {
    std::snprintf(line, sizeof line,
                  "tree %-16s %8zu triangles  %6.3f s (%.3f CPU)  %5.1f B/triangle with attributes  %.2f "
                  "references  depth %u  %zu "
                  "nodes  %zu blocks  Embree %.3f s\n",
                  tree.mesh.c_str(), tree.triangles, tree.build_seconds, tree.build_cpu_seconds,
                  tree.bytes_per_triangle, tree.references_per_triangle, tree.depth, tree.nodes, tree.blocks,
                  tree.embree_build_seconds);
    table += line;
  }
  for (const auto& rays : bench.rays) {
    std::snprintf(line, sizeof line,
                  "rays %-16s %-7s %7.2f Mray/s (%.2f a CPU second)  Embree %7.2f  ratio %.2f  %zu hits  %zu "
                  "disagree\n",
                  rays.mesh.c_str(), rays.rays.c_str(), rays.mrays, rays.mrays_cpu, rays.embree_mrays,
                  rays.ratio, rays.hits, rays.disagreements);
    table += line;
  }
  return table;
}

nlohmann::json traversal_json(const TraversalBench& bench) {
  nlohmann::json json{{"trees", nlohmann::json::array()}, {"traversal", nlohmann::json::array()}};
  for (const auto& tree : bench.trees)
    json["trees"].push_back({{"mesh", tree.mesh},
                             {"triangles", tree.triangles},
                             {"build_seconds", tree.build_seconds},
                             {"bytes_per_triangle", tree.bytes_per_triangle},
                             {"depth", tree.depth}});
  for (const auto& rays : bench.rays) {
    nlohmann::json entry{{"mesh", rays.mesh}, {"rays", rays.rays}, {"mrays", rays.mrays}};
    if (rays.embree_mrays > 0) {
      entry["embree_mrays"] = rays.embree_mrays;
      entry["ratio"] = rays.ratio;
      entry["disagreements"] = rays.disagreements;
    }
    json["traversal"].push_back(entry);
  }
  return json;
}

}  // namespace causticl
