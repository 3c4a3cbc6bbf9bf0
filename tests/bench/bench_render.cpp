#include "bench/bench_render.hpp"

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "bench/stopwatch.hpp"
#include "format/load_scene.hpp"
#include "render/reference_comparison.hpp"
#include "selftest/meshes.hpp"

namespace causticl {
namespace {

const std::string scenes = std::string(CAUSTICL_SOURCE_DIR) + "/scenes/";

/// Seconds of all kernels of passes so far; looks at the error are between passes.
double kernel_seconds(Device& device) {
  double milliseconds = 0;
  for (const auto& [name, time] : device.kernel_times())
    if (name != "pixel_errors") milliseconds += time.milliseconds;
  return milliseconds / 1000;
}

RenderBenchResult bench_scene(Device& device, Scene scene, DirectLight direct_light, int passes,
                              bool compare) {
  RenderBenchResult result;
  result.scene = std::filesystem::path(scene.file).filename().string();
  result.direct_light = direct_light == DirectLight::shadow_rays ? "shadow_rays" : "photons";
  scene.renderer.direct_light = direct_light;
  scene.renderer.passes = 1;
  render_scene(scene, device, {});  // compiles

  scene.renderer.passes = passes;
  // A device of its own, so that kernel times are of this run alone.
  Device fresh(device.info());
  Stopwatch watch;
  Elapsed start, end;  // of all passes but the first; the picture is made after them
  double kernels_before = 0, passes_before = 0;
  const auto rendered = render_scene(scene, fresh, {}, [&](const Progress& progress) {
    end = watch.elapsed();
    if (progress.pass != 1) return;
    start = end;
    kernels_before = kernel_seconds(fresh);
    passes_before = progress.pass_seconds;
  });
  result.statistics = rendered.statistics;
  result.seconds_per_pass = (end.wall - start.wall) / (passes - 1);
  result.cpu_seconds_per_pass = (end.cpu - start.cpu) / (passes - 1);
  result.visible_points_per_second = static_cast<double>(scene.width) * scene.height *
                                     scene.renderer.visible_points / result.seconds_per_pass;
  result.statistics.photons_per_second =
      static_cast<double>(scene.renderer.photons) / result.seconds_per_pass;
  result.host_fraction =
      1 - (kernel_seconds(fresh) - kernels_before) / (rendered.statistics.pass_seconds - passes_before);
  if (compare) result.relative_rmse = compare_with_references(rendered.picture).relative_rmse;
  return result;
}

/// The scene with a torus knot of 100,000 triangles in place of each sphere, within its surface.
Scene with_knots(Scene scene) {
  Mesh knot;
  for (const TreeTriangle& triangle : torus_knot_mesh(100000)) {
    const auto first = static_cast<std::uint32_t>(knot.positions.size());
    for (const auto& corner : triangle.position) knot.positions.push_back({corner[0], corner[1], corner[2]});
    knot.position_index.push_back({first, first + 1, first + 2});
    knot.normal_index.push_back({no_index, no_index, no_index});
    knot.uv_index.push_back({no_index, no_index, no_index});
  }
  for (Object& object : scene.objects) {
    if (object.shape != Object::Shape::sphere) continue;
    const double size = object.radius / 3.5;
    object.shape = Object::Shape::mesh;
    object.mesh = static_cast<int>(scene.meshes.size());
    object.smooth = false;
    object.transform = Transform::scale({size, size, size}).followed_by(object.transform);
  }
  scene.meshes.push_back(std::move(knot));
  scene.file = "cornell_knots";
  return scene;
}

/// In a child process: one pass of a tiny Cornell box. Writes {whole seconds, build seconds} to `out`.
[[noreturn]] void start_in_child(const std::string& device_spec, int out) {
  double seconds[2] = {-1, -1};
  try {
    const Stopwatch watch;
    SceneOptions options;
    options.size = {16, 16};
    Scene scene = load_scene(scenes + "cornell_box.json", options);
    scene.renderer.passes = 1;
    KernelCache kernels(true);
    Device device(find_device(device_spec), 0, &kernels);
    const auto result = render_scene(scene, device, {});
    seconds[0] = watch.elapsed().wall;
    seconds[1] = result.statistics.kernel_build_seconds;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "causticl_bench: %s\n", error.what());
  }
  const bool written = write(out, seconds, sizeof seconds) == sizeof seconds;
  _exit(written ? 0 : 1);
}

/// In a process of its own, whose kernels are kept in `cache` alone.
std::pair<double, double> start_once(const std::string& device_spec, const std::filesystem::path& cache) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    setenv("CAUSTICL_CACHE_DIR", cache.c_str(), 1);
    for (const char* name : {"POCL_CACHE_DIR", "POCL_KERNEL_CACHE"}) unsetenv(name);
    start_in_child(device_spec, ends[1]);
  }
  close(ends[1]);
  double seconds[2] = {-1, -1};
  const bool complete = read(ends[0], seconds, sizeof seconds) == sizeof seconds;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!complete || seconds[0] < 0) throw std::runtime_error("the start-up benchmark failed");
  return {seconds[0], seconds[1]};
}

}  // namespace

