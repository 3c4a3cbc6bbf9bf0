// What a render has added up so far, on the host.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "film/pass_set.hpp"
#include "shared/types.h"

namespace causticl {

/// Of the picture, the pixels [x0, x1) times [y0, y1), counted from the top left.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
  bool operator==(const PixelRect&) const = default;
};

/// A crop with the pixels around it by which the errors of its pixels are told.
PixelRect with_margin(const PixelRect& crop, int width, int height);

/// "0,0,640,480".
std::string text_of(const PixelRect& rect);

/// What decides what the estimates of a render are: its scene, seed, kernels and options, each with a name
/// for messages.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

/// State of an integrator beside the film, as bytes of the device: "sppm.pixels" and the like.
using IntegratorState = std::map<std::string, std::vector<std::byte>>;

/// A film on the host.
struct FilmState {
  RenderIdentity identity;
  int width = 0, height = 0;  // of the whole picture
  PixelRect crop;             // what is to be shown of it
  PixelRect rect;  // the pixels that are held, in rows from the top: those, and those around by which
                   //   their errors are told
  PassSet passes;
  bool even = false;                    // as the film of the device has it
  std::vector<FilmPixel> pixels;        // rect.pixels()
  std::vector<FilmLightPasses> layers;  // as many, or none
  IntegratorState state;
  bool photons_stored = false;                       // as the film of the device has it
  std::vector<std::string> depends_on_history;       // why its passes cannot be added to those of other runs
  std::vector<std::string> devices;                  // that have rendered it
  std::uint64_t photons = 0, rays = 0;               // so far
  double seconds = 0;                                // of passes so far
  std::map<std::string, std::uint64_t> diagnostics;  // by their keys
};

/// Whether the sums are what so many passes can add up: else they may be beyond what sums of films hold.
bool sums_fit(const FilmState& film);

/// What differs between two identities, as in "seed: 1 in a.film, 2 here"; empty where nothing does.
std::string difference_of(const RenderIdentity& theirs, const std::string& name, const RenderIdentity& ours,
                          const std::string& our_name);

}  // namespace causticl
