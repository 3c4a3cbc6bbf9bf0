#include "render/render_loop.hpp"

#include <algorithm>
#include <limits>

#include "scene/integrators.hpp"

namespace causticl {
namespace {

using Clock = RenderLoop::Clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// With fewer passes the estimate of the error is too noisy to stop by.
constexpr std::uint64_t fewest_passes = 8;

/// 1, 2, 3, 4, 6, 8, 12, 16, ...: two a doubling.
bool snapshot_due(std::uint64_t passes) {
  while (passes > 3 && passes % 2 == 0) passes /= 2;
  return passes <= 3;
}

std::uint64_t wanted_passes(const RendererSpec& renderer) {
  return static_cast<std::uint64_t>(renderer.*row_of(renderer.integrator).passes);
}

}  // namespace

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

RenderLoop::RenderLoop(const Scene& scene, const RenderOptions& options, Film& film,
                       PassIntegrator& integrator, FilmSession& session, Statistics& statistics,
                       Clock::time_point start)
    : scene_(scene),
      options_(options),
      film_(film),
      integrator_(integrator),
      session_(session),
      statistics_(statistics),
      start_(start),
      loop_start_(Clock::now()),
      range_(session.passes(wanted_passes(scene.renderer))),
      endless_(options.wanted_error && range_.end == endless_passes),
      with_channels_(std::any_of(options.outputs.begin(), options.outputs.end(), holds_channels)),
      checkpoints_(scene.renderer.integrator),
      convergence_(film, scene.renderer, options.confidence, options.wanted_error) {
  statistics.confidence = options.confidence;
  count_earlier();
}

void RenderLoop::count_earlier() {
  const auto& earlier = session_.earlier();
  if (!earlier) return;
  statistics_.passes = earlier->passes.count();
  statistics_.pass_seconds = earlier->seconds;
  take_totals({});
  convergence_.skip(passes());
}

void RenderLoop::take_totals(const PassIntegrator::Totals& of_this_run) {
  totals_ = of_this_run;
  if (const auto& earlier = session_.earlier()) {
    totals_.photons_emitted += earlier->photons;
    totals_.rays += earlier->rays;
    for (const auto& kind : diagnostic_kinds)
      if (const auto count = earlier->diagnostics.find(kind.key); count != earlier->diagnostics.end())
        totals_.diagnostics.*kind.count += count->second;
  }
  statistics_.photons = totals_.photons_emitted;
  statistics_.rays = totals_.rays;
  statistics_.diagnostics = totals_.diagnostics;
}

void RenderLoop::run(const RenderListeners& listeners, const std::function<std::string()>& first_pass_note) {
  loop_start_ = Clock::now();
  for (std::uint64_t pass = range_.begin; pass < range_.end; ++pass) {
    run_pass(pass);
    if (pass == range_.begin && listeners.notice && first_pass_note) listeners.notice(first_pass_note());
    if (options_.snapshot && snapshot_due(passes()))
      options_.snapshot({passes(), totals_.photons_emitted, statistics_.pass_seconds, film_.picture()});
    if (listeners.progress) listeners.progress(progress_before(pass + 1));
    if (ends_before(pass + 1, listeners.interrupted)) break;
    write_checkpoints(listeners.notice);
  }
}

void RenderLoop::write_checkpoints(const std::function<void(const std::string&)>& notice) {
  const auto later = [&](const std::string& fault) {
    if (notice && !fault.empty()) notice(fault + " (will be tried again)");
  };
  later(session_.take_fault(false));
  if (session_.due(seconds_since(loop_start_))) session_.write(film_, integrator_, statistics_);
  if (options_.outputs.empty() || !checkpoints_.due(passes(), seconds_since(loop_start_), longest_write_))
    return;
  Picture so_far = film_.picture();
  // A disk that is full now may have room at the end: the work so far is not thrown away.
  for (const auto& [file, fault] : write(so_far, Unwritable::lost)) later(fault);
}

void RenderLoop::run_pass(std::uint64_t pass) {
  const auto pass_start = Clock::now();
  integrator_.enqueue_pass(static_cast<std::uint32_t>(pass));
  take_totals(integrator_.finish());
  film_.add_pass(pass);
  const bool is_first = pass == range_.begin;
  statistics_.passes = film_.passes().count();
  const double seconds = seconds_since(pass_start) + (is_first ? integrator_.early_seconds() : 0);
  if (is_first) statistics_.first_pass_done_seconds = seconds_since(start_);
  recent_pass_ = pass < range_.begin + 2 ? seconds : std::max(last_pass_, seconds);
  last_pass_ = seconds;
  const auto look_start = Clock::now();
  convergence_.update(passes());
  statistics_.error_seconds += seconds_since(look_start);
  statistics_.pass_seconds += seconds;
}

Progress RenderLoop::progress_before(std::uint64_t next) const {
  const double elapsed = seconds_since(start_);
  const double per_pass = seconds_since(loop_start_) / static_cast<double>(next - range_.begin);
  Progress now;
  now.pass = passes();
  now.passes = endless_ ? 0 : passes() + (range_.end - next);
  now.seconds = elapsed;
  now.remaining =
      endless_ ? std::numeric_limits<double>::infinity() : per_pass * static_cast<double>(range_.end - next);
  if (options_.time_limit)
    now.remaining = std::min(now.remaining, std::max(0.0, *options_.time_limit - elapsed));
  now.photons = totals_.photons_emitted;
  now.rays = totals_.rays;
  if (const auto& earlier = session_.earlier()) {
    now.photons_before = earlier->photons;
    now.rays_before = earlier->rays;
  }
  now.pass_seconds = statistics_.pass_seconds;
  now.wanted_error = options_.wanted_error;
  if (!convergence_.last()) return now;
  now.error = convergence_.last()->error;
  if (const auto further = convergence_.passes_to_half(passes())) now.seconds_to_half = per_pass * *further;
  if (options_.wanted_error)
    now.remaining = std::min(now.remaining, per_pass * convergence_.passes_to_wanted(passes()));
  return now;
}

bool RenderLoop::ends_before(std::uint64_t next, const std::function<bool()>& interrupted) {
  if (options_.wanted_error && passes() >= fewest_passes && convergence_.last() &&
      convergence_.last()->error <= *options_.wanted_error) {
    statistics_.stop = StopReason::error;
    return true;
  }
  if (next == range_.end) return true;
  if (interrupted && interrupted()) {
    statistics_.stop = StopReason::interrupted;
    return true;
  }
  // The next pass and writing the picture must fit into what is left.
  if (options_.time_limit && seconds_since(start_) + recent_pass_ + longest_write_ > *options_.time_limit) {
    statistics_.stop = StopReason::time;
    return true;
  }
  return false;
}

std::vector<UnwrittenPicture> RenderLoop::write(Picture& picture, Unwritable unwritable) {
  const auto write_start = Clock::now();
  if (with_channels_) {
    picture.channels = integrator_.channels();
    append_errors(picture.channels, film_.errors());
    if (options_.layers)
      for (auto& channel : film_.layers()) picture.channels.push_back(std::move(channel));
  }
  statistics_.seconds = seconds_since(start_);
  statistics_.error = convergence_.measure(statistics_.passes);
  auto unwritten =
      write_pictures(options_.outputs, picture, metadata_of(scene_, options_, statistics_), unwritable);
  longest_write_ = std::max(longest_write_, seconds_since(write_start));
  return unwritten;
}

RenderResult RenderLoop::finish() {
  const double seconds = std::max(seconds_since(loop_start_) + integrator_.early_seconds(), 1e-9);
  const auto& earlier = session_.earlier();
  statistics_.passes_to_half_error = convergence_.passes_to_half(passes());
  statistics_.stored_photons = totals_.photons_stored_last_pass;
  statistics_.seeds = totals_.seeds;
  const auto rate = [&](std::uint64_t all, std::uint64_t before) {
    return static_cast<double>(all - before) / seconds;
  };
  statistics_.photons_per_second = rate(statistics_.photons, earlier ? earlier->photons : 0);
  statistics_.rays_per_second = rate(statistics_.rays, earlier ? earlier->rays : 0);
  RenderResult result;
  result.picture = film_.picture();
  if (!options_.film.file.empty()) {
    session_.take_fault(true);
    session_.write(film_, integrator_, statistics_);
  }
  result.unwritten = write(result.picture, Unwritable::kept);
  if (const std::string fault = session_.take_fault(true); !fault.empty())
    result.unwritten.push_back({options_.film.file, fault});
  statistics_.film_stop_seconds = session_.longest_stop();
  if (integrator_.began() != Clock::time_point{})
    statistics_.first_pass_seconds = std::chrono::duration<double>(integrator_.began() - start_).count();
  statistics_.bytes_per_pixel = static_cast<double>(film_.bytes_per_pixel()) + integrator_.bytes_per_pixel();
  return result;
}

}  // namespace causticl
