// What decoding an image may cost, weighed against its header before memory is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace causticl {

/// `--max-image-memory`.
struct ImageLimits {
  static constexpr std::uint64_t default_memory = std::uint64_t{4} << 30;

  /// Bytes that all images of a scene may take together, and the two of a comparison.
  std::uint64_t memory = default_memory;
  /// Whether a small file may hold a large picture: what a user asks for who names a limit.
  bool any_density = false;

  /// What is left after an image of so many pixels.
  ImageLimits after(std::uint64_t pixels) const;
};

/// Bytes that a pixel takes once it is decoded.
constexpr std::uint64_t decoded_pixel = 16;

/// What a header promises.
struct ImageCost {
  long long width = 0, height = 0;
  std::uint64_t working = 0;  // bytes that the decoder takes for itself
  std::uint64_t result = 0;   // bytes that it hands over, from which the pixels are made
};

/// Throws std::runtime_error for an image without pixels, for one of more than 2^28, for one of more than
/// 2^23 with less than a byte of file for 128 pixels, and for one that takes more than `limits.memory` to
/// decode.
void check_image_cost(const ImageCost& cost, std::size_t file_size, const ImageLimits& limits);

/// The cost of what stb_image decodes: PNG, JPEG, BMP, TGA, HDR, the size of which is known already. Throws
/// std::runtime_error for a JPEG that cannot be decoded safely (see jpeg_markers.hpp).
ImageCost stb_cost(const std::string& bytes, long long width, long long height);

/// The cost of an EXR file, by its headers alone. Throws std::runtime_error where they are damaged, or
/// promise what the file cannot hold.
ImageCost exr_cost(const std::string& bytes);

}  // namespace causticl
