#include "bench/bench_traversal.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include "bench/embree_reference.hpp"
#include "effects.h"
#include "kernel_sources.hpp"
#include "mesh.hpp"
#include "meshes.hpp"

namespace causticl {
namespace {

const char* const kernels = R"(
#include "geometry.cl"
#include "kdtree_packet.cl"
#include "kdtree_wave.cl"
INLINE Ray load_ray(global const float4 *rays, uint i) {
  Ray ray = {convert_real3(rays[2 * i].xyz), convert_real3(rays[2 * i + 1].xyz)};
  return ray;
}
kernel void closest(GEOMETRY_PARAMETERS, global const float4 *rays, global float *distances, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  GEOMETRY_INIT(0)
  Hit hit = hit_none(rays[2 * i].w);
  geometry_closest(&geometry, load_ray(rays, i), &hit);
  distances[i] = hit.t;
}
// As "closest", by tiles of 4 x 4 pixels of a square picture. Every sixteenth item traces one.
OUTLINE void tile_closest(const Geometry *g, global const float4 *rays, global float *distances, uint side, uint tile) {
  uint across = (side + 3u) / 4u, left = tile % across * 4u, top = tile / across * 4u;
  RayPacket packet;
  uint used = 0;
  for (uint i = 0; i < PACKET_RAYS; ++i) {
    uint x = left + i % 4u, y = top + i / 4u;
    if (x < side && y < side) used |= 1u << i;
    uint at = min(y, side - 1u) * side + min(x, side - 1u);
    packet_set(&packet, i, load_ray(rays, at), hit_none(rays[2u * at].w));
  }
  kdtree_closest_packet(g->nodes, g->blocks, g->shapes, g->curves, &packet, used);
  for (; used != 0; used &= used - 1u) {
    uint i = lowest_bit(used);
    distances[(top + i / 4u) * side + left + i % 4u] = packet.t[i];
  }
}
kernel void closest_packets(GEOMETRY_PARAMETERS, global const float4 *rays, global float *distances, uint count) {
  uint side = (uint)(sqrt((float)count) + 0.5f), across = (side + 3u) / 4u, tile = get_global_id(0) / PACKET_RAYS;
  if (get_global_id(0) % PACKET_RAYS != 0 || tile >= across * across) return;
  GEOMETRY_INIT(0)
  tile_closest(&geometry, rays, distances, side, tile);
}
#ifdef KDTREE_WAVES
OUTLINE void wave_closest(const Geometry *g, global const float4 *rays, global float *distances, uint first, uint count) {
  float origin[3][WAVE_CAPACITY], direction[3][WAVE_CAPACITY], t[WAVE_CAPACITY], u[WAVE_CAPACITY], v[WAVE_CAPACITY];
  uint primitive[WAVE_CAPACITY], faults[WAVE_CAPACITY];
  for (uint i = 0; i < WAVE_CAPACITY; ++i) {
    uint at = first + min(i, count - 1u);
    Ray ray = load_ray(rays, at);
    origin[0][i] = ray.origin.x, origin[1][i] = ray.origin.y, origin[2][i] = ray.origin.z;
    direction[0][i] = ray.direction.x, direction[1][i] = ray.direction.y, direction[2][i] = ray.direction.z;
    t[i] = rays[2u * at].w;
  }
  RayArrays arrays = {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, t, u, v, primitive};
  kdtree_wave(g->nodes, g->blocks, g->shapes, g->curves, &arrays, count, faults);
  for (uint i = 0; i < count; ++i) distances[first + i] = t[i];
}
// As "closest", by waves of consecutive rays, one for every WAVE_CAPACITY items.
kernel void closest_waves(GEOMETRY_PARAMETERS, global const float4 *rays, global float *distances, uint count) {
  uint first = (uint)get_global_id(0);
  if (first % WAVE_CAPACITY != 0 || first >= count) return;
  GEOMETRY_INIT(0)
  wave_closest(&geometry, rays, distances, first, min(WAVE_CAPACITY, count - first));
}
#endif
kernel void occluded(GEOMETRY_PARAMETERS, global const float4 *rays, global uint *result, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  GEOMETRY_INIT(0)
  uint faults = 0;
  result[i] = geometry_occluded(&geometry, load_ray(rays, i), rays[2 * i].w, &faults);
}
)";

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
                            flatten_kernel_text(kernels, options.kernel_dir));
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
    if (device_.runs_items_in_turn()) measure("waves", random);
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
                                : waves   ? "closest_waves"
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
    for (int v = 0; v < 3; ++v) std::copy_n(mesh.positions[corners[v]].data(), 3, triangle.position[v]);
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
