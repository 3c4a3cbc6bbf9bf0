// Image files written by a test, with what programs write beside the pixels.
#pragma once

#include <stb/stb_image_write.h>

#include <string>
#include <vector>

#include "image/image.hpp"
#include "temporary_folder.hpp"

namespace causticl {

inline void append_to_string(void* target, void* data, int size) {
  static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

inline std::string big_endian_bytes(std::uint32_t value, int size = 4) {
  std::string bytes;
  for (int i = size - 1; i >= 0; --i) bytes += static_cast<char>(value >> 8 * i);
  return bytes;
}

/// A chunk of a PNG file. Its checksum is none: nothing here looks at it.
inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian_bytes(static_cast<std::uint32_t>(data.size())) + type + data + "sum ";
}

/// Data as zlib packs it, without compression.
inline std::string zlib_stored(const std::string& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  std::string bytes = "\x78\x01\x01";
  for (const std::uint32_t value : {size, ~size}) {
    bytes += static_cast<char>(value);
    bytes += static_cast<char>(value >> 8);
  }
  return bytes + data + "sum ";
}

/// A PNG of grey values of 8 or 16 bits, top row first, with these chunks before its pixels.
inline std::string grey_png(int width, int height, const std::vector<unsigned>& values, int bits,
                            const std::string& chunks) {
  std::string rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % static_cast<std::size_t>(width) == 0) rows += '\0';  // no filter
    rows += big_endian_bytes(values[i], bits / 8);
  }
  const std::string header = big_endian_bytes(static_cast<std::uint32_t>(width)) +
                             big_endian_bytes(static_cast<std::uint32_t>(height)) + static_cast<char>(bits) +
                             std::string(4, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + chunks + png_chunk("IDAT", zlib_stored(rows)) +
         png_chunk("IEND", "");
}

/// A directory of TIFF with one entry, the orientation.
inline std::string exif_block(int orientation, bool big, int type = 3) {
  const auto number = [&](std::uint32_t value, int size) {
    std::string bytes = big_endian_bytes(value, size);
    return big ? bytes : std::string(bytes.rbegin(), bytes.rend());
  };
  const auto value = static_cast<std::uint32_t>(orientation);
  return (big ? std::string("MM") : std::string("II")) + number(42, 2) + number(10, 4) + "xx" + number(2, 2) +
         number(0x10f, 2) + number(2, 2) + number(4, 4) + "abc" + std::string(1, '\0') + number(0x112, 2) +
         number(static_cast<std::uint32_t>(type), 2) + number(1, 4) +
         (type == 3 ? number(value, 2) + "zz" : number(value, 4)) + number(0, 4);
}

/// Notes, a line each.
inline std::string notes_of(const Image& image) {
  std::string result;
  for (const std::string& note : image.notes) result += note + "\n";
  return result;
}

/// The red values, top row first.
inline std::vector<float> red_rows(const Image& image) {
  std::vector<float> result;
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x)
      result.push_back(image.rgba[4 * static_cast<std::size_t>(y * image.width + x)]);
  return result;
}

}  // namespace causticl
