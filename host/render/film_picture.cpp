#include "render/film_picture.hpp"

#include <algorithm>

#include "accuracy/error_estimate.hpp"
#include "base/spelling.hpp"
#include "film/film.hpp"
#include "opencl/programs.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

// As ConvergenceCheck::measure() looks at, of every crop.
constexpr std::size_t measure_pixels = 4096;

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
  std::vector<PixelError> errors;  // of some pixels
  films.for_each_crop([&](const FilmState& state) {
    KernelOptions kernels;
    kernels.effects = state.layers.empty() ? 0u : OUTPUT_LIGHT_PASSES;
    Programs programs(device, kernels, {"film"});
    Film film(device, programs, state.width, state.height, state.crop, state.even);
    film.restore(state);
    const auto some = film.look(measure_pixels);
    errors.insert(errors.end(), some.begin(), some.end());
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
  if (statistics.passes > 1) statistics.error = picture_error(errors, confidence);
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
