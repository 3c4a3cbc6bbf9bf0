// The passes of a render, one after the other, until a limit is reached.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "film/film.hpp"
#include "image/image.hpp"
#include "integrators/integrator.hpp"
#include "render/checkpoints.hpp"
#include "render/convergence.hpp"
#include "render/film_session.hpp"
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
             FilmSession& session, Statistics& statistics, Clock::time_point start);

  /// `first_pass_note` says what is told after the first pass; empty: nothing.
  void run(const RenderListeners& listeners, const std::function<std::string()>& first_pass_note);

  /// The picture so far, in all outputs.
  RenderResult finish();

 private:
  const Scene& scene_;
  const RenderOptions& options_;
  Film& film_;
  PassIntegrator& integrator_;
  FilmSession& session_;
  Statistics& statistics_;
  const Clock::time_point start_;
  Clock::time_point loop_start_;
  const PassRange range_;  // of the passes of this run
  const bool endless_;     // as many as the wanted error takes
  const bool with_channels_;
  PassIntegrator::Totals totals_;  // of earlier runs too
  Checkpoints checkpoints_;
  ConvergenceCheck convergence_;
  double recent_pass_ = 0;  // seconds; the longer of the last two: the first compiles kernels
  double last_pass_ = 0;
  double longest_write_ = 0;

  /// Takes note of what earlier runs have done.
  void count_earlier();
  /// Takes the totals of this run, and adds those of earlier ones.
  void take_totals(const PassIntegrator::Totals& of_this_run);
  /// Passes so far, of earlier runs too.
  std::uint64_t passes() const { return statistics_.passes; }
  /// Runs pass number `pass` and looks at the error.
  void run_pass(std::uint64_t pass);
  /// Where the render stands before pass number `next`.
  Progress progress_before(std::uint64_t next) const;
  /// Whether it ends before pass number `next`; then `statistics` says why.
  bool ends_before(std::uint64_t next, const std::function<bool()>& interrupted);
  /// Writes the film and the outputs where they are due.
  void write_checkpoints(const std::function<void(const std::string&)>& notice);
  std::vector<UnwrittenPicture> write(Picture& picture, Unwritable unwritable);
};

/// What an EXR says of its render.
Metadata metadata_of(const Scene& scene, const RenderOptions& options, const Statistics& statistics);

}  // namespace causticl
