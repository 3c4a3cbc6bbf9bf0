// Small files of images that cost much, made here.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

// stb has it, and declares it nowhere.
extern "C" unsigned char* stbi_zlib_compress(unsigned char* data, int size, int* compressed, int quality);

namespace causticl {

inline std::string big_endian(std::uint32_t value, int bytes) {
  std::string result;
  for (int i = bytes - 1; i >= 0; --i) result += static_cast<char>(value >> (8 * i) & 0xff);
  return result;
}

inline std::string little_endian(std::uint32_t value) {
  const std::string reversed = big_endian(value, 4);
  return {reversed.rbegin(), reversed.rend()};
}

/// A chunk of a PNG; stb reads no checksum.
inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size()), 4) + type + data + "none";
}

/// `data` as deflate packs it best, by stb's writer: 258 bytes into less than two at most.
inline std::string deflated(const std::vector<unsigned char>& data) {
  int size = 0;
  auto* bytes =
      stbi_zlib_compress(const_cast<unsigned char*>(data.data()), static_cast<int>(data.size()), &size, 8);
  std::string result(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  std::free(bytes);
  return result;
}

/// A PNG of this header, whose data are `inflated` zeros.
inline std::string png_of_zeros(std::uint32_t width, std::uint32_t height, char bits, char color,
                                std::size_t inflated) {
  return "\x89PNG\r\n\x1a\n" +
         png_chunk("IHDR",
                   big_endian(width, 4) + big_endian(height, 4) + bits + color + std::string(3, '\0')) +
         png_chunk("IDAT", deflated(std::vector<unsigned char>(inflated, 0))) + png_chunk("IEND", "");
}

/// A segment of a JPEG, with its length.
inline std::string jpeg_segment(unsigned char marker, const std::string& data) {
  return std::string("\xff") + static_cast<char>(marker) +
         big_endian(static_cast<std::uint32_t>(data.size() + 2), 2) + data;
}

/// A table of one code, of one bit, for the value 0. `kind`: 0x00 of differences of means, 0x10 of the
/// others.
inline std::string jpeg_table(char kind) {
  return jpeg_segment(0xc4, std::string(1, kind) + '\1' + std::string(16, '\0'));
}

/// A grey JPEG that ends as its first scan begins, or that has `scans` of them, progressive ones, without
/// data.
inline std::string jpeg_without_data(std::uint32_t width, std::uint32_t height, int scans, bool progressive) {
  const std::string scan = jpeg_segment(0xda, std::string("\1\1\0\0", 4) + (progressive ? '\0' : '?') + '\0');
  std::string bytes =
      "\xff\xd8" + jpeg_segment(0xdb, '\0' + std::string(64, '\1')) +
      jpeg_segment(progressive ? 0xc2 : 0xc0,
                   '\x8' + big_endian(height, 2) + big_endian(width, 2) + std::string("\1\1\x11\0", 4)) +
      jpeg_table(0) + jpeg_table(0x10);
  for (int i = 0; i < scans; ++i) bytes += scan;
  return bytes + "\xff\xd9" + std::string(200, '\0');
}

/// An attribute of an EXR header.
inline std::string exr_attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + little_endian(static_cast<std::uint32_t>(value.size())) + value;
}

/// A window from (0, 0) to (right, bottom).
inline std::string exr_window(std::uint32_t right, std::uint32_t bottom) {
  return std::string(8, '\0') + little_endian(right) + little_endian(bottom);
}

/// An EXR of three half channels that has these windows, `more` attributes, and nothing else.
inline std::string exr_header(const std::string& data_window, const std::string& display_window,
                              const std::string& more = "") {
  std::string channels;
  for (const char* name : {"B", "G", "R"})
    channels += name + std::string(1, '\0') + little_endian(1) + std::string(4, '\0') + little_endian(1) +
                little_endian(1);
  return "v/1\1" + little_endian(more.find("tiledesc") == more.npos ? 2 : 0x202) +
         exr_attribute("channels", "chlist", channels + '\0') +
         exr_attribute("compression", "compression", std::string(1, '\3')) +
         exr_attribute("dataWindow", "box2i", data_window) +
         exr_attribute("displayWindow", "box2i", display_window) +
         exr_attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         exr_attribute("pixelAspectRatio", "float", std::string("\0\0\x80?", 4)) +
         exr_attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         exr_attribute("screenWindowWidth", "float", std::string("\0\0\x80?", 4)) + more + '\0' +
         std::string(64, '\0');
}

}  // namespace causticl
