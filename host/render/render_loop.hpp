// The passes of a render, one after the other, until a limit is reached.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "integrators/film.hpp"
#include "integrators/integrator.hpp"
#include "render/checkpoints.hpp"
#include "render/convergence.hpp"
#include "render/render.hpp"

namespace causticl {

/// Whom a render tells how it goes on, and who ends it; any may be empty.
struct RenderListeners {
  const std::function<void(const Progress&)>& progress;
  const std::function<void(const std::string&)>& notice;
  const std::function<bool()>& interrupted;
};

class RenderLoop {
 public:
  using Clock = std::chrono::steady_clock;

  /// `start` is when the render began. The loop keeps `statistics` up to date.
  RenderLoop(const Scene& scene, const RenderOptions& options, Film& film, PassIntegrator& integrator,
             Statistics& statistics, Clock::time_point start);

  /// `first_pass_note` says what is told after the first pass; empty: nothing.
  void run(const RenderListeners& listeners, const std::function<std::string()>& first_pass_note);

  /// The picture so far, in all outputs.
  RenderResult finish();

 private:
  const Scene& scene_;
  const RenderOptions& options_;
  Film& film_;
  PassIntegrator& integrator_;
  Statistics& statistics_;
  const Clock::time_point start_;
  Clock::time_point loop_start_;
  const std::uint64_t wanted_;  // passes
  const bool endless_;          // as many as the wanted error takes
  const bool with_channels_;
  PassIntegrator::Totals totals_;
  Checkpoints checkpoints_;
  ConvergenceCheck convergence_;
  double recent_pass_ = 0;  // seconds; the longer of the last two: the first compiles kernels
  double last_pass_ = 0;
  double longest_write_ = 0;

  /// Runs pass number `pass` and looks at the error.
  void run_pass(std::uint64_t pass);
  /// Where the render stands after `passes`.
  Progress progress_after(std::uint64_t passes) const;
  /// Whether it ends after `passes`, which are fewer than were wanted; then `statistics` says why.
  bool ends_after(std::uint64_t passes, const std::function<bool()>& interrupted);
  std::vector<UnwrittenPicture> write(Picture& picture, Unwritable unwritable);
};

/// What an EXR says of its render.
Metadata metadata_of(const Scene& scene, const RenderOptions& options, const Statistics& statistics);

}  // namespace causticl
