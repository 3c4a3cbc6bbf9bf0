#include "render/film_picture.hpp"

#include <algorithm>
#include <map>

#include "accuracy/error_estimate.hpp"
#include "base/spelling.hpp"
#include "film/film.hpp"
#include "opencl/programs.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

// As ConvergenceCheck::measure() looks at.
constexpr std::size_t measure_pixels = 4096;

/// Adds the errors of those pixels of a crop, by their number in the whole, that a look at the whole asks
/// for.
void add_errors(const std::vector<PixelError>& of_crop, const PixelRect& crop, const PixelRect& whole,
                std::map<std::size_t, PixelError>& errors) {
  const std::size_t stride = look_stride(whole, measure_pixels);
  std::size_t i = 0;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x, ++i) {
      const auto number = static_cast<std::size_t>(y - whole.y0) * static_cast<std::size_t>(whole.width()) +
                          static_cast<std::size_t>(x - whole.x0);
      if (number % stride == 0) errors[number] = of_crop[i];
    }
}

/// Puts the numbers of a crop, `each` for every pixel, into their place among those of the whole.
void paste(const std::vector<float>& from, const PixelRect& crop, std::size_t each, const PixelRect& whole,
           std::vector<float>& to) {
  to.resize(whole.pixels() * each);
  const auto width = [&](const PixelRect& rect) { return static_cast<std::ptrdiff_t>(rect.width() * each); };
  for (int y = crop.y0; y < crop.y1; ++y) {
    const auto row = from.begin() + (y - crop.y0) * width(crop);
    std::copy(row, row + width(crop),
              to.begin() + (y - whole.y0) * width(whole) +
                  (crop.x0 - whole.x0) * static_cast<std::ptrdiff_t>(each));
  }
}

}  // namespace

RenderResult picture_of(const FilmMerger& films, Device& device, double confidence) {
  const FilmState whole = films.summary();
  RenderResult result;
  Picture& picture = result.picture;
  picture.width = whole.crop.width();
  picture.height = whole.crop.height();
  std::map<std::size_t, PixelError> errors;  // of some pixels
  films.for_each_crop([&](const FilmState& state) {
    KernelOptions kernels;
    kernels.effects = state.layers.empty() ? 0u : OUTPUT_LIGHT_PASSES;
    Programs programs(device, kernels, {"film"});
    Film film(device, programs, state.width, state.height, state.crop, state.even);
    film.restore(state);
    add_errors(film.look(state.crop.pixels()), state.crop, whole.crop, errors);
    std::vector<Channel> channels;
    append_errors(channels, film.errors());
    if (film.has_layers())
      for (auto& channel : film.layers()) channels.push_back(std::move(channel));
    paste(film.picture().rgb, state.crop, 3, whole.crop, picture.rgb);
    picture.channels.resize(channels.size());
    for (std::size_t i = 0; i < channels.size(); ++i) {
      picture.channels[i].name = channels[i].name;
      paste(channels[i].values, state.crop, 1, whole.crop, picture.channels[i].values);
    }
  });
  Statistics& statistics = result.statistics;
  statistics.device = joined(whole.devices, " + ");
  statistics.passes = whole.passes.count();
  statistics.photons = whole.photons;
  statistics.rays = whole.rays;
  statistics.seconds = statistics.pass_seconds = whole.seconds;
  statistics.confidence = confidence;
  std::vector<PixelError> looked_at;
  for (const auto& [number, error] : errors) looked_at.push_back(error);
  if (statistics.passes > 1) statistics.error = picture_error(looked_at, confidence);
  for (const auto& kind : diagnostic_kinds)
    if (const auto count = whole.diagnostics.find(kind.key); count != whole.diagnostics.end())
      statistics.diagnostics.*kind.count = count->second;
  return result;
}

Metadata metadata_of(const FilmState& film, const Statistics& statistics) {
  Metadata metadata{{"passes", text_of(film.passes)},
                    {"photons", std::to_string(statistics.photons)},
                    {"device", statistics.device},
                    {"seconds", std::to_string(statistics.seconds)},
                    {"error", statistics.error ? std::to_string(statistics.error->error) : "unknown"},
                    {"confidence", std::to_string(statistics.confidence)},
                    {"causticl_version", CAUSTICL_VERSION}};
  for (const auto& [key, value] : film.identity) metadata[key] = value;
  for (const auto& kind : diagnostic_kinds)
    metadata[kind.key] = std::to_string(statistics.diagnostics.*kind.count);
  return metadata;
}

}  // namespace causticl
