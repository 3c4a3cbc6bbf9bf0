// Benchmarks: `causticl_bench [--quick] [--json FILE] [MESH...]`.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "bench/bench_traversal.hpp"
#include "error.hpp"

using namespace causticl;

int main(int argc, char** argv) {
  CLI::App app{"CaustiCL's benchmarks"};
  TraversalBenchOptions traversal;
  std::string device_spec, json_file;
  bool quick = false;
  app.add_option("mesh", traversal.mesh_files, "OBJ or PLY files to trace beside the generated meshes");
  app.add_option("--device", device_spec, "index, cpu, gpu or part of a name");
  app.add_option("--json", json_file, "write the figures to this file");
  app.add_option("--rays", traversal.rays, "rays of each kind");
  app.add_option("--triangles", traversal.generated, "sizes of the generated meshes");
  app.add_option("--repetitions", traversal.repetitions, "runs, of which the median counts");
  app.add_flag("--quick", quick, "fewer rays, the smaller mesh alone");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    traversal.rays = 200000;
    traversal.repetitions = 3;
    traversal.generated = {100000};
  }
  try {
    Device device(find_device(device_spec));
    std::cout << "device " << device.info().name << "\n";
    const auto bench = bench_traversal(device, traversal);
    std::cout << traversal_table(bench);
    if (!json_file.empty()) {
      auto json = traversal_json(bench);
      json["device"] = device.info().name;
      std::ofstream(json_file) << json.dump(2) << "\n";
    }
  } catch (const std::exception& error) {
    std::cerr << "causticl_bench: " << error.what() << "\n";
    return 1;
  }
}
