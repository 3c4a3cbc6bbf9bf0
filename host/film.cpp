#include "film.hpp"

#include <algorithm>
#include <numeric>

namespace causticl {

Film::Film(Device& device, Programs& programs, int width, int height)
    : device_(device),
      width_(width),
      height_(height),
      programs_(programs),
      pixels_(device.buffer(pixels() * sizeof(FilmPixel), "film")) {
  device_.clear(pixels_, pixels() * sizeof(FilmPixel));
}

Picture Film::picture(std::uint64_t passes) {
  const auto sums = device_.download<FilmPixel>(pixels_, pixels());
  Picture picture{width_, height_, std::vector<float>(3 * pixels())};
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double scale = 1.0 / static_cast<double>(std::max<std::uint64_t>(passes, sums[i].left_out + 1ull) -
                                                   sums[i].left_out);
    for (int c = 0; c < 3; ++c)
      picture.rgb[3 * i + c] =
          static_cast<float>(scale * (static_cast<double>(sums[i].sum[c]) + sums[i].low[c]));
  }
  return picture;
}

std::vector<PixelError> Film::errors(std::uint64_t passes, std::size_t most) {
  // A stride that shares no factor with the width visits all columns.
  std::size_t stride = (pixels() + most - 1) / most;
  while (stride > 1 && std::gcd(stride, static_cast<std::size_t>(width_)) != 1) ++stride;
  const std::size_t count = (pixels() + stride - 1) / stride;
  if (errors_capacity_ < count) {
    errors_ = device_.buffer(count * sizeof(PixelError), "errors of pixels");
    errors_capacity_ = count;
  }
  if (!pixel_errors_()) pixel_errors_ = programs_.kernel("film", "pixel_errors");
  set_arguments(pixel_errors_, pixels_, errors_, static_cast<cl_uint>(width_), static_cast<cl_uint>(height_),
                static_cast<cl_uint>(passes), static_cast<cl_uint>(stride), static_cast<cl_uint>(count));
  device_.launch_pass(pixel_errors_, count);
  return device_.download<PixelError>(errors_, count);
}

}  // namespace causticl