std::vector<RenderBenchResult> bench_render(Device& device, int passes) {
  std::vector<RenderBenchResult> results;
  for (const char* name : {"cornell_box.json", "glass_caustic.json"})
    results.push_back(
        bench_scene(device, load_scene(scenes + name), DirectLight::shadow_rays, passes, false));
  if (reference_folder().empty()) return results;
  const Scene scene = load_scene(reference_folder() + "cornell_spheres.json");
  for (const auto direct_light : {DirectLight::shadow_rays, DirectLight::photons})
    results.push_back(bench_scene(device, scene, direct_light, passes, true));
  results.push_back(bench_scene(device, with_knots(scene), DirectLight::shadow_rays, passes, false));
  return results;
}

StartBenchResult bench_start(const std::string& device_spec) {
  const auto cache = std::filesystem::temp_directory_path() / ("causticl_bench_" + std::to_string(getpid()));
  StartBenchResult result;
  std::tie(result.cold, result.cold_build) = start_once(device_spec, cache);
  std::tie(result.warm, result.warm_build) = start_once(device_spec, cache);
  std::filesystem::remove_all(cache);
  return result;
}

std::optional<SeveralBenchResult> bench_several(const DeviceInfo& info, int passes) {
  if (info.type != "cpu" || info.compute_units < 2) return {};
  const cl_device_partition_property counts[] = {CL_DEVICE_PARTITION_BY_COUNTS, 1, 1,
                                                 CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
  std::vector<cl::Device> parts;
  cl::Device(info.device).createSubDevices(counts, &parts);
  std::vector<std::unique_ptr<Device>> opened;
  for (const auto& part : parts) {
    DeviceInfo its = info;
    its.device = part;
    its.compute_units = 1;
    opened.push_back(std::make_unique<Device>(its));
  }
  Scene scene = load_scene(scenes + "cornell_box.json");
  scene.renderer.passes = passes + 1;
  const auto seconds_per_pass = [&](const std::vector<Device*>& devices) {
    Stopwatch watch;
    double first = 0;  // which several devices do whole, each
    render_scene(scene, devices, {}, [&](const Progress& progress) {
      if (progress.pass == 1) first = watch.elapsed().wall;
    });
    return (watch.elapsed().wall - first) / passes;
  };
  SeveralBenchResult result;
  result.one = seconds_per_pass({opened[0].get()});
  result.two = seconds_per_pass({opened[0].get(), opened[1].get()});
  return result;
}

std::string render_table(const std::vector<RenderBenchResult>& results) {
  std::string table;
  char line[256];
  for (const auto& result : results) {
    const auto& s = result.statistics;
    std::snprintf(line, sizeof line,
                  "sppm %-22s %-11s %6.3f s a pass (%.3f CPU)  %5.2f M photons/s  %5.2f M visible points/s  "
                  "%5.2f Mray/s\n",
                  result.scene.c_str(), result.direct_light.c_str(), result.seconds_per_pass,
                  result.cpu_seconds_per_pass, 1e-6 * s.photons_per_second,
                  1e-6 * result.visible_points_per_second, 1e-6 * s.rays_per_second);
    table += line;
    std::snprintf(
        line, sizeof line,
        "     tree %.3f s, host %.1f%% of a pass, %.1f bytes a pixel, %.0f MiB on the device, peak %.0f MiB",
        s.tree_build_seconds, 100 * result.host_fraction, s.bytes_per_pixel,
        static_cast<double>(s.device_bytes) / 1048576, static_cast<double>(s.peak_memory_bytes) / 1048576);
    table += line;
    if (result.relative_rmse >= 0) {
      std::snprintf(line, sizeof line, "; relative RMSE %.4f after %d passes, %.2f s", result.relative_rmse,
                    static_cast<int>(s.passes), s.seconds);
      table += line;
    }
    table += "\n    ";
    for (const auto& [name, time] : s.kernels) {
      std::snprintf(line, sizeof line, " %s %.1f ms", name.c_str(),
                    time.milliseconds / static_cast<double>(s.passes));
      table += line;
    }
    table += " (a pass)\n";
  }
  return table;
}

nlohmann::json render_json(const std::vector<RenderBenchResult>& results) {
  auto list = nlohmann::json::array();
  for (const auto& result : results) {
    const auto& s = result.statistics;
    nlohmann::json entry{{"scene", result.scene},
                         {"direct_light", result.direct_light},
                         {"photons_per_second", s.photons_per_second},
                         {"visible_points_per_second", result.visible_points_per_second},
                         {"rays_per_second", s.rays_per_second},
                         {"seconds_per_pass", result.seconds_per_pass},
                         {"cpu_seconds_per_pass", result.cpu_seconds_per_pass},
                         {"tree_build_seconds", s.tree_build_seconds},
                         {"host_share", result.host_fraction},
                         {"bytes_per_pixel", s.bytes_per_pixel},
                         {"device_bytes", s.device_bytes},
                         {"peak_memory_bytes", s.peak_memory_bytes}};
    for (const auto& [name, time] : s.kernels)
      entry["kernels"][name] = time.milliseconds / static_cast<double>(s.passes);
    if (result.relative_rmse >= 0) {
      entry["relative_rmse"] = result.relative_rmse;
      entry["passes"] = s.passes;
      entry["seconds"] = s.seconds;
    }
    list.push_back(entry);
  }
  return list;
}

}  // namespace causticl
