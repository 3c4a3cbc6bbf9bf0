// The headers of an EXR file, read for what the library would allocate by them.
#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "image/image_limits.hpp"

namespace causticl {
namespace {

constexpr unsigned multipart = 0x1000;

[[noreturn]] void fail(const std::string& fault) { throw std::runtime_error(fault); }

/// Takes values off the front of bytes, lowest byte first.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  std::string_view bytes(std::size_t count) {
    if (count > rest_.size()) fail("the file ends early; is it truncated?");
    const std::string_view result = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return result;
  }
  std::int32_t number() {
    const std::string_view four = bytes(4);
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
      value |= std::uint32_t{static_cast<unsigned char>(four[i])} << (8 * i);
    return static_cast<std::int32_t>(value);
  }
  bool is_empty() const { return rest_.empty(); }
  /// Up to a NUL.
  std::string_view name() {
    const std::string_view result = bytes(std::min(rest_.find('\0'), rest_.size()));
    bytes(1);
    return result;
  }

 private:
  std::string_view rest_;
};

/// A rectangle of pixels, both ends within.
struct Window {
  long long width = 0, height = 0;

  explicit Window(Reader reader) {
    const long long left = reader.number(), top = reader.number();
    width = reader.number() - left + 1;
    height = reader.number() - top + 1;
  }
  Window() = default;
  bool holds_pixels() const { return width > 0 && height > 0; }
};

struct Part {
  Window data, display;
  std::uint64_t pixel_bytes = 0, error_channels = 0;
  bool is_luminance_chroma = false;
  unsigned compression = 0;
  std::uint64_t tile_width = 0, tile_height = 0;  // 0: lines

