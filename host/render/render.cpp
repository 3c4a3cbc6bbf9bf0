#include "render/render.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>

#include "base/error.hpp"
#include "effects/effects.hpp"
#include "effects/passes.hpp"
#include "render/checkpoints.hpp"
#include "render/convergence.hpp"
#include "render/several_devices.hpp"
#include "render/start_integrators.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const char* name_of(Integrator integrator) { return integrator == Integrator::sppm ? "sppm" : "pt"; }

Metadata metadata_of(const Scene& scene, const RenderOptions& options, const Statistics& statistics) {
  Metadata metadata{{"scene", scene.file},
                    {"integrator", name_of(scene.renderer.integrator)},
                    {"seed", std::to_string(options.seed)},
                    {"passes", std::to_string(statistics.passes)},
                    {"photons", std::to_string(statistics.photons)},
                    {"device", statistics.device},
                    {"precision", name_of(statistics.precision)},
                    {"seconds", std::to_string(statistics.seconds)},
                    {"error", statistics.error ? std::to_string(statistics.error->error) : "unknown"},
                    {"confidence", std::to_string(statistics.confidence)},
                    {"causticl_version", CAUSTICL_VERSION}};
  for (const auto& kind : diagnostic_kinds)
    metadata[kind.key] = std::to_string(statistics.diagnostics.*kind.count);
  return metadata;
}

// With fewer passes the estimate of the error is too noisy to stop by.
constexpr std::uint64_t fewest_passes = 8;

/// 1, 2, 3, 4, 6, 8, 12, 16, ...: two a doubling.
bool snapshot_due(std::uint64_t passes) {
  while (passes > 3 && passes % 2 == 0) passes /= 2;
  return passes <= 3;
}

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

