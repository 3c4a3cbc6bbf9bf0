// EXR: windows and channels.
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include "catch2.hpp"

#include "image_files.hpp"

namespace causticl {
namespace {

using Imath::Box2i;

/// Writes channels whose value at (x, y) is 100 y + x + n / 8, n the number of the channel.
std::string write_exr(const TemporaryFolder& folder, const Box2i& display, const Box2i& data,
                      const std::vector<std::string>& channels, Imf::Header header = {}) {
  const std::string file = folder.path("a.exr");
  header.displayWindow() = display;
  header.dataWindow() = data;
  const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
  std::vector<std::vector<float>> values;
  Imf::FrameBuffer frame;
  for (std::size_t n = 0; n < channels.size(); ++n) {
    auto& plane = values.emplace_back();
    for (int y = data.min.y; y <= data.max.y; ++y)
      for (int x = data.min.x; x <= data.max.x; ++x) plane.push_back(float(100 * y + x) + float(n) / 8);
    header.channels().insert(channels[n], Imf::Channel(Imf::FLOAT));
    frame.insert(channels[n], Imf::Slice::Make(Imf::FLOAT, plane.data(), data, sizeof(float),
                                               sizeof(float) * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(frame);
  out.writePixels(height);
  return file;
}

const Box2i small({0, 0}, {1, 1});

std::vector<float> first_texel(const Image& image) {
  const auto top_left = image.rgba.begin() + 4 * (image.height - 1) * image.width;
  return {top_left, top_left + 4};
}

}  // namespace

TEST_CASE("EXR: the picture is the display window, black where the data window does not reach") {
  const TemporaryFolder folder;
  const Box2i display({2, -1}, {7, 3});
  for (const Box2i& data : {display, Box2i({4, 0}, {5, 1}), Box2i({-3, -4}, {11, 9}), Box2i({0, 2}, {3, 12}),
                            Box2i({7, 3}, {9, 9}), Box2i({100, 100}, {101, 100})}) {
    for (const bool alpha : {false, true}) {
      CAPTURE(data.min.x, data.min.y, alpha);
      std::vector<std::string> channels{"R", "G", "B", "error.noise"};
      if (alpha) channels.push_back("A");
      const std::string file = write_exr(folder, display, data, channels);
      const Image image = read_image(file, true);
      REQUIRE(image.width == 6);
      REQUIRE(image.height == 5);
      const Picture picture = read_picture(file);
      REQUIRE(picture.width == 6);
      REQUIRE(picture.channels.size() == 1);
      for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 6; ++x) {
          const Imath::V2i at(display.min.x + x, display.min.y + y);
          const bool inside = data.intersects(at);
          const float value = inside ? float(100 * at.y + at.x) : 0;
          const auto texel = image.rgba.begin() + 4 * ((4 - y) * 6 + x);
          CHECK(texel[0] == value);
          CHECK(texel[2] == (inside ? value + 0.25f : 0));
          CHECK(texel[3] == (alpha ? inside ? value + 0.5f : 0 : 1));
          const auto pixel = static_cast<std::size_t>(y * 6 + x);
          CHECK(picture.rgb[3 * pixel] == value);
          CHECK(picture.channels[0].values[pixel] == (inside ? value + 0.375f : 0));
        }
      CHECK(notes_of(image) ==
            (data.min.x == 100 ? "its data window lies outside of its display window: it is black\n" : ""));
    }
  }
}

TEST_CASE("EXR: one channel is grey, whatever its name, and layers are found") {
  const TemporaryFolder folder;
  struct Case {
    std::vector<std::string> channels;
    std::vector<float> texel;  // of (0, 0): the number of each channel over 8
    std::string notes;
  };
  const float no = 0;
  for (const auto& [channels, texel, notes] : std::vector<Case>{
           {{"R"}, {0, 0, 0, 1}, ""},
           {{"x", "G"}, {0.125f, 0.125f, 0.125f, 1}, ""},
           {{"x", "y", "B", "A"}, {0.25f, 0.25f, 0.25f, 0.375f}, ""},
           {{"x", "Y"}, {0.125f, 0.125f, 0.125f, 1}, ""},
           {{"A", "Z"}, {0.125f, 0.125f, 0.125f, 0}, ""},
           {{"A", "height"}, {0.125f, 0.125f, 0.125f, 0}, ""},
           {{"G", "R"}, {0.125f, 0, no, 1}, ""},
           {{"r", "g", "b", "a"}, {0, 0.125f, 0.25f, 0.375f}, ""},
           {{"red", "green", "blue"}, {0, 0.125f, 0.25f, 1}, ""},
           {{"R", "G", "B", "diffuse.R", "diffuse.G", "diffuse.B"}, {0, 0.125f, 0.25f, 1}, ""},
           {{"Z", "diffuse.R", "diffuse.G", "diffuse.B", "diffuse.A"},
            {0.125f, 0.25f, 0.375f, 0.5f},
            "its layer 'diffuse' is read\n"},
           {{"View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Glossy.R", "View.Glossy.G"},
            {0, 0.125f, 0.25f, 1},
            "its layer 'View.Combined' is read\n"},
           {{"depth.V"}, {0, 0, 0, 1}, "its layer 'depth' is read\n"},
           {{"mask.R"}, {0, 0, 0, 1}, "its layer 'mask' is read\n"},
       }) {
    CAPTURE(channels);
    const Image image = read_image(write_exr(folder, small, small, channels), true);
    CHECK(first_texel(image) == texel);
    CHECK(notes_of(image) == notes);
  }
  const auto fault = [&](const std::vector<std::string>& channels) {
    const std::string file = write_exr(folder, small, small, channels);
    return user_error_of([&] { read_image(file, true); }, file);
  };
  const std::string beginning =
      "a.exr: cannot be decoded: it has no channels R, G, B or Y, nor one layer of them, but:";
  CHECK(fault({"u", "v"}) == beginning + " 'u' 'v'");
  CHECK(fault({"A"}) == beginning + " 'A'");
  CHECK(fault({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B", "b.\x1b[31m", "c.x", "c.y", "c.z"}) ==
        beginning + " 'a.B' 'a.G' 'a.R' 'b.?[31m' 'b.B' 'b.G' 'b.R' 'c.x' and 2 more");
}

TEST_CASE("EXR: primaries other than sRGB's, and cube maps, have a note") {
  const TemporaryFolder folder;
  Imf::Header header;
  Imf::addChromaticities(header, Imf::Chromaticities());
  CHECK(notes_of(read_image(write_exr(folder, small, small, {"R", "G", "B"}, header), true)) == "");
  Imf::addChromaticities(
      header, Imf::Chromaticities({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}));
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  CHECK(notes_of(read_image(write_exr(folder, small, small, {"R", "G", "B"}, header), true)) ==
        "its primaries (chromaticities) are not those of sRGB: its colours are taken as if they were\n"
        "it is a cube map, which is not supported: its pixels are taken as they lie in the file\n");
}

}  // namespace causticl
