// The film: device sums of radiance estimates, and the picture made of them.
#pragma once

#include <functional>

#include "film/film_file.hpp"
#include "film/pass_set.hpp"
#include "image/image.hpp"
#include "opencl/device.hpp"
#include "opencl/programs.hpp"
#include "shared/types.h"

namespace causticl {

/// The mean of `count` numbers by their exact sum.
double mean_of(const ExactSum& sum, std::uint64_t count);

/// Adds the errors of the luminance of each pixel as channels (pixel_error_kinds).
/// Of which pixels of a crop, row by row, a look at `most` of them tells the error: of number 0, of that many
/// further, and so on. It shares no factor with the width, so that all columns are visited.
std::size_t look_stride(const PixelRect& crop, std::size_t most);

void append_errors(std::vector<Channel>& channels, const std::vector<PixelError>& errors);

/// The channels of the layers of cl/film/light_passes.cl, all black.
std::vector<Channel> layer_channels(std::size_t pixels);

class Film {
 public:
  /// All black. With layers where the programs were built for them. `even` is that of cl/passes/pass_film.cl.
  /// Of the pixels of `crop` and those around, of a picture of `width` x `height`.
  Film(Device& device, Programs& programs, int width, int height, const PixelRect& crop, bool even);

  /// The pixels that are held; of those the picture has the crop.
  const PixelRect& rect() const { return rect_; }
  const PixelRect& crop() const { return crop_; }

  const cl::Buffer& buffer() const { return pixels_; }

  /// Takes `count` pixels from `first` on as they are in the film of another device, of the same size.
  void take_pixels(Film& from, std::size_t first, std::size_t count);
  /// Called before the film is read: to take what other devices have of it.
  void complete_by(std::function<void()> complete) { complete_ = std::move(complete); }
  std::size_t pixels() const { return rect_.pixels(); }
  bool has_layers() const;
  /// Device memory a pixel.
  std::size_t bytes_per_pixel() const {
    return sizeof(FilmPixel) + (has_layers() ? sizeof(FilmLightPasses) : 0) +
           (statistics_() ? sizeof(PixelStatistics) : 0);
  }

  /// Tells a launch which pixels these are.
  void set_pixels(Params& params) const;
  /// The elements of the crop among those of all pixels that are held.
  template <typename Element>
  std::vector<Element> cropped(const std::vector<Element>& all) const;

  /// The passes whose estimates have been added.
  const PassSet& passes() const { return passes_; }
  void add_pass(std::uint64_t pass) { passes_.add({pass, pass + 1}); }

  /// Photons were stored somewhere: if no pixel has found any, all of their light is missing.
  void set_photons_stored() { photons_stored_ = true; }

  /// Puts all that the film holds into `state`, or takes it from there: what save() was given of a film of
  /// the same size and layers.
  void save(FilmState& state);
  void restore(const FilmState& state);

  /// The mean of each pixel's estimates, of those that were finite. Waits for the queue.
  Picture picture();

  /// The same of each layer: direct.R, direct.G, direct.B, caustic.R ... indirect.B. Needs has_layers().
  std::vector<Channel> layers();

  /// The errors of every pixel of the crop. Waits for the queue.
  std::vector<PixelError> errors();
  /// The same of `most` pixels at most, spread over the crop (look_stride()), but that noise is as if
  /// estimates were independent: that is cheaper, and of a look while passes are still to come only its
  /// course counts.
  std::vector<PixelError> look(std::size_t most) { return errors(most, false); }

 private:
  std::vector<PixelError> errors(std::size_t most, bool even);

  Device& device_;
  PixelRect crop_, rect_;
  bool even_;
  Programs& programs_;
  PassSet passes_;
  bool photons_stored_ = false;
  cl::Buffer pixels_, statistics_, found_, errors_;
  std::size_t errors_capacity_ = 0;
  std::function<void()> complete_;
  cl::Kernel film_statistics_, pixel_errors_;
};

template <typename Element>
std::vector<Element> Film::cropped(const std::vector<Element>& all) const {
  if (crop_ == rect_) return all;
  std::vector<Element> result;
  result.reserve(crop_.pixels());
  for (int y = crop_.y0; y < crop_.y1; ++y) {
    const auto row = all.begin() + static_cast<std::ptrdiff_t>(y - rect_.y0) * rect_.width();
    result.insert(result.end(), row + (crop_.x0 - rect_.x0), row + (crop_.x1 - rect_.x0));
  }
  return result;
}

}  // namespace causticl
