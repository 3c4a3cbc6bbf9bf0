// Whole renders: photons and visible points a second, milliseconds of each kernel, start-up, memory.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "opencl/device.hpp"
#include "render/render.hpp"

namespace causticl {

struct RenderBenchResult {
  std::string scene;
  std::string direct_light;  // "shadow_rays" or "photons"
  Statistics statistics;     // of a run with warm kernels
  double seconds_per_pass = 0, cpu_seconds_per_pass = 0, visible_points_per_second = 0;
  double relative_rmse = -1;  // against the references; -1 where there is none
  double host_fraction = 0;   // of the passes' time: what no kernel accounts for
};

/// SPPM of the Cornell box, the glass caustic and, where present, the references' scene with either way of
/// direct light and with meshes of 100,000 triangles in place of its spheres, `passes` passes each.
std::vector<RenderBenchResult> bench_render(Device& device, int passes);

/// Seconds from the start of a process until its first pass is done, with an empty kernel cache and then with
/// a full one, for the Cornell box at 16 x 16. Runs child processes; call it before this process opens a
/// device.
struct StartBenchResult {
  double cold = 0, warm = 0;              // whole first pass, kernels compiled for the device included
  double cold_build = 0, warm_build = 0;  // of that, building programs from source
};
StartBenchResult bench_start(const std::string& device_spec);

/// Seconds a pass of the Cornell box on a device of one compute unit, and on two such that share the passes;
/// both are parts of the CPU. None on other devices and on one compute unit.
struct SeveralBenchResult {
  double one = 0, two = 0;
};
std::optional<SeveralBenchResult> bench_several(const DeviceInfo& info, int passes);

std::string render_table(const std::vector<RenderBenchResult>& results);
nlohmann::json render_json(const std::vector<RenderBenchResult>& results);

}  // namespace causticl
