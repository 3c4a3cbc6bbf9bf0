#include "render/film_session.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

#include "base/error.hpp"
#include "base/spelling.hpp"
#include "device_scene/diagnostics.hpp"

namespace causticl {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

FilmSession::FilmSession(const Scene& scene, const RenderOptions& options) : options_(options) {
  const FilmOptions& film = options.film;
  base_.identity = film.identity;
  base_.width = scene.width;
  base_.height = scene.height;
  base_.crop = crop_of(scene, options);
  base_.rect = with_margin(base_.crop, scene.width, scene.height);
  if (film.resume.empty()) return;
  earlier_ = read_film(film.resume);
  const std::string difference =
      difference_of(earlier_->identity, "the film", film.identity, "in this command");
  if (!difference.empty())
    throw UserError(film.resume + ": is of another render (" + difference +
                    "); expected the scene and options that it began with");
  if (earlier_->crop != base_.crop)
    throw UserError(film.resume + ": holds the pixels " + text_of(earlier_->crop) + "; expected --crop " +
                    text_of(base_.crop) + " as in this command");
  if (earlier_->rect != base_.rect)
    throw UserError(
        film.resume +
        ": was merged of crops and lacks the pixels around them; expected a film of the whole picture "
        "or of a single crop");
  if (!earlier_->passes.is_whole() && !film.range)
    throw UserError(film.resume + ": holds the passes " + text_of(earlier_->passes) +
                    " alone; say with --pass-range which passes to add");
  if (film.range && (earlier_->passes.ranges().size() > 1 || earlier_->passes.end() != film.range->begin))
    throw UserError("--pass-range " + text_of(*film.range) + ": the film holds the passes " +
                    text_of(earlier_->passes) + "; expected a range that begins with " +
                    std::to_string(earlier_->passes.end() + 1));
  base_.devices = earlier_->devices;
}

FilmSession::~FilmSession() {
  if (writing_.valid()) writing_.wait();
}

PassRange FilmSession::passes(std::uint64_t wanted) const {
  if (options_.film.range) return *options_.film.range;
  const std::uint64_t begin = earlier_ ? earlier_->passes.end() : 0;
  return {begin, std::max(begin, wanted)};
}

std::string FilmSession::notice(const std::string& device) const {
  if (!earlier_) return "";
  std::string text =
      "goes on from " + options_.film.resume + ", which holds the passes " + text_of(earlier_->passes);
  if (std::any_of(earlier_->devices.begin(), earlier_->devices.end(),
                  [&](const std::string& other) { return other != device; }))
    text += ", of " + joined(earlier_->devices, " and ") + ": the bits will be those of no single device";
  return text;
}

void FilmSession::restore(const std::vector<std::unique_ptr<RenderDevice>>& devices,
                          PassIntegrator& integrator) {
  base_.depends_on_history = integrator.depends_on_history();
  const PassRange range = passes(0);
  const bool apart = range.begin > 0 && (!earlier_ || !earlier_->passes.is_whole());
  if (apart && !base_.depends_on_history.empty())
    throw UserError("--pass-range " + text_of(range) + ": " + base_.depends_on_history.front());
  const std::string others = integrator.depends_on_other_pixels();
  if (options_.film.crop && !others.empty()) throw UserError("--crop " + text_of(base_.crop) + ": " + others);
  if (earlier_) {
    bool complete = earlier_->layers.empty() != options_.layers;
    for (const auto& [block, bytes] : integrator.state())
      complete = complete && earlier_->state.contains(block);
    if (!complete)
      throw UserError(options_.film.resume +
                      ": does not hold what films of this render hold; render it again");
    for (const auto& device : devices) device->film.restore(*earlier_);
  }
  if (range.begin > 0)
    integrator.go_on(earlier_ ? earlier_->state : IntegratorState{}, static_cast<std::uint32_t>(range.begin));
  // It is on the devices now.
  if (!earlier_) return;
  earlier_->pixels = {};
  earlier_->layers = {};
  earlier_->state.clear();
}

bool FilmSession::due(double seconds) {
  if (!options_.film.every || options_.film.file.empty() || seconds - last_write_ < *options_.film.every)
    return false;
  if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return false;
  last_write_ = seconds;
  return true;
}

void FilmSession::write(Film& film, PassIntegrator& integrator, const Statistics& statistics) {
  const auto start = std::chrono::steady_clock::now();
  // Kept by whom writes it: the next pass changes what is on the device.
  auto state = std::make_shared<FilmState>(base_);
  film.save(*state);
  state->state = integrator.state();
  if (std::find(state->devices.begin(), state->devices.end(), statistics.device) == state->devices.end())
    state->devices.push_back(statistics.device);
  state->photons = statistics.photons;
  state->rays = statistics.rays;
  state->seconds = statistics.pass_seconds;
  for (const auto& kind : diagnostic_kinds) state->diagnostics[kind.key] = statistics.diagnostics.*kind.count;
  writing_ = std::async(std::launch::async, [state, file = options_.film.file]() -> std::string {
    try {
      write_film(file, *state);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  });
  longest_stop_ = std::max(longest_stop_, seconds_since(start));
}

std::string FilmSession::take_fault(bool wait) {
  if (!writing_.valid()) return "";
  if (!wait && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return "";
  return writing_.get();
}

}  // namespace causticl