  /// Lines that are compressed together.
  std::uint64_t lines() const {
    constexpr std::uint64_t by_compression[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return compression < std::size(by_compression) ? by_compression[compression] : 256;
  }
};

void read_channels(Reader reader, Part& part) {
  constexpr std::uint64_t sizes[] = {4, 2, 4};  // unsigned, half, float
  for (std::string_view name = reader.name(); !name.empty(); name = reader.name()) {
    const auto type = static_cast<std::uint32_t>(reader.number());
    reader.bytes(12);  // whether it is linear, and its sampling
    part.pixel_bytes += type < std::size(sizes) ? sizes[type] : 4;
    part.error_channels += name.starts_with("error.");
    part.is_luminance_chroma = part.is_luminance_chroma || name == "RY" || name == "BY";
  }
  if (!reader.is_empty()) fail("its header is damaged: its list of channels is shorter than it says");
}

/// The library reads values of these types without a look at the size that the header gives, and would take
/// what follows for something else where they differ.
void check_size(std::string_view type, std::uint64_t size, Reader value) {
  constexpr std::pair<std::string_view, std::uint64_t> sizes[] = {{"box2f", 16},
                                                                  {"box2i", 16},
                                                                  {"chromaticities", 32},
                                                                  {"compression", 1},
                                                                  {"deepImageState", 1},
                                                                  {"double", 8},
                                                                  {"envmap", 1},
                                                                  {"float", 4},
                                                                  {"int", 4},
                                                                  {"keycode", 28},
                                                                  {"lineOrder", 1},
                                                                  {"m33d", 72},
                                                                  {"m33f", 36},
                                                                  {"m44d", 128},
                                                                  {"m44f", 64},
                                                                  {"rational", 8},
                                                                  {"tiledesc", 9},
                                                                  {"timecode", 8},
                                                                  {"v2d", 16},
                                                                  {"v2f", 8},
                                                                  {"v2i", 8},
                                                                  {"v3d", 24},
                                                                  {"v3f", 12},
                                                                  {"v3i", 12}};
  std::uint64_t expected = size;
  for (const auto& [name, bytes] : sizes)
    if (name == type) expected = bytes;
  if (type == "preview") {
    const auto width = static_cast<std::uint32_t>(value.number()),
               height = static_cast<std::uint32_t>(value.number());
    expected = 8 + 4 * (std::uint64_t{width} * height);
  }
  if (size != expected)
    fail("its header is damaged: a value of type " + std::string(type) + " has " + std::to_string(size) +
         " bytes, not " + std::to_string(expected));
}

/// False at the end of the headers.
bool read_part(Reader& reader, Part& part) {
  bool any = false;
  for (std::string_view name = reader.name(); !name.empty(); name = reader.name()) {
    any = true;
    const std::string_view type = reader.name();
    const std::int32_t size = reader.number();
    if (size < 0) fail("its header is damaged: an attribute has a negative size");
    const Reader value(reader.bytes(static_cast<std::size_t>(size)));
    check_size(type, static_cast<std::uint64_t>(size), value);
    Reader own = value;
    Part unnamed;
    if (type == "chlist") read_channels(value, name == "channels" ? part : unnamed);
    if (name == "dataWindow") part.data = Window(value);
    if (name == "displayWindow") part.display = Window(value);
    if (name == "compression") part.compression = static_cast<unsigned char>(own.bytes(1)[0]);
    if (name == "tiles") {
      part.tile_width = static_cast<std::uint32_t>(own.number());
      part.tile_height = static_cast<std::uint32_t>(own.number());
    }
  }
  return any;
}

/// Bytes of the buffers that one piece passes through.
std::uint64_t piece_bytes(const Part& part) {
  const auto width = static_cast<std::uint64_t>(part.data.width);
  const auto height = static_cast<std::uint64_t>(part.data.height);
  const std::uint64_t lines = std::min(part.tile_height > 0 ? part.tile_height : part.lines(), height);
  return 4 * part.pixel_bytes * width * lines;
}

/// The file has 8 bytes for each of its pieces, before the first.
void check_pieces(const Part& part, std::size_t file_size) {
  const auto width = static_cast<std::uint64_t>(part.data.width);
  const auto height = static_cast<std::uint64_t>(part.data.height);
  std::uint64_t pieces = (height + part.lines() - 1) / part.lines();
  if (part.tile_width > 0 && part.tile_height > 0) {
    constexpr std::uint64_t largest_tile = 1u << 23;
    if (part.tile_width > std::max(largest_tile, width) ||
        part.tile_height > std::max(largest_tile, height) ||
        part.tile_width * part.tile_height > std::max(largest_tile, width * height))
      fail("its header is damaged: it has tiles of " + std::to_string(part.tile_width) + "x" +
           std::to_string(part.tile_height) + " pixels");
    pieces = ((width + part.tile_width - 1) / part.tile_width) *
             ((height + part.tile_height - 1) / part.tile_height);
  }
  if (pieces > file_size / 8) fail("the file ends early; is it truncated?");
}

}  // namespace

ImageCost exr_cost(const std::string& bytes) {
  Reader reader(bytes);
  reader.bytes(4);
  const auto flags = static_cast<std::uint32_t>(reader.number());
  std::vector<Part> parts(1);
  if (!read_part(reader, parts[0])) fail("its header is empty");
  if (flags & multipart)
    for (Part part; read_part(reader, part); part = {}) parts.push_back(part);

  ImageCost cost;
  for (const Part& part : parts) {
    if (!part.data.holds_pixels()) fail("it has no pixels");
    check_pieces(part, bytes.size());
    cost.working = std::max(cost.working, piece_bytes(part));
  }
  // The picture has the size of either window.
  const Part& first = parts[0];
  const bool by_display = first.display.holds_pixels() && first.display.width <= 1 << 28 &&
                          first.display.height <= 1 << 28 && first.data.width <= 1 << 28 &&
                          first.data.height <= 1 << 28 &&
                          first.display.width * first.display.height > first.data.width * first.data.height;
  const Window& window = by_display ? first.display : first.data;
  cost.width = window.width;
  cost.height = window.height;
  const std::uint64_t extra = 4 * first.error_channels + (first.is_luminance_chroma ? 8 : 0);
  if (cost.width <= 1 << 28 && cost.height <= 1 << 28)
    cost.result = extra * static_cast<std::uint64_t>(cost.width * cost.height);
  return cost;
}

}  // namespace causticl
