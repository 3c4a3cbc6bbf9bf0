// The film: device sums of radiance estimates, and the picture made of them.
#pragma once

#include "device.hpp"
#include "image.hpp"
#include "types.h"

namespace causticl {

class Film {
 public:
  /// All black.
  Film(Device& device, int width, int height);

  const cl::Buffer& buffer() const { return pixels_; }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * height_; }
  static constexpr double bytes_per_pixel = sizeof(FilmPixel);

  /// The mean of `passes` estimates a pixel, of those that were finite. Waits for the queue.
  Picture picture(std::uint64_t passes);

 private:
  Device& device_;
  int width_, height_;
  cl::Buffer pixels_;
};

}  // namespace causticl
