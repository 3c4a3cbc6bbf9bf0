#include <stb/stb_image.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "image/image_formats.hpp"
#include "image/image_metadata.hpp"
#include "image/image_radiance.hpp"
#include "image/jpeg_markers.hpp"
#include "image/stb_memory.hpp"

namespace causticl {
namespace {

/// A decoder's complaint with the file before it, on one line.
[[noreturn]] void fail(const std::string& file, const std::string& fault) {
  std::string line = fault;
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  throw UserError(file + ": cannot be decoded: " + line);
}

/// Feeds stb from memory, and throws when it asks for more than there is: stb itself takes what a truncated
/// JPEG, BMP, TGA or HDR lacks for zeros, and can look for the end of an HDR for ever. (What stb has
/// allocated by then, StbMemory gives back.)
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

constexpr const char* unknown_type = "expected PNG, JPEG, BMP, TGA, HDR, PFM or EXR";

/// Why stb failed last. Some of its failures give no reason: what is left then is that of a format that the
/// file was tried for before.
std::string stb_fault() {
  const std::string fault = stbi_failure_reason() ? stbi_failure_reason() : "";
  if (fault.empty() || fault == "bad png sig" || fault == "no SOI") return "it is damaged";
  return fault == "unknown image type" ? unknown_type : fault;
}

template <typename T>
using StbLoader = T* (*)(const stbi_io_callbacks*, void*, int*, int*, int*, int);

/// Throws with the reason why stb finds no picture. stbi_info() tries one format after another and keeps the
/// reason of the last one; the decoder of the file's own format has the right one.
[[noreturn]] void fail_stb_header(const std::string& bytes, const ImageLimits& limits) {
  constexpr std::size_t header = 24;  // of a PNG, up to the end of its size
  if (bytes.starts_with("\x89PNG") && bytes.size() >= header) {
    const auto number = [&](std::size_t at) {
      std::int64_t value = 0;
      for (std::size_t i = at; i < at + 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes[i]);
      return value;
    };
    const std::int64_t width = number(16), height = number(20);
    if (width == 0 || height == 0) throw std::runtime_error("0-pixel image");
    check_image_cost(stb_cost(bytes, width, height), bytes.size(), limits);
  }
  StbSource source{bytes};
  const stbi_io_callbacks io = StbSource::callbacks();
  int width = 0, height = 0, channels = 0;
  stb_forget_failure();
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_callbacks(&io, &source, &width, &height, &channels, 4), stbi_image_free);
  throw std::runtime_error(stb_fault());
}

/// The size in the header. Throws where stb knows no such picture, or where decoding it would cost too much;
/// returns what stb may allocate for it.
std::uint64_t check_stb_header(const std::string& bytes, const ImageLimits& limits) {
  if (is_jpeg(bytes)) check_jpeg(bytes);  // before stb reads its tables
  const StbMemory memory(1u << 20);
  StbSource source{bytes};
  const stbi_io_callbacks io = StbSource::callbacks();
  int width = 0, height = 0, channels = 0;
  stb_forget_failure();
  if (!stbi_info_from_callbacks(&io, &source, &width, &height, &channels)) fail_stb_header(bytes, limits);
  // The height of a BMP is negative where its top row comes first.
  const ImageCost cost = stb_cost(bytes, std::llabs(width), std::llabs(height));
  check_image_cost(cost, bytes.size(), limits);
  const std::uint64_t rows = 64 * static_cast<std::uint64_t>(cost.width) + 65536;
  return cost.working + 2 * cost.result + 3 * bytes.size() + rows;
}

/// Decodes to four floats a texel, top row first: integers as value/max, colours through `transfer`.
template <typename T>
void decode_stb_as(StbLoader<T> load, const std::string& bytes, const Transfer& transfer, int orientation,
                   Image& image) {
  StbSource source{bytes};
  const stbi_io_callbacks io = StbSource::callbacks();
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<T, void (*)(void*)> pixels(load(&io, &source, &width, &height, &channels, 4),
                                                   stbi_image_free);
  if (!pixels) throw std::runtime_error(stb_fault());

  std::vector<float> alpha, color;  // of all integers
  if constexpr (!std::is_floating_point_v<T>) {
    constexpr std::size_t most = std::numeric_limits<T>::max();
    for (std::size_t i = 0; i <= most; ++i) {
      alpha.push_back(static_cast<float>(i) / static_cast<float>(most));
      color.push_back(transfer.to_linear(alpha[i]));
    }
  }
  const Upright upright(orientation, width, height);
  image.width = upright.width();
  image.height = upright.height();
  image.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const T* stored = pixels.get();
  for (std::size_t row = 0; row < static_cast<std::size_t>(height); ++row)
    for (std::size_t column = 0; column < static_cast<std::size_t>(width); ++column, stored += 4) {
      float* texel = image.rgba.data() + 4 * upright.place(row, column);
      for (std::size_t c = 0; c < 4; ++c) {
        if constexpr (std::is_floating_point_v<T>)
          texel[c] = stored[c];
        else
          texel[c] = (c == 3 ? alpha : color)[stored[c]];
      }
    }
}

/// What the file says about its pixels beside them.
ImageMetadata metadata_of(const std::string& bytes) {
  if (bytes.starts_with("\x89PNG")) return png_metadata(bytes);
  if (is_jpeg(bytes)) return jpeg_metadata(bytes);
  ImageMetadata metadata;
  // A TGA, known by no signature, whose rows run from right to left. stb_image sees which row comes first.
  constexpr char right_to_left = 0x10;
  if (!bytes.starts_with("BM") && (bytes[17] & right_to_left)) metadata.orientation = 2;
  return metadata;
}

/// Throws for what stb cannot look at: it counts bytes in an int, and needs those of a TGA's header.
void check_length(const std::string& bytes) {
  constexpr std::size_t smallest = 18;
  if (bytes.size() > 0x7fffffff) throw std::runtime_error("it has more than 2^31 bytes");
  if (bytes.size() < smallest) throw std::runtime_error(unknown_type);
}

void decode_radiance(const std::string& bytes, bool, const ImageLimits& limits, Image& image) {
  check_length(bytes);
  RadiancePicture picture = read_radiance(bytes, limits);
  const StbMemory memory(check_stb_header(picture.bytes, limits));
  stb_forget_failure();
  decode_stb_as<float>(stbi_loadf_from_callbacks, picture.bytes, {}, picture.orientation, image);
  finish_radiance(picture, image.rgba);
  image.notes = std::move(picture.notes);
}

void decode_stb(const std::string& bytes, bool srgb, const ImageLimits& limits, Image& image) {
  check_length(bytes);
  const auto* raw = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto length = static_cast<int>(bytes.size());
  const StbMemory memory(check_stb_header(bytes, limits));
  ImageMetadata metadata = metadata_of(bytes);
  Transfer transfer;
  if (srgb) {
    transfer = metadata.transfer.value_or(Transfer{Transfer::Curve::srgb});
    image.notes = std::move(metadata.notes);
  }
  stb_forget_failure();
  if (stbi_is_16_bit_from_memory(raw, length))
    decode_stb_as<stbi_us>(stbi_load_16_from_callbacks, bytes, transfer, metadata.orientation, image);
  else
    decode_stb_as<stbi_uc>(stbi_load_from_callbacks, bytes, transfer, metadata.orientation, image);
}

void decode_exr_texels(const std::string& bytes, bool, const ImageLimits& limits, Image& image) {
  check_image_cost(exr_cost(bytes), bytes.size(), limits);
  decode_exr(bytes, image.width, image.height, image.rgba, &image.notes);
}

void decode_pfm_texels(const std::string& bytes, bool, const ImageLimits& limits, Image& image) {
  const Picture picture = decode_pfm(bytes, &image.notes);
  image.width = picture.width;
  image.height = picture.height;
  check_image_cost({picture.width, picture.height, 0, picture.rgb.size() * sizeof(float)}, bytes.size(),
                   limits);
  image.rgba.assign(picture.rgb.size() / 3 * 4, 1.0f);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) image.rgba[i / 3 * 4 + i % 3] = picture.rgb[i];
}

