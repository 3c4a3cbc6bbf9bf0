// Benchmarks: `causticl_bench [--quick] [--json FILE] [MESH...]`.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "base/error.hpp"
#include "bench/bench_ceilings.hpp"
#include "bench/bench_render.hpp"
#include "bench/bench_traversal.hpp"

using namespace causticl;

int main(int argc, char** argv) {
  CLI::App app{"CaustiCL's benchmarks"};
  TraversalBenchOptions traversal;
  std::string device_spec, json_file;
  bool quick = false;
  int passes = 17;  // the first is not counted
  app.add_option("mesh", traversal.mesh_files, "OBJ or PLY files to trace beside the generated meshes");
  app.add_option("--device", device_spec, "index, cpu, gpu or part of a name");
  app.add_option("--json", json_file, "write the figures to this file");
  app.add_option("--rays", traversal.rays, "rays of each kind");
  app.add_option("--triangles", traversal.generated, "sizes of the generated meshes");
  app.add_option("--repetitions", traversal.repetitions, "runs, of which the median counts");
  app.add_option("--kernel-dir", traversal.kernel_dir, "read kernels from here");
  app.add_option("--passes", passes, "passes of each render, the first of which is not counted")
      ->check(CLI::Range(2, 100000));
  app.add_flag("--quick", quick, "fewer rays, the smaller mesh alone");
  CLI11_PARSE(app, argc, argv);
  // What is named otherwise stays.
  const auto quick_value = [&](const char* option, auto& value, auto quicker) {
    if (quick && app.count(option) == 0) value = quicker;
  };
  quick_value("--rays", traversal.rays, 200000);
  quick_value("--repetitions", traversal.repetitions, 3);
  quick_value("--triangles", traversal.generated, std::vector<std::size_t>{100000});
  quick_value("--passes", passes, 5);
  try {
    const StartBenchResult start = bench_start(device_spec);
    Device device(find_device(device_spec));
    std::printf("device %s, OpenCL driver %s, %u compute units\n", device.info().name.c_str(),
                device.info().driver.c_str(), device.info().compute_units);
    std::printf(
        "start  until the first pass is done: %.2f s with an empty kernel cache (%.2f building), %.2f s with "
        "a full one (%.2f)\n",
        start.cold, start.cold_build, start.warm, start.warm_build);
    const Ceilings ceilings = bench_ceilings(device);
    std::cout << ceilings_text(ceilings);
    const auto renders = bench_render(device, passes);
    std::cout << render_table(renders) << std::flush;
    const auto several = bench_several(device.info(), passes);
    if (several)
      std::printf(
          "devices of one compute unit each: %.3f s a pass on one, %.3f s on two that share it (%.2f x)\n",
          several->one, several->two, several->one / several->two);
    const auto bench = bench_traversal(device, traversal);
    std::cout << traversal_table(bench);
    if (!json_file.empty()) {
      auto json = traversal_json(bench);
      json["device"] = device.info().name;
      json["ceilings"] = {{"copied_bytes_per_second", ceilings.copied},
                          {"operations_per_second", ceilings.operations}};
      json["sppm"] = render_json(renders);
      json["start"] = {{"cold_seconds", start.cold},
                       {"cold_build_seconds", start.cold_build},
                       {"warm_seconds", start.warm},
                       {"warm_build_seconds", start.warm_build}};
      if (several)
        json["several_devices"] = {{"one_seconds_per_pass", several->one},
                                   {"two_seconds_per_pass", several->two}};
      std::ofstream file(json_file);
      file << json.dump(2) << "\n";
      if (!file.flush()) throw UserError("--json " + json_file + ": cannot be written");
    }
  } catch (const std::exception& error) {
    std::cerr << "causticl_bench: " << error.what() << "\n";
    return 1;
  }
}
