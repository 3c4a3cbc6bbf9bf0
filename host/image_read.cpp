#include <stb/stb_image.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "error.hpp"
#include "image_formats.hpp"

namespace causticl {
namespace {

std::string read_bytes(const std::string& file) {
  const auto status = [&] {
    std::error_code error;
    return std::filesystem::status(file, error);
  }();
  if (!std::filesystem::exists(status)) throw UserError(file + ": no such file");
  if (std::filesystem::is_directory(status)) throw UserError(file + ": is a folder; expected an image");
  if (!std::filesystem::is_regular_file(status))
    throw UserError(file + ": is not a regular file; expected an image");
  std::ifstream in(file, std::ios::binary);
  std::string bytes;
  if (in) {
    std::error_code error;
    bytes.resize(std::filesystem::file_size(file, error));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  if (!in) throw UserError(file + ": cannot be read: " + std::strerror(errno));
  if (bytes.empty()) throw UserError(file + ": is empty; expected an image");
  return bytes;
}

/// A decoder's complaint with the file before it, on one line.
[[noreturn]] void fail(const std::string& file, const std::string& fault) {
  std::string line = fault;
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  throw UserError(file + ": cannot be decoded: " + line);
}

/// Feeds stb from memory, and throws when it asks for more than there is: stb itself takes what a truncated
/// JPEG, BMP, TGA or HDR lacks for zeros, and can look for the end of an HDR for ever. (What stb has
/// allocated by then is lost; a run that meets such a file ends.)
struct StbSource {
  const std::string& bytes;
  std::size_t position = 0;

  int read(char* target, int size) {
    // stb fills its buffer of 128 bytes as far as it can; any other size is data that it needs.
    const std::size_t count = std::min(static_cast<std::size_t>(size), bytes.size() - position);
    if (count == 0 || (count < static_cast<std::size_t>(size) && size != 128))
      throw std::runtime_error("it ends early; is it truncated?");
    std::memcpy(target, bytes.data() + position, count);
    position += count;
    return static_cast<int>(count);
  }

  void skip(int count) {
    const auto target = static_cast<long long>(position) + count;
    position = static_cast<std::size_t>(std::clamp(target, 0ll, static_cast<long long>(bytes.size())));
  }

  static stbi_io_callbacks callbacks() {
    return {
        [](void* user, char* target, int size) { return static_cast<StbSource*>(user)->read(target, size); },
        [](void* user, int count) { static_cast<StbSource*>(user)->skip(count); },
        [](void* user) {
          const auto* source = static_cast<StbSource*>(user);
          return static_cast<int>(source->position >= source->bytes.size());
        }};
  }
};

/// Throws for a JPEG with a Huffman table of more than 256 codes: stb_image before 2.28 writes past its own
/// tables there. Walks the markers as the decoder does, entropy-coded data between them included.
void check_jpeg_tables(const std::string& bytes) {
  const auto byte = [&](std::size_t i) -> std::size_t {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
  };
  if (byte(0) != 0xff || byte(1) != 0xd8) return;
  for (std::size_t at = bytes.find('\xff', 2); at < bytes.size(); at = bytes.find('\xff', at)) {
    while (byte(at) == 0xff) ++at;
    const std::size_t marker = byte(at++);
    if (marker < 0xc0 || (marker >= 0xd0 && marker <= 0xd9)) continue;  // stuffing, restarts, start, end
    const std::size_t end = at + std::size_t{256} * byte(at) + byte(at + 1);
    for (std::size_t table = at + 2; marker == 0xc4 && table < end;) {
      std::size_t codes = 0;
      for (std::size_t length = 1; length <= 16; ++length) codes += byte(table + length);
      if (codes > 256) throw std::runtime_error("a Huffman table has more than 256 codes");
      table += 17 + codes;
    }
    at = end;
  }
}

/// The value of an sRGB component in [0, 1] (IEC 61966-2-1).
float srgb_to_linear(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

constexpr const char* unknown_type = "expected PNG, JPEG, BMP, TGA, HDR, PFM or EXR";

template <typename T>
using StbLoader = T* (*)(const stbi_io_callbacks*, void*, int*, int*, int*, int);

/// Decodes to four floats a texel, top row first: integers as value/max, colours through the sRGB curve where
/// `srgb` says so.
template <typename T>
void decode_stb_as(StbLoader<T> load, const std::string& bytes, bool srgb, Image& image) {
  StbSource source{bytes};
  const stbi_io_callbacks io = StbSource::callbacks();
  int channels = 0;
  const std::unique_ptr<T, void (*)(void*)> pixels(
      load(&io, &source, &image.width, &image.height, &channels, 4), stbi_image_free);
  if (!pixels) {
    const std::string fault = stbi_failure_reason();
    throw std::runtime_error(fault == "unknown image type" ? unknown_type : fault);
  }
  check_image_size(image.width, image.height);

  image.rgba.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  if constexpr (std::is_floating_point_v<T>) {
    std::copy_n(pixels.get(), image.rgba.size(), image.rgba.begin());
  } else {
    constexpr std::size_t most = std::numeric_limits<T>::max();
    std::vector<float> alpha(most + 1), color(most + 1);
    for (std::size_t i = 0; i <= most; ++i) {
      alpha[i] = static_cast<float>(i) / static_cast<float>(most);
      color[i] = srgb ? srgb_to_linear(alpha[i]) : alpha[i];
    }
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
      image.rgba[i] = (i % 4 == 3 ? alpha : color)[pixels.get()[i]];
  }
}

void decode_stb(const std::string& bytes, bool srgb, Image& image) {
  if (bytes.size() > 0x7fffffff) throw std::runtime_error("it has more than 2^31 bytes");
  const auto* raw = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto length = static_cast<int>(bytes.size());
  constexpr std::size_t smallest = 18;  // a TGA's header; with less stb could not even look for the type
  if (bytes.size() < smallest) throw std::runtime_error(unknown_type);
  check_jpeg_tables(bytes);
  if (stbi_is_hdr_from_memory(raw, length))
    decode_stb_as<float>(stbi_loadf_from_callbacks, bytes, srgb, image);
  else if (stbi_is_16_bit_from_memory(raw, length))
    decode_stb_as<stbi_us>(stbi_load_16_from_callbacks, bytes, srgb, image);
  else
    decode_stb_as<stbi_uc>(stbi_load_from_callbacks, bytes, srgb, image);
}

/// Four floats a texel, top row first.
void decode_pfm_texels(const std::string& bytes, Image& image) {
  const Picture picture = decode_pfm(bytes);
  image.width = picture.width;
  image.height = picture.height;
  image.rgba.assign(picture.rgb.size() / 3 * 4, 1.0f);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) image.rgba[i / 3 * 4 + i % 3] = picture.rgb[i];
}

}  // namespace

void check_image_size(long long width, long long height) {
  constexpr long long most = 1ll << 28;
  if (width < 1 || height < 1) throw std::runtime_error("it has no pixels");
  if (width > most || height > most || width * height > most)
    throw std::runtime_error(std::to_string(width) + "x" + std::to_string(height) +
                             " pixels are too many; at most 2^28 are read");
}

Image read_image(const std::string& file, bool srgb) {
  const std::string bytes = read_bytes(file);
  Image image;
  image.file = file;
  try {
    if (is_exr(bytes))
      decode_exr(bytes, image.width, image.height, image.rgba);
    else if (is_pfm(bytes))
      decode_pfm_texels(bytes, image);
    else
      decode_stb(bytes, srgb, image);
  } catch (const std::bad_alloc&) {
    fail(file, "it does not fit into memory");
  } catch (const std::exception& error) {
    fail(file, error.what());
  }
  const std::size_t row = 4 * static_cast<std::size_t>(image.width);
  for (std::size_t low = 0, high = static_cast<std::size_t>(image.height) - 1; low < high; ++low, --high)
    std::swap_ranges(image.rgba.begin() + static_cast<std::ptrdiff_t>(low * row),
                     image.rgba.begin() + static_cast<std::ptrdiff_t>((low + 1) * row),
                     image.rgba.begin() + static_cast<std::ptrdiff_t>(high * row));
  return image;
}

Picture read_picture(const std::string& file) {
  const std::string bytes = read_bytes(file);
  try {
    if (!is_exr(bytes)) return decode_pfm(bytes);
    Picture picture;
    std::vector<float> rgba;
    decode_exr(bytes, picture.width, picture.height, rgba);
    picture.rgb.resize(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = rgba[i / 3 * 4 + i % 3];
    picture.channels = decode_exr_channels(bytes, "error.");
    return picture;
  } catch (const std::bad_alloc&) {
    fail(file, "it does not fit into memory");
  } catch (const std::exception& error) {
    fail(file, error.what());
  }
}

}  // namespace causticl
