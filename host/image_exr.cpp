#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <cstring>
#include <stdexcept>

#include "image_formats.hpp"

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

/// Luminance with subsampled chroma, which only OpenEXR's half-float interface converts.
void decode_luminance_chroma(const std::string& bytes, std::vector<float>& rgba) {
  MemoryIn stream(bytes);
  Imf::RgbaInputFile file(stream);
  const Imath::Box2i window = file.dataWindow();
  const std::ptrdiff_t width = std::ptrdiff_t{window.max.x} - window.min.x + 1;
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

}  // namespace

bool is_exr(const std::string& bytes) { return bytes.compare(0, 4, "\x76\x2f\x31\x01") == 0; }

void decode_exr(const std::string& bytes, int& width, int& height, std::vector<float>& rgba) {
  MemoryIn stream(bytes);
  Imf::InputFile file(stream);
  const Imath::Box2i window = file.header().dataWindow();
  check_image_size(1ll + window.max.x - window.min.x, 1ll + window.max.y - window.min.y);
  width = window.max.x - window.min.x + 1;
  height = window.max.y - window.min.y + 1;
  rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);

  const Imf::ChannelList& channels = file.header().channels();
  if (channels.findChannel("RY") || channels.findChannel("BY")) return decode_luminance_chroma(bytes, rgba);
  const bool grey = !channels.findChannel("R") && !channels.findChannel("G") && !channels.findChannel("B");
  if (grey && !channels.findChannel("Y")) {
    std::string names;
    for (auto i = channels.begin(); i != channels.end(); ++i) names += std::string(" ") + i.name();
    throw std::runtime_error("it has no channel R, G, B or Y, but:" + names);
  }
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B", "A"};
  for (int c = 0; c < 4; ++c) {
    if (grey && (c == 1 || c == 2)) continue;
    frame.insert(
        grey && c == 0 ? "Y" : names[c],
        Imf::Slice::Make(Imf::FLOAT, rgba.data() + c, window, 4 * sizeof(float),
                         4 * sizeof(float) * static_cast<std::size_t>(width), 1, 1, c == 3 ? 1.0 : 0.0));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  if (grey)
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgba[i + 1] = rgba[i + 2] = rgba[i];
}

std::vector<Channel> decode_exr_channels(const std::string& bytes, const std::string& prefix) {
  MemoryIn stream(bytes);
  Imf::InputFile file(stream);
  const Imath::Box2i window = file.header().dataWindow();
  check_image_size(1ll + window.max.x - window.min.x, 1ll + window.max.y - window.min.y);
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  const auto height = static_cast<std::size_t>(window.max.y - window.min.y) + 1;
  std::vector<Channel> channels;
  const Imf::ChannelList& list = file.header().channels();
  for (auto i = list.begin(); i != list.end(); ++i)
    if (std::string(i.name()).starts_with(prefix) && i.channel().xSampling == 1 && i.channel().ySampling == 1)
      channels.push_back({i.name(), std::vector<float>(width * height)});
  if (channels.empty()) return channels;
  Imf::FrameBuffer frame;
  for (auto& channel : channels)
    frame.insert(channel.name, Imf::Slice::Make(Imf::FLOAT, channel.values.data(), window, sizeof(float),
                                                sizeof(float) * width));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
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
