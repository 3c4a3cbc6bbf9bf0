#include "film.hpp"

#include <algorithm>

namespace causticl {

Film::Film(Device& device, int width, int height)
    : device_(device),
      width_(width),
      height_(height),
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

}  // namespace causticl