/// A format of images: how a file of it begins, and its decoder to four floats a texel, top row first, within
/// limits; a decoder of integers takes colours for sRGB where it is told to.
struct ImageFormat {
  bool (*begins_so)(const std::string& bytes);
  void (*decode)(const std::string& bytes, bool srgb, const ImageLimits& limits, Image& image);
};
constexpr ImageFormat image_formats[] = {
    {is_exr, decode_exr_texels},
    {is_pfm, decode_pfm_texels},
    {is_radiance, decode_radiance},
    {[](const std::string&) { return true; }, decode_stb},  // PNG, JPEG, BMP, and TGA, which has no signature
};

}  // namespace

void check_image_size(long long width, long long height) {
  constexpr long long most = 1ll << 28;
  if (width < 1 || height < 1) throw std::runtime_error("it has no pixels");
  if (width > most || height > most || width * height > most)
    throw std::runtime_error(std::to_string(width) + "x" + std::to_string(height) +
                             " pixels are too many; at most 2^28 are read");
}

Image read_image(const std::string& file, bool srgb, const ImageLimits& limits) {
  const std::string bytes = read_input(file, "an image", limits.memory);
  Image image;
  image.file = file;
  try {
    const auto format = std::find_if(std::begin(image_formats), std::end(image_formats),
                                     [&](const ImageFormat& each) { return each.begins_so(bytes); });
    format->decode(bytes, srgb, limits, image);
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

Picture read_picture(const std::string& file, const ImageLimits& limits) {
  const std::string bytes = read_input(file, "an image", limits.memory);
  try {
    if (!is_exr(bytes)) return decode_pfm(bytes);
    check_image_cost(exr_cost(bytes), bytes.size(), limits);
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
