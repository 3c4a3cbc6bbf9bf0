#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/spelling.hpp"
#include "image/image_formats.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

/// Clamp to [0, 1], power 1/2.2, 8 bits. NaN is black.
unsigned char tone_map(float value) {
  const float clamped = value > 0 ? std::min(value, 1.0f) : 0.0f;
  return static_cast<unsigned char>(std::lround(255.0f * std::pow(clamped, 1 / 2.2f)));
}

/// A format of pictures to write, and its encoder.
struct PictureFormat {
  const char* extension;  // in lower case
  std::string (*encode)(const Picture& picture, const Metadata& metadata);
  bool holds_channels;
};
constexpr PictureFormat picture_formats[] = {
    {".png", [](const Picture& picture, const Metadata&) { return encode_png(picture); }, false},
    {".exr", encode_exr, true},
    {".pfm", [](const Picture& picture, const Metadata&) { return encode_pfm(picture); }, false},
};

/// That of a file by its extension; null where it is unknown.
const PictureFormat* format_of(const std::string& file) {
  const std::string extension = lower(fs::path(file).extension().string());
  for (const PictureFormat& format : picture_formats)
    if (extension == format.extension) return &format;
  return nullptr;
}

/// Throws UserError where the format is unknown.
const PictureFormat& known_format_of(const std::string& file) {
  if (const PictureFormat* format = format_of(file)) return *format;
  std::vector<std::string> extensions;
  for (const PictureFormat& format : picture_formats) extensions.emplace_back(format.extension);
  throw UserError(file + ": unknown output format; expected a name that ends in " + listed(extensions));
}

std::string encoded(const std::string& file, const Picture& picture, const Metadata& metadata) {
  const PictureFormat& format = known_format_of(file);
  try {
    return format.encode(picture, metadata);
  } catch (const std::exception& error) {
    throw UserError(file + ": cannot be written: " + error.what());
  }
}

}  // namespace

std::string encode_png(const Picture& picture) {
  std::vector<unsigned char> pixels(picture.rgb.size());
  std::transform(picture.rgb.begin(), picture.rgb.end(), pixels.begin(), tone_map);
  std::string bytes;
  const auto append = [](void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3, pixels.data(), 0))
    throw std::runtime_error("the PNG encoder failed");
  return bytes;
}

void check_output(const std::string& file) {
  known_format_of(file);
  check_writable(file);
}

bool holds_channels(const std::string& file) {
  const PictureFormat* format = format_of(file);
  return format && format->holds_channels;
}

void write_picture(const std::string& file, const Picture& picture, const Metadata& metadata) {
  check_output(file);
  write_file(file, encoded(file, picture, metadata));
}

std::vector<UnwrittenPicture> write_pictures(const std::vector<std::string>& files, const Picture& picture,
                                             const Metadata& metadata, Unwritable unwritable) {
  std::vector<UnwrittenPicture> unwritten;
  for (const auto& file : files) try {
      const std::string bytes = encoded(file, picture, metadata);
      unwritable == Unwritable::kept ? write_file_or_keep(file, bytes) : write_file(file, bytes);
    } catch (const UserError& error) {
      unwritten.push_back({file, error.what()});
    }
  return unwritten;
}

}  // namespace causticl
