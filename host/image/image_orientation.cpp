// How the rows and columns of a file lie in its picture.
#include <cstdint>

#include "image/image_metadata.hpp"

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

Upright::Upright(int orientation, int width, int height)
    : transposed_(orientation >= 5),
      from_right_(orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7),
      from_bottom_(orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8),
      width_(static_cast<std::size_t>(transposed_ ? height : width)),
      height_(static_cast<std::size_t>(transposed_ ? width : height)) {}

}  // namespace causticl
