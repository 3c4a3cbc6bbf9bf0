#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "image/image_exr_channels.hpp"
#include "image/image_formats.hpp"
#include "image/image_metadata.hpp"

namespace causticl {
namespace {

class MemoryIn : public Imf::IStream {
 public:
  explicit MemoryIn(const std::string& bytes) : IStream("image"), bytes_(bytes) {}
  bool read(char target[], int count) override {
    if (count < 0 || position_ > bytes_.size() || static_cast<std::size_t>(count) > bytes_.size() - position_)
      throw std::runtime_error("the file ends early; is it truncated?");
    std::memcpy(target, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::size_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }
  void clear() override {}

 private:
  const std::string& bytes_;
  std::uint64_t position_ = 0;
};

// OpenEXR writes its table of line offsets from a destructor, where a full disk would go unnoticed. So it
// writes to memory, and the file is written from there.
class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : OStream("image") {}
  void write(const char source[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes.size() < position_ + size) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, source, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  std::uint64_t position_ = 0;
};

int width_of(const Imath::Box2i& window) { return window.max.x - window.min.x + 1; }
int height_of(const Imath::Box2i& window) { return window.max.y - window.min.y + 1; }

/// The windows of a file: where there are pixels, and what is to be shown, of which they may be a part or
/// more. Throws std::runtime_error for sizes that are not read.
struct Windows {
  Imath::Box2i data, display;

  explicit Windows(const Imf::Header& header) : data(header.dataWindow()), display(header.displayWindow()) {
    for (const Imath::Box2i& window : {data, display})
      check_image_size(1ll + window.max.x - window.min.x, 1ll + window.max.y - window.min.y);
  }

  /// The display window of pixels of `floats` floats that are those of the data window: `outside` where there
  /// are none.
  std::vector<float> shown(std::vector<float> values, const std::vector<float>& outside) const {
    if (data == display) return values;
    const std::size_t floats = outside.size();
    const auto row = floats * static_cast<std::size_t>(width_of(data));
    const auto shown_row = floats * static_cast<std::size_t>(width_of(display));
    std::vector<float> result(shown_row * static_cast<std::size_t>(height_of(display)));
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = outside[i % floats];
    const int left = std::max(data.min.x, display.min.x), right = std::min(data.max.x, display.max.x);
    const int top = std::max(data.min.y, display.min.y), bottom = std::min(data.max.y, display.max.y);
    for (int y = top; y <= bottom && left <= right; ++y) {
      const auto from = static_cast<std::size_t>(y - data.min.y) * row +
                        floats * static_cast<std::size_t>(left - data.min.x);
      const auto to = static_cast<std::size_t>(y - display.min.y) * shown_row +
                      floats * static_cast<std::size_t>(left - display.min.x);
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(from),
                  floats * static_cast<std::size_t>(right - left + 1),
                  result.begin() + static_cast<std::ptrdiff_t>(to));
    }
    return result;
  }

  bool overlap() const { return data.intersects(display); }
};

/// Luminance with subsampled chroma, which only OpenEXR's half-float interface converts.
void decode_luminance_chroma(const std::string& bytes, std::vector<float>& rgba) {
  MemoryIn stream(bytes);
  Imf::RgbaInputFile file(stream);
  const Imath::Box2i window = file.dataWindow();
  const std::ptrdiff_t width = width_of(window);
  std::vector<Imf::Rgba> pixels(rgba.size() / 4);
  const std::ptrdiff_t offset = -window.min.x - width * window.min.y;
  file.setFrameBuffer(pixels.data() + offset, 1, static_cast<std::size_t>(width));
  file.readPixels(window.min.y, window.max.y);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    rgba[4 * i] = pixels[i].r;
    rgba[4 * i + 1] = pixels[i].g;
    rgba[4 * i + 2] = pixels[i].b;
    rgba[4 * i + 3] = pixels[i].a;
  }
}

/// Reads the chosen channels into four floats a pixel of the data window.
void decode_channels(Imf::InputFile& file, const ExrChannels& channels, std::vector<float>& rgba) {
  const Imath::Box2i window = file.header().dataWindow();
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < 4; ++c) {
    if (channels.names[c].empty()) {
      for (std::size_t i = c; i < rgba.size(); i += 4) rgba[i] = c == 3 ? 1.0f : 0.0f;
      continue;
    }
    frame.insert(channels.names[c],
                 Imf::Slice::Make(Imf::FLOAT, rgba.data() + c, window, 4 * sizeof(float),
                                  4 * sizeof(float) * static_cast<std::size_t>(width_of(window))));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  if (channels.is_grey)
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 1] = rgba[i + 2] = rgba[i];
}