/// What the devices did in this render.
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
  const auto start = Clock::now();
  const bool sppm = scene.renderer.integrator == Integrator::sppm;
  Statistics statistics;
  statistics.device = names_of(devices);
  statistics.precision = options.precision;

  const Effects effects = find_effects(scene);
  const unsigned compiled =
      chosen_effects(effects, options.effects) | (options.layers ? OUTPUT_LIGHT_PASSES : 0u);
  // Without triangles there is no such test, and the tree holds no transforms for it.
  const TriangleTest triangle_test =
      (compiled & EFFECT_TRIANGLES) != 0 ? options.triangle_test : TriangleTest::watertight;
  const KernelOptions kernels{compiled, options.precision, triangle_test, options.kernel_dir,
                              options.dump_kernels};
  auto plan = plan_passes(scene);
  if (!options.skip_passes)
    for (auto& pass : plan) pass.skipped.clear();
  if (passes_to_run(plan).empty()) {
    statistics.pass_programs = pass_statistics(plan, {}, effects);
    if (notice) notice("nothing emits light: the picture is black");
    return black_picture(scene, options, statistics);
  }
  if (devices.size() > 1 && scene.renderer.guided_photons.value_or(false) && sppm)
    throw UserError(
        "/renderer/guided_photons: cannot be shared between devices, since each would mark what its own "
        "pixels see; use one --device, or -D renderer.guided_photons=false");
  std::vector<std::unique_ptr<RenderDevice>> parts;
  parts.reserve(devices.size());
  for (Device* device : devices)
    parts.push_back(std::make_unique<RenderDevice>(*device, scene, kernels,
                                                   RayChoice{options.camera_rays, options.photon_rays},
                                                   passes_to_run(plan), options.threads));
  if (notice && !parts.front()->programs.first_is_built_within(patience))
    notice("compiling kernels, once for each device and combination of effects");
  const bool with_photons = sppm && why_skipped(plan, "photon").empty();
  if (const auto pilot = start_integrators(parts, scene, options.seed, with_photons, notice)) {
    statistics.first_radius = pilot->first_radius;
    statistics.first_radius_chosen = !scene.renderer.radius;
  }
  for (Device* device : devices) device->queue().finish();
  RenderDevice& first = *parts.front();
  Film& film = first.film;
  std::unique_ptr<SeveralDevices> several;
  if (parts.size() > 1) several = std::make_unique<SeveralDevices>(parts);
  PassIntegrator* const integrator = several ? several.get() : first.integrator.get();

  const auto wanted = static_cast<std::uint64_t>(sppm ? scene.renderer.passes : scene.renderer.samples);
  const bool endless = options.wanted_error && wanted == endless_passes;
  PassIntegrator::Totals totals;
  Checkpoints checkpoints(scene.renderer.integrator);
  const auto loop_start = Clock::now();
  double recent_pass = 0;  // the longer of the last two: the first compiles kernels
  double last_pass = 0;
  double longest_write = 0;
  ConvergenceCheck watch(film, scene.renderer, options.confidence, options.wanted_error);
  statistics.confidence = options.confidence;
  const bool with_channels = std::any_of(options.outputs.begin(), options.outputs.end(), holds_channels);
  const auto write = [&](Picture& picture, Unwritable unwritable) {
    const auto write_start = Clock::now();
    if (with_channels) {
      picture.channels = integrator->channels();
      append_errors(picture.channels, film.errors(statistics.passes));
      if (options.layers)
        for (auto& channel : film.layers(statistics.passes)) picture.channels.push_back(std::move(channel));
    }
    statistics.seconds = seconds_since(start);
    statistics.photons = totals.photons_emitted;
    statistics.diagnostics = totals.diagnostics;
    statistics.error = watch.measure(statistics.passes);
    auto unwritten =
        write_pictures(options.outputs, picture, metadata_of(scene, options, statistics), unwritable);
    longest_write = std::max(longest_write, seconds_since(write_start));
    return unwritten;
  };

  for (std::uint64_t pass = 0; pass < wanted; ++pass) {
    const auto pass_start = Clock::now();
    integrator->enqueue_pass(static_cast<std::uint32_t>(pass));
    totals = integrator->finish();
    statistics.passes = pass + 1;
    const double elapsed = seconds_since(start);
    const double this_pass = seconds_since(pass_start) + (pass == 0 ? integrator->early_seconds() : 0);
    if (pass == 0) statistics.first_pass_done_seconds = elapsed;
    if (pass == 0 && several && notice) notice(several->fractions_text());
    recent_pass = pass < 2 ? this_pass : std::max(last_pass, this_pass);
    last_pass = this_pass;
    const auto look_start = Clock::now();
    watch.update(pass + 1);
    statistics.error_seconds += seconds_since(look_start);
    statistics.pass_seconds += this_pass;
    if (options.snapshot && snapshot_due(pass + 1))
      options.snapshot({pass + 1, totals.photons_emitted, statistics.pass_seconds, film.picture(pass + 1)});
    if (progress) {
      const double per_pass = seconds_since(loop_start) / static_cast<double>(pass + 1);
      constexpr double unknown = std::numeric_limits<double>::infinity();
      double remaining = endless ? unknown : per_pass * static_cast<double>(wanted - pass - 1);
      if (options.time_limit) remaining = std::min(remaining, std::max(0.0, *options.time_limit - elapsed));
      Progress now{pass + 1, endless ? 0 : wanted,   elapsed,    remaining, {},
                   {},       totals.photons_emitted, totals.rays};
      now.pass_seconds = statistics.pass_seconds;
      now.wanted_error = options.wanted_error;
      if (watch.last()) {
        now.error = watch.last()->error;
        if (const auto further = watch.passes_to_half(pass + 1)) now.seconds_to_half = per_pass * *further;
        if (options.wanted_error)
          now.remaining = std::min(remaining, per_pass * watch.passes_to_wanted(pass + 1));
      }
      progress(now);
    }
    if (options.wanted_error && pass + 1 >= fewest_passes && watch.last() &&
        watch.last()->error <= *options.wanted_error) {
      statistics.stop = StopReason::error;
      break;
    }
    if (pass + 1 == wanted) break;
    if (interrupted && interrupted()) {
      statistics.stop = StopReason::interrupted;
      break;
    }
    // The next pass and writing the picture must fit into what is left.
    if (options.time_limit && elapsed + recent_pass + longest_write > *options.time_limit) {
      statistics.stop = StopReason::time;
      break;
    }
    if (!options.outputs.empty() && checkpoints.due(pass + 1, seconds_since(loop_start), longest_write)) {
      Picture so_far = film.picture(statistics.passes);
      // A disk that is full now may have room at the end: the work so far is not thrown away.
      for (const auto& [file, fault] : write(so_far, Unwritable::lost))
        if (notice) notice(fault + " (will be tried again)");
    }
  }

  statistics.passes_to_half_error = watch.passes_to_half(statistics.passes);
  const double loop_seconds = std::max(seconds_since(loop_start) + integrator->early_seconds(), 1e-9);
  statistics.rays = totals.rays;
  statistics.stored_photons = totals.photons_stored_last_pass;
  statistics.seeds = totals.seeds;
  statistics.photons_per_second = static_cast<double>(totals.photons_emitted) / loop_seconds;
  statistics.rays_per_second = static_cast<double>(totals.rays) / loop_seconds;
  RenderResult result;
  result.picture = film.picture(statistics.passes);
  result.unwritten = write(result.picture, Unwritable::kept);
  if (notice && is_black(result.picture)) notice("the picture is black: no light has reached the camera");
  statistics.first_pass_seconds = std::chrono::duration<double>(integrator->began() - start).count();
  statistics.tree_build_seconds = first.scene.tree_build_seconds;
  statistics.triangles = first.scene.triangles;
  statistics.shapes = first.scene.shapes_count;
  statistics.skipped_triangles = first.scene.skipped_triangles;
  statistics.emitters = first.scene.emitter_count;
  statistics.peak_memory_bytes = peak_memory();
  statistics.bytes_per_pixel = static_cast<double>(film.bytes_per_pixel()) + integrator->bytes_per_pixel();
  statistics.pass_programs = pass_statistics(plan, first.programs.builds(), effects);
  add_device_statistics(parts, statistics);
  for (auto& pass : statistics.pass_programs) {
    const auto kernel = statistics.kernels.find(main_kernel(pass.name));
    if (kernel != statistics.kernels.end()) pass.launches = kernel->second.launches;
    statistics.kernel_build_seconds += pass.build_seconds;
  }
  result.statistics = statistics;
  return result;
}

}  // namespace causticl
