#include <stb/stb_image_write.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/error.hpp"
#include "base/output_file.hpp"
#include "image/image_formats.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const std::string& file) {
  std::string extension = fs::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Clamp to [0, 1], power 1/2.2, 8 bits. NaN is black.
unsigned char tone_map(float value) {
  const float clamped = value > 0 ? std::min(value, 1.0f) : 0.0f;
  return static_cast<unsigned char>(std::lround(255.0f * std::pow(clamped, 1 / 2.2f)));
}

std::string encoded(const std::string& file, const Picture& picture, const Metadata& metadata) {
  const std::string extension = lower_extension(file);
  try {
    return extension == ".png"   ? encode_png(picture)
           : extension == ".exr" ? encode_exr(picture, metadata)
                                 : encode_pfm(picture);
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
  const std::string extension = lower_extension(file);
  if (extension != ".png" && extension != ".exr" && extension != ".pfm")
    throw UserError(file + ": unknown output format; expected a name that ends in .png, .exr or .pfm");
  check_writable(file);
}

bool holds_channels(const std::string& file) { return lower_extension(file) == ".exr"; }

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
