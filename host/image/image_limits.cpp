#include "image/image_limits.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/input_file.hpp"
#include "image/image_formats.hpp"
#include "image/jpeg_markers.hpp"

namespace causticl {
namespace {

// A picture of 3840 x 2160 is below it, and takes less than 256 MiB to decode.
constexpr std::uint64_t small_picture = 1u << 23;
// Deflate packs at most 1030 bytes into one, which are 129 pixels of four channels of 16 bits.
constexpr std::uint64_t most_pixels_a_byte = 128;

ImageCost png_cost(const std::string& bytes, ImageCost cost) {
  // Its first chunk, behind 8 bytes of signature: length, "IHDR", width, height, bits, colour type, two more
  // bytes, interlaced. Where another comes first, the dearest kind of picture is assumed.
  const bool is_header = bytes.compare(12, 4, "IHDR") == 0 && bytes.size() > 28;
  const auto byte = [&](std::size_t at, unsigned otherwise) -> unsigned {
    return is_header ? static_cast<unsigned char>(bytes[at]) : otherwise;
  };
  const unsigned bits = std::min(byte(24, 16), 16u), color = byte(25, 6);
  const bool interlaced = byte(28, 1) != 0;
  const std::uint64_t channels = color == 3 ? 1 : (color & 2 ? 3u : 1u) + (color & 4 ? 1u : 0u);
  const auto width = static_cast<std::uint64_t>(cost.width), height = static_cast<std::uint64_t>(cost.height);
  const std::uint64_t filtered = ((width * bits + 7) / 8 * channels + 1) * height;
  // Interlaced rows are more and shorter, so that stb grows its buffer once.
  cost.working = interlaced ? 3 * filtered + 64 : filtered;
  cost.result = width * height * 4 * (bits == 16 ? 2 : 1);
  return cost;
}

ImageCost jpeg_cost(const std::string& bytes, ImageCost cost) {
  cost.working = check_jpeg(bytes);
  cost.result = static_cast<std::uint64_t>(cost.width * cost.height) * 4;
  return cost;
}

}  // namespace

ImageLimits ImageLimits::after(std::uint64_t pixels) const {
  return {memory - std::min(memory, pixels * decoded_pixel), any_density};
}

void check_image_cost(const ImageCost& cost, std::size_t file_size, const ImageLimits& limits) {
  check_image_size(cost.width, cost.height);
  const auto pixels = static_cast<std::uint64_t>(cost.width * cost.height);
  const std::string size = std::to_string(cost.width) + "x" + std::to_string(cost.height) + " pixels";
  if (!limits.any_density && pixels > small_picture && pixels / most_pixels_a_byte > file_size)
    throw std::runtime_error(
        size + " in a file of " + bytes_text(file_size) +
        " are more than 128 a byte; such a picture is read only where a limit of memory is "
        "given, as in --max-image-memory 4G");
  const std::uint64_t needed = file_size + cost.result + std::max(cost.working, pixels * decoded_pixel);
  if (needed > limits.memory)
    throw std::runtime_error("it takes " + bytes_text(needed) + " to decode its " + size + ", and " +
                             bytes_text(limits.memory) +
                             " are left for images; --max-image-memory SIZE, as in 8G, allows more");
}

ImageCost stb_cost(const std::string& bytes, long long width, long long height) {
  check_image_size(width, height);
  const ImageCost cost{width, height, 0, static_cast<std::uint64_t>(width * height) * 4};
  if (is_jpeg(bytes)) return jpeg_cost(bytes, cost);
  if (bytes.starts_with("\x89PNG")) return png_cost(bytes, cost);
  const bool is_hdr = bytes.starts_with("#?");
  return {width, height, cost.result, is_hdr ? cost.result * 4 : cost.result};
}

}  // namespace causticl
