#include "render/render.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <memory>

#include "base/error.hpp"
#include "effects/effects.hpp"
#include "effects/passes.hpp"
#include "render/render_loop.hpp"
#include "render/several_devices.hpp"
#include "render/start_integrators.hpp"
#include "scene/integrators.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// What is known of each pass before it runs.
std::vector<PassStatistics> pass_statistics(const std::vector<PassPlan>& plan,
                                            const std::vector<ProgramBuild>& builds, const Effects& effects) {
  std::vector<PassStatistics> result;
  for (const auto& pass : plan) {
    result.push_back({pass.name, pass.skipped, "", 0, 0});
    for (const auto& build : builds)
      if (build.pass == pass.name) {
        result.back().effects = effect_keys(effects, build.effects);
        result.back().build_seconds = build.seconds;
      }
  }
  return result;
}

bool is_black(const Picture& picture) {
  return std::all_of(picture.rgb.begin(), picture.rgb.end(), [](float value) { return value == 0; });
}

std::string names_of(const std::vector<Device*>& devices) {
  std::string names;
  for (const Device* device : devices) names += (names.empty() ? "" : " + ") + device->info().name;
  return names;
}

/// What the devices did in this render, after pass_statistics().
void add_device_statistics(const std::vector<std::unique_ptr<RenderDevice>>& parts, Statistics& statistics) {
  for (const auto& part : parts) {
    statistics.device_bytes += part->device.allocated_bytes();
    statistics.camera_rays +=
        (statistics.camera_rays.empty() ? "" : " + ") + camera_rays_text(part->programs.options());
    if (statistics.photons)
      statistics.photon_rays += (statistics.photon_rays.empty() ? "" : " + ") +
                                photon_rays_text(part->programs.options(), part->device);
    statistics.cached_programs += part->device.cached_programs() - part->kept_before;
    for (const auto& [name, time] : part->kernel_times()) {
      statistics.kernels[name].milliseconds += time.milliseconds;
      statistics.kernels[name].launches += time.launches;
    }
  }
  for (auto& pass : statistics.pass_programs) {
    const auto kernel = statistics.kernels.find(pass_row(pass.name).main_kernel);
    if (kernel != statistics.kernels.end()) pass.launches = kernel->second.launches;
    statistics.kernel_build_seconds += pass.build_seconds;
  }
  statistics.peak_memory_bytes = peak_memory();
}

/// What the device holds of the scene.
void add_scene_statistics(const RenderDevice& part, Statistics& statistics) {
  statistics.tree_build_seconds = part.scene.tree_build_seconds;
  statistics.triangles = part.scene.triangles;
  statistics.shapes = part.scene.shapes_count;
  statistics.skipped_triangles = part.scene.skipped_triangles;
  statistics.emitters = part.scene.emitter_count;
}

KernelOptions kernel_options(const Effects& effects, const RenderOptions& options) {
  const unsigned compiled =
      chosen_effects(effects, options.effects) | (options.layers ? OUTPUT_LIGHT_PASSES : 0u);
  // Without triangles there is no such test, and the tree holds no transforms for it.
  const TriangleTest triangle_test =
      (compiled & EFFECT_TRIANGLES) != 0 ? options.triangle_test : TriangleTest::watertight;
  return {compiled, options.precision, triangle_test, options.kernel_dir, options.dump_kernels};
}

/// Seconds without a sign of life before the user is told what goes on. Nothing is lost by the wait: without
/// kernels there is nothing else to do.
constexpr double patience = 1.5;

/// The picture of a scene without light, by no pass at all.
RenderResult black_picture(const Scene& scene, const RenderOptions& options, const Statistics& statistics) {
  RenderResult result{{scene.width, scene.height, {}}, statistics, {}};
  result.picture.rgb.assign(
      3 * static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height), 0);
  if (options.layers) result.picture.channels = layer_channels(result.picture.rgb.size() / 3);
  result.statistics.peak_memory_bytes = peak_memory();
  result.unwritten = write_pictures(options.outputs, result.picture, metadata_of(scene, options, statistics),
                                    Unwritable::kept);
  return result;
}

}  // namespace

RenderResult render_scene(const Scene& scene, const std::vector<Device*>& devices,
                          const RenderOptions& options, const std::function<void(const Progress&)>& progress,
                          const std::function<void(const std::string&)>& notice,
                          const std::function<bool()>& interrupted) {
  const auto start = RenderLoop::Clock::now();
  Statistics statistics;
  statistics.device = names_of(devices);
  statistics.precision = options.precision;

  const Effects effects = find_effects(scene);
  const KernelOptions kernels = kernel_options(effects, options);
  auto plan = plan_passes(scene);
  if (!options.skip_passes)
    for (auto& pass : plan) pass.skipped.clear();
  FilmSession session(scene, options);
  if (notice && session.earlier()) notice(session.notice(statistics.device));
  if (passes_to_run(plan).empty()) {
    if (!options.film.file.empty())
      throw UserError(
          "nothing emits light, so that there is no film to write: leave out --film and --checkpoint");
    statistics.pass_programs = pass_statistics(plan, {}, effects);
    if (notice) notice("nothing emits light: the picture is black");
    return black_picture(scene, options, statistics);
  }
  if (devices.size() > 1 && scene.renderer.guided_photons.value_or(false) &&
      traces_photons(scene.renderer.integrator))
    throw UserError(
        "/renderer/guided_photons: cannot be shared between devices, since each would mark what its own "
        "pixels see; use one --device, or -D renderer.guided_photons=false");
  std::vector<std::unique_ptr<RenderDevice>> parts;
  parts.reserve(devices.size());
  for (Device* device : devices)
    parts.push_back(std::make_unique<RenderDevice>(*device, scene, crop_of(scene, options), kernels,
                                                   RayChoice{options.camera_rays, options.photon_rays},
                                                   passes_to_run(plan), options.threads));
  if (notice && !parts.front()->programs.first_is_built_within(patience))
    notice("compiling kernels, once for each device and combination of effects");
  const bool with_photons = why_skipped(plan, "photon").empty();
  if (const auto pilot = start_integrators(parts, scene, options.seed, with_photons, notice)) {
    statistics.first_radius = pilot->first_radius;
    statistics.first_radius_chosen = !scene.renderer.radius;
  }
  for (Device* device : devices) device->queue().finish();
  RenderDevice& first = *parts.front();
  std::unique_ptr<SeveralDevices> several;
  if (parts.size() > 1) several = std::make_unique<SeveralDevices>(parts);
  PassIntegrator& integrator = several ? static_cast<PassIntegrator&>(*several) : *first.integrator;

  session.restore(parts, integrator);
  RenderLoop loop(scene, options, first.film, integrator, session, statistics, start);
  std::function<std::string()> fractions;
  if (several) fractions = [&] { return several->fractions_text(); };
  loop.run({progress, notice, interrupted}, fractions);
  RenderResult result = loop.finish();
  if (notice && is_black(result.picture)) notice("the picture is black: no light has reached the camera");
  add_scene_statistics(first, statistics);
  statistics.pass_programs = pass_statistics(plan, first.programs.builds(), effects);
  add_device_statistics(parts, statistics);
  result.statistics = statistics;
  return result;
}

}  // namespace causticl
