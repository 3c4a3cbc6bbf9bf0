// How the rows and columns of a file lie in its picture.
#include <algorithm>
#include <cstdint>

#include "image_metadata.hpp"

namespace causticl {

int exif_orientation(std::string_view tiff) {
  const bool big = tiff.substr(0, 4) == std::string_view("MM\0*", 4);
  if (!big && tiff.substr(0, 4) != std::string_view("II*\0", 4)) return 1;
  // Of `size` bytes; 0 beyond the end.
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    if (at > tiff.size() || tiff.size() - at < size) return value;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8 | static_cast<unsigned char>(tiff[at + (big ? i : size - 1 - i)]);
    return value;
  };
  constexpr std::uint32_t orientation_tag = 0x0112, type_short = 3, type_long = 4;
  const std::size_t directory = number(4, 4);
  const std::size_t entries = number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (number(entry, 2) != orientation_tag) continue;
    const std::uint32_t type = number(entry + 2, 2);
    const std::uint32_t value = type == type_short  ? number(entry + 8, 2)
                                : type == type_long ? number(entry + 8, 4)
                                                    : 1;
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

void turn_upright(int orientation, int& width, int& height, std::vector<float>& rgba) {
  if (orientation <= 1 || orientation > 8) return;
  const bool transposed = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool from_bottom = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  const auto stored_width = static_cast<std::size_t>(width), stored_height = static_cast<std::size_t>(height);
  const std::size_t out_width = transposed ? stored_height : stored_width;
  const std::size_t out_height = transposed ? stored_width : stored_height;
  std::vector<float> upright(rgba.size());
  for (std::size_t row = 0; row < stored_height; ++row) {
    for (std::size_t column = 0; column < stored_width; ++column) {
      std::size_t x = transposed ? row : column, y = transposed ? column : row;
      if (from_right) x = out_width - 1 - x;
      if (from_bottom) y = out_height - 1 - y;
      std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * (row * stored_width + column)), 4,
                  upright.begin() + static_cast<std::ptrdiff_t>(4 * (y * out_width + x)));
    }
  }
  rgba = std::move(upright);
  width = static_cast<int>(out_width);
  height = static_cast<int>(out_height);
}

}  // namespace causticl
