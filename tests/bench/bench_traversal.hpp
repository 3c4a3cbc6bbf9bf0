// Rays per second of the tree's traversal, beside Embree on the same rays where it is installed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "opencl/device.hpp"

namespace causticl {

struct TraversalBenchOptions {
  std::vector<std::size_t> generated{100000, 1000000};  // triangles of the torus knots
  std::vector<std::string> mesh_files;
  std::size_t rays = 2000000;
  int repetitions = 5;
  std::string kernel_dir;  // read kernels here in place of the embedded ones
};

struct TraversalBenchResult {
  std::string mesh;      // "knot 100000" or a file's name
  std::string rays;      // "camera", "packets" (camera rays again, in tiles), "random", "waves" (these
                         // again, in a batch) or "shadow"
  double mrays = 0;      // millions a second
  double mrays_cpu = 0;  // the same, a second of CPU time
  double embree_mrays =
      0;             // rtcIntersect1, or rtcOccluded1 for shadow rays, on as many threads; 0 without Embree
  double ratio = 0;  // median over repetitions that alternate between the two
  std::size_t hits = 0,
              disagreements = 0;  // rays of which only one of the two says that something is met, or that
                                  // end at distances that differ by more than 1e-4 of the scene
};

struct TreeBenchResult {
  std::string mesh;
  std::size_t triangles = 0;
  double build_seconds = 0, bytes_per_triangle = 0, references_per_triangle = 0;
  std::size_t nodes = 0, blocks = 0;
  unsigned depth = 0;
  double embree_build_seconds = 0;
  double build_cpu_seconds = 0;
};

struct TraversalBench {
  std::vector<TreeBenchResult> trees;
  std::vector<TraversalBenchResult> rays;
};

/// Whether the binary was built with Embree.
bool bench_has_embree();

TraversalBench bench_traversal(Device& device, const TraversalBenchOptions& options);

/// Lines for people.
std::string traversal_table(const TraversalBench& bench);
/// {"trees": [...], "traversal": [{mesh, rays, mrays, embree_mrays, ratio, disagreements}, ...]}
nlohmann::json traversal_json(const TraversalBench& bench);

}  // namespace causticl
