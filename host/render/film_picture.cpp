#include "render/film_picture.hpp"

#include "accuracy/error_estimate.hpp"
#include "base/spelling.hpp"
#include "film/film.hpp"
#include "opencl/programs.hpp"
#include "shared/effects.h"

namespace causticl {

RenderResult picture_of(const FilmState& state, Device& device, double confidence) {
  KernelOptions kernels;
  kernels.effects = state.layers.empty() ? 0u : OUTPUT_LIGHT_PASSES;
  Programs programs(device, kernels, {"film"});
  Film film(device, programs, state.width, state.height, state.crop, state.even);
  film.restore(state);
  RenderResult result;
  result.picture = film.picture();
  const auto errors = film.errors();
  append_errors(result.picture.channels, errors);
  if (film.has_layers())
    for (auto& channel : film.layers()) result.picture.channels.push_back(std::move(channel));
  Statistics& statistics = result.statistics;
  statistics.device = joined(state.devices, " + ");
  statistics.passes = state.passes.count();
  statistics.photons = state.photons;
  statistics.rays = state.rays;
  statistics.seconds = statistics.pass_seconds = state.seconds;
  statistics.confidence = confidence;
  if (statistics.passes > 1) statistics.error = picture_error(errors, confidence);
  for (const auto& kind : diagnostic_kinds)
    if (const auto count = state.diagnostics.find(kind.key); count != state.diagnostics.end())
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
