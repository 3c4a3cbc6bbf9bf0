// The pass loop: limits, signals, checkpoints, progress.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "accel/triangle_transforms.hpp"
#include "accuracy/error_estimate.hpp"
#include "device_scene/diagnostics.hpp"
#include "film/film_file.hpp"
#include "image/image.hpp"
#include "integrators/integrator.hpp"
#include "integrators/primary_hits.hpp"
#include "opencl/device.hpp"
#include "opencl/kernels.hpp"
#include "photons/photon_rays.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// A render as it stands after some passes.
struct Snapshot {
  std::uint64_t passes, photons;  // so far
  double seconds;                 // of the passes alone
  const Picture& picture;
};

/// The film file of a render, and which part of the picture's passes and pixels it adds.
struct FilmOptions {
  std::string file;                // written in the end; empty: none
  std::optional<double> every;     // seconds after which it is written while passes go on as well
  std::string resume;              // a film to go on from; empty: none
  std::optional<PixelRect> crop;   // these pixels alone
  std::optional<PassRange> range;  // these passes alone, in place of those that the scene wants
  RenderIdentity identity;         // of the render: films of another are refused
};

/// What bounds a render and where its picture goes.
struct RenderOptions {
  std::vector<std::string> outputs;    // files, by extension; rewritten at checkpoints
  std::optional<double> time_limit;    // seconds from the start of render_scene
  std::optional<double> wanted_error;  // stop at this estimated error of the picture
  double confidence = 0.9;             // fraction of pixels that the error of the picture is to hold for
  FilmOptions film;
  bool layers = false;  // also its layers direct, caustic and indirect, as channels
  std::uint32_t seed = 1;
  Precision precision = Precision::float32;
  TriangleTest triangle_test = TriangleTest::watertight;
  CameraRays camera_rays = CameraRays::automatic;
  PhotonRays photon_rays = PhotonRays::automatic;
  unsigned threads = 0;          // for the tree; 0: all of the machine
  std::string effects = "auto";  // --effects, as chosen_effects takes it
  std::string kernel_dir;        // --kernel-dir: read cl/ live; empty: the embedded sources
  bool skip_passes = true;       // leave out the passes that cannot change the picture (plan_passes)
  std::string dump_kernels;      // --dump-kernels: folder that receives what was built; empty: none
  /// Called after passes 1, 2, 3, 4, 6, 8, 12, 16, ...; its own time does not count as that of passes.
  std::function<void(const Snapshot&)> snapshot;
};

/// Where a render stands, after each pass.
struct Progress {
  std::uint64_t pass = 0, passes = 0;  // done, wanted; 0: as many as the wanted error takes
  double seconds = 0;                  // since the start
  double remaining = 0;                // seconds, by the time per pass so far and the limits
  std::optional<double> error;         // estimated, of the picture; none where it is not known yet
  // Until half that error; infinite where there is no end in sight, none while the trend is not known.
  std::optional<double> seconds_to_half;
  std::uint64_t photons = 0, rays = 0;                // so far
  std::uint64_t photons_before = 0, rays_before = 0;  // those of earlier runs
  double pass_seconds = 0;                  // of the passes alone, without start-up, writing and snapshots
  std::optional<double> wanted_error = {};  // at which it ends
};

/// A pass and its program.
struct PassStatistics {
  std::string name;          // "photon" of cl/passes/pass_photon.cl
  std::string skipped;       // why it did not run; empty where it did
  std::string effects;       // keys of those that its program was built for
  double build_seconds = 0;  // in the background, until its kernels were ready
  std::uint64_t launches = 0;
};

enum class StopReason { passes, time, error, interrupted };

/// What a finished render reports (`--stats`, `--stats-json`, EXR metadata).
struct Statistics {
  std::string device;
  Precision precision = Precision::float32;
  StopReason stop = StopReason::passes;
  double seconds = 0;             // all of render_scene
  double first_pass_seconds = 0;  // from the start until the first pass began on the device
  double first_pass_done_seconds = 0;
  double kernel_build_seconds = 0;    // of all programs
  std::uint64_t cached_programs = 0;  // those that an earlier run had compiled
  std::vector<PassStatistics> pass_programs;
  double pass_seconds = 0;       // of the passes alone, without start-up, writing and snapshots
  double film_stop_seconds = 0;  // how long passes stood still at most for the film to be written
  double error_seconds = 0;      // looking at the error of the picture, while passes go on
  double tree_build_seconds = 0;
  std::string camera_rays;  // how they find what they meet first, on each device
  std::string photon_rays;  // how they find what they meet; empty where there are none
  std::uint64_t passes = 0, photons = 0, rays = 0;
  std::optional<PictureError> error;           // estimated; none after a single pass and of a black picture
  std::optional<double> passes_to_half_error;  // further ones, estimated; none while the trend is not known
  double confidence = 0.9;                     // fraction of pixels that `error` holds for
  double photons_per_second = 0, rays_per_second = 0;  // over the passes alone
  std::uint64_t triangles = 0, shapes = 0, skipped_triangles = 0, emitters = 0;
  std::uint64_t stored_photons = 0;           // in the last pass
  double first_radius = 0;                    // sppm
  std::optional<MetropolisStatistics> seeds;  // where photons are guided
  bool first_radius_chosen = false;           // from the scene, not from the file
  std::uint64_t device_bytes = 0;             // largest amount allocated on the device
  std::uint64_t peak_memory_bytes = 0;        // of the process
  double bytes_per_pixel = 0;                 // device memory that grows with the number of pixels
  Diagnostics diagnostics;
  std::map<std::string, KernelTime> kernels;
};

struct RenderResult {
  Picture picture;
  Statistics statistics;
  std::vector<UnwrittenPicture> unwritten;  // of RenderOptions::outputs and the film, in the end
};

/// The pixels that a render computes.
inline PixelRect crop_of(const Scene& scene, const RenderOptions& options) {
  return options.film.crop.value_or(PixelRect{0, 0, scene.width, scene.height});
}

/// As many passes as it takes: what a renderer's `passes` or `samples` hold where an error alone ends the
/// render.
constexpr int endless_passes = std::numeric_limits<int>::max();

/// Renders `scene` on `devices`, which share every pass, with the integrator that it names. `progress` is
/// called after each pass; `notice` with each line that the user should know; `interrupted` is asked after
/// each pass and ends the render early when true. Writes options.outputs at passes 1, 2, 4, ... 64, while
/// that takes less than a tenth of the time, and then every 64 or every 30 seconds, whichever is later (path
/// tracing: every 30 seconds), and at the end. What cannot be written in the end is kept elsewhere.
RenderResult render_scene(const Scene& scene, const std::vector<Device*>& devices,
                          const RenderOptions& options,
                          const std::function<void(const Progress&)>& progress = {},
                          const std::function<void(const std::string&)>& notice = {},
                          const std::function<bool()>& interrupted = {});

/// The same on one device.
inline RenderResult render_scene(const Scene& scene, Device& device, const RenderOptions& options,
                                 const std::function<void(const Progress&)>& progress = {},
                                 const std::function<void(const std::string&)>& notice = {},
                                 const std::function<bool()>& interrupted = {}) {
  return render_scene(scene, std::vector<Device*>{&device}, options, progress, notice, interrupted);
}

}  // namespace causticl