bool are_srgb_primaries(const Imf::Chromaticities& file) {
  const Imf::Chromaticities srgb;  // those of Rec. ITU-R BT.709, which sRGB shares
  const auto near = [](const Imath::V2f& a, const Imath::V2f& b) { return (a - b).length() < 0.003f; };
  return near(file.red, srgb.red) && near(file.green, srgb.green) && near(file.blue, srgb.blue) &&
         near(file.white, srgb.white);
}

/// What the header says that is not applied.
std::vector<std::string> notes_of(const std::string& bytes, const Imf::Header& header) {
  std::vector<std::string> notes;
  constexpr char multipart_flag = 0x10;  // in the second byte of the version
  if (bytes.size() > 5 && (bytes[5] & multipart_flag))
    notes.push_back("it may have several parts: the first is read");
  if (Imf::hasChromaticities(header) && !are_srgb_primaries(Imf::chromaticities(header)))
    notes.push_back(primaries_note("chromaticities"));
  if (Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE)
    notes.push_back("it is a cube map, which is not supported: its pixels are taken as they lie in the file");
  if (!Windows(header).overlap())
    notes.push_back("its data window lies outside of its display window: it is black");
  return notes;
}

}  // namespace

bool is_exr(const std::string& bytes) { return bytes.compare(0, 4, "\x76\x2f\x31\x01") == 0; }

void decode_exr(const std::string& bytes, int& width, int& height, std::vector<float>& rgba,
                std::vector<std::string>* notes) {
  MemoryIn stream(bytes);
  Imf::InputFile file(stream);
  const Imf::ChannelList& list = file.header().channels();
  const Windows windows(file.header());
  rgba.assign(4 * static_cast<std::size_t>(width_of(windows.data)) *
                  static_cast<std::size_t>(height_of(windows.data)),
              0.0f);
  if (notes) *notes = notes_of(bytes, file.header());
  bool has_alpha = list.findChannel("A");
  if (list.findChannel("Y") && (list.findChannel("RY") || list.findChannel("BY"))) {
    decode_luminance_chroma(bytes, rgba);
  } else {
    const ExrChannels channels = choose_exr_channels(list);
    has_alpha = !channels.names[3].empty();
    if (notes) notes->insert(notes->end(), channels.notes.begin(), channels.notes.end());
    decode_channels(file, channels, rgba);
  }
  rgba = windows.shown(std::move(rgba), {0, 0, 0, has_alpha ? 0.0f : 1.0f});
  width = width_of(windows.display);
  height = height_of(windows.display);
}

std::vector<Channel> decode_exr_channels(const std::string& bytes, const std::string& prefix) {
  MemoryIn stream(bytes);
  Imf::InputFile file(stream);
  const Windows windows(file.header());
  const auto width = static_cast<std::size_t>(width_of(windows.data));
  const auto height = static_cast<std::size_t>(height_of(windows.data));
  std::vector<Channel> channels;
  const Imf::ChannelList& list = file.header().channels();
  for (auto i = list.begin(); i != list.end(); ++i)
    if (std::string(i.name()).starts_with(prefix) && i.channel().xSampling == 1 && i.channel().ySampling == 1)
      channels.push_back({i.name(), std::vector<float>(width * height)});
  if (channels.empty()) return channels;
  Imf::FrameBuffer frame;
  for (auto& channel : channels)
    frame.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), windows.data,
                                                sizeof(float), sizeof(float) * width));
  file.setFrameBuffer(frame);
  file.readPixels(windows.data.min.y, windows.data.max.y);
  for (auto& channel : channels) channel.values = windows.shown(std::move(channel.values), {0});
  return channels;
}

std::string encode_exr(const Picture& picture, const Metadata& metadata) {
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, text] : metadata) header.insert(name, Imf::StringAttribute(text));
  Imf::FrameBuffer frame;
  const auto insert = [&](const std::string& name, const float* values, std::size_t floats_a_pixel) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR asks for a pointer to write through in its one Slice; it only reads here.
    auto* base = const_cast<char*>(reinterpret_cast<const char*>(values));
    const std::size_t step = floats_a_pixel * sizeof(float);
    frame.insert(name, Imf::Slice(Imf::FLOAT, base, step, step * static_cast<std::size_t>(picture.width)));
  };
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) insert(names[c], picture.rgb.data() + c, 3);
  for (const auto& [name, values] : picture.channels) insert(name, values.data(), 1);
  MemoryOut stream;
  {
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(frame);
    file.writePixels(picture.height);
  }
  return std::move(stream.bytes);
}

}  // namespace causticl
