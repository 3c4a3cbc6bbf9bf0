// The film: device sums of radiance estimates, and the picture made of them.
#pragma once

#include <functional>

#include "image/image.hpp"
#include "opencl/device.hpp"
#include "opencl/programs.hpp"
#include "shared/types.h"

namespace causticl {

/// Adds the errors of the luminance of each pixel as channels (pixel_error_kinds).
void append_errors(std::vector<Channel>& channels, const std::vector<PixelError>& errors);

/// The channels of the layers of cl/film/light_passes.cl, all black.
std::vector<Channel> layer_channels(std::size_t pixels);

class Film {
 public:
  /// All black. With layers where the programs were built for them. `even` is that of cl/passes/pass_film.cl.
  Film(Device& device, Programs& programs, int width, int height, bool even);

  const cl::Buffer& buffer() const { return pixels_; }

  /// Takes `count` pixels from `first` on as they are in the film of another device, of the same size.
  void take_pixels(Film& from, std::size_t first, std::size_t count);
  /// Called before the film is read: to take what other devices have of it.
  void complete_by(std::function<void()> complete) { complete_ = std::move(complete); }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * height_; }
  bool has_layers() const;
  std::size_t bytes_per_pixel() const {
    return sizeof(FilmPixel) + (has_layers() ? sizeof(FilmLightPasses) : 0);
  }

  /// The mean of `passes` estimates a pixel, of those that were finite. Waits for the queue.
  Picture picture(std::uint64_t passes);

  /// The same of each layer: direct.R, direct.G, direct.B, caustic.R ... indirect.B. Needs has_layers().
  std::vector<Channel> layers(std::uint64_t passes);

  /// The errors of every pixel after `passes` passes. Waits for the queue.
  std::vector<PixelError> errors(std::uint64_t passes) { return errors(passes, pixels(), even_); }
  /// The same of `most` pixels at most, spread over the picture, but that noise is as if estimates were
  /// independent: that is cheaper, and of a look while passes are still to come only its course counts.
  std::vector<PixelError> look(std::uint64_t passes, std::size_t most) { return errors(passes, most, false); }

 private:
  std::vector<PixelError> errors(std::uint64_t passes, std::size_t most, bool even);

  Device& device_;
  int width_, height_;
  bool even_;
  Programs& programs_;
  cl::Buffer pixels_, errors_;
  std::size_t errors_capacity_ = 0;
  std::function<void()> complete_;
  cl::Kernel pixel_errors_;
};

}  // namespace causticl
