#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "image/image_formats.hpp"

namespace causticl {
namespace {

float swapped(float value) {
  auto bits = std::bit_cast<std::array<char, 4>>(value);
  std::swap(bits[0], bits[3]);
  std::swap(bits[1], bits[2]);
  return std::bit_cast<float>(bits);
}

}  // namespace

bool is_pfm(const std::string& bytes) {
  return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') &&
         std::isspace(static_cast<unsigned char>(bytes[2]));
}

Picture decode_pfm(const std::string& bytes, std::vector<std::string>* notes) {
  // The header: PF or Pf, width, height, scale; one blank, or the line end of a Windows text; then the rows.
  // A negative scale says little-endian; its magnitude is a factor.
  std::istringstream header(bytes.substr(0, 128));
  std::string magic;
  long long width = 0, height = 0;
  double scale = 0;
  if (!(header >> magic) || (magic != "PF" && magic != "Pf"))
    throw std::runtime_error("expected PF or Pf at its beginning; is it a PFM file?");
  if (!(header >> width >> height >> scale) || !std::isfinite(scale) || scale == 0)
    throw std::runtime_error("its header is damaged; expected width, height and scale");
  check_image_size(width, height);
  std::size_t begin = header.eof() ? bytes.size() : static_cast<std::size_t>(header.tellg()) + 1;
  const bool windows_text = bytes.compare(2, 2, "\r\n") == 0;
  if (windows_text && begin < bytes.size() && bytes[begin - 1] == '\r' && bytes[begin] == '\n') ++begin;
  const std::size_t channels = magic == "PF" ? 3 : 1;
  const std::size_t row = static_cast<std::size_t>(width) * channels;
  const std::size_t expected = row * static_cast<std::size_t>(height) * sizeof(float);
  if (bytes.size() < begin || bytes.size() - begin < expected)
    throw std::runtime_error("its pixels end early; expected " + std::to_string(expected) +
                             " bytes of them; is it truncated?");

  const bool swap = (scale < 0) != (std::endian::native == std::endian::little);
  Picture picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.rgb.resize(static_cast<std::size_t>(width * height) * 3);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const char* source =
        bytes.data() + begin + (static_cast<std::size_t>(height) - 1 - y) * row * sizeof(float);
    float* target = picture.rgb.data() + y * static_cast<std::size_t>(width) * 3;
    for (std::size_t i = 0; i < static_cast<std::size_t>(width) * 3; ++i) {
      float value;
      std::memcpy(&value, source + (channels == 3 ? i : i / 3) * sizeof(float), sizeof(float));
      target[i] = swap ? swapped(value) : value;
    }
  }
  const double factor = std::fabs(scale);
  if (factor != 1) {
    for (float& value : picture.rgb) value = static_cast<float>(value * factor);
    if (notes) notes->push_back("its values are multiplied by the scale factor in its header");
  }
  return picture;
}

std::string encode_pfm(const Picture& picture) {
  std::string bytes =
      "PF\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
  const std::size_t row = static_cast<std::size_t>(picture.width) * 3, begin = bytes.size();
  bytes.resize(begin + picture.rgb.size() * sizeof(float));
  char* target = bytes.data() + begin;
  for (int y = picture.height - 1; y >= 0; --y) {
    for (std::size_t i = 0; i < row; ++i, target += sizeof(float)) {
      const float value = picture.rgb[static_cast<std::size_t>(y) * row + i];
      const float little = std::endian::native == std::endian::little ? value : swapped(value);
      std::memcpy(target, &little, sizeof(float));
    }
  }
  return bytes;
}

}  // namespace causticl
