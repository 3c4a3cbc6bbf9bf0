#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "catch2.hpp"
#include "image/image.hpp"
#include "image/image_formats.hpp"
#include "image_files.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {

// 2x2 texels, top row first: red, green / blue, grey with alpha 128.
const std::vector<unsigned char> four_texels{255, 0, 0,   255, 0,   255, 0,   255,
                                             0,   0, 255, 255, 188, 188, 188, 128};

std::string png_bytes() {
  std::string bytes;
  stbi_write_png_to_func(append_to_string, &bytes, 2, 2, 4, four_texels.data(), 0);
  return bytes;
}

std::vector<float> texel(const Image& image, int x, int y) {
  const auto begin = image.rgba.begin() + 4 * (y * image.width + x);
  return {begin, begin + 4};
}

/// 3x2 pixels of values that 32-bit floats hold and halves do not.
Picture small_picture() {
  Picture picture{3, 2, {}};
  for (int i = 0; i < 18; ++i) picture.rgb.push_back(1e-4f + 1000.001f * float(i));
  return picture;
}

std::string big_endian(float value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  if (std::endian::native == std::endian::little) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace

TEST_CASE("A PNG is read bottom row first, linear or by the sRGB curve") {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.png", png_bytes());
  const Image linear = read_image(file, false), srgb = read_image(file, true);
  CHECK(linear.file == file);
  REQUIRE(linear.width == 2);
  REQUIRE(linear.height == 2);
  REQUIRE(linear.rgba.size() == 16);
  CHECK(texel(linear, 0, 1) == std::vector<float>{1, 0, 0, 1});
  CHECK(texel(linear, 1, 1) == std::vector<float>{0, 1, 0, 1});
  CHECK(texel(linear, 0, 0) == std::vector<float>{0, 0, 1, 1});
  CHECK(texel(linear, 1, 0) == std::vector<float>{188 / 255.f, 188 / 255.f, 188 / 255.f, 128 / 255.f});
  CHECK(texel(srgb, 0, 1) == std::vector<float>{1, 0, 0, 1});
  CHECK(texel(srgb, 1, 0)[0] == Approx(0.502886).epsilon(1e-5));  // ((188/255 + 0.055) / 1.055)^2.4
  CHECK(texel(srgb, 1, 0)[3] == 128 / 255.f);                     // alpha is never on the curve
}

TEST_CASE("JPEG, BMP, TGA and HDR are read, and refused where they end early") {
  const TemporaryFolder folder;
  const int width = 40, height = 30;
  std::vector<unsigned char> pixels;
  std::vector<float> floats;
  for (int i = 0; i < 3 * width * height; ++i) {
    const int y = i / 3 / width;
    pixels.push_back(static_cast<unsigned char>(y * 8));
    floats.push_back(float(y) * 8);
  }
  std::string jpg, bmp, tga, hdr, png;
  stbi_write_jpg_to_func(append_to_string, &jpg, width, height, 3, pixels.data(), 95);
  stbi_write_bmp_to_func(append_to_string, &bmp, width, height, 3, pixels.data());
  stbi_write_tga_to_func(append_to_string, &tga, width, height, 3, pixels.data());
  stbi_write_hdr_to_func(append_to_string, &hdr, width, height, 3, floats.data());
  stbi_write_png_to_func(append_to_string, &png, width, height, 3, pixels.data(), 0);
  for (const auto& [name, bytes] : std::map<std::string, std::string>{
           {"a.jpg", jpg}, {"a.bmp", bmp}, {"a.tga", tga}, {"a.hdr", hdr}, {"a.png", png}}) {
    CAPTURE(name);
    const Image image = read_image(folder.write(name, bytes), false);
    REQUIRE(image.width == width);
    REQUIRE(image.height == height);
    const float top = name == "a.hdr" ? 8 : 8 / 255.f;  // the second row from above, and the last
    CHECK(texel(image, 7, height - 2)[1] == Approx(top).margin(0.02));
    CHECK(texel(image, 7, 0)[2] == Approx(29 * top).margin(0.02));
    CHECK(texel(image, 7, 0)[3] == 1);
    // PNG and JPEG may lack some bytes of checksums and padding, as decoders go.
    for (std::size_t size = 1; size + 20 < bytes.size(); size += 1 + bytes.size() / 150) {
      CAPTURE(size);
      const std::string cut = folder.write(name, bytes.substr(0, size));
      const std::string message = user_error_of([&] { read_image(cut, false); }, cut);
      CHECK(message.find(name + ": cannot be decoded: ") == 0);
      CHECK(message.find('\n') == message.npos);
    }
  }
}

TEST_CASE("Damaged and foreign images have one clear line each") {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& name, const std::string& bytes) {
    const std::string file = folder.write(name, bytes);
    return user_error_of([&] { read_image(file, false); }, file);
  };
  CHECK(fault("a.png", "") == "a.png: is empty; expected an image");
  CHECK(fault("a.png", "no image at all, only some text that is longer than a header") ==
        "a.png: cannot be decoded: expected PNG, JPEG, BMP, TGA, HDR, PFM or EXR");
  CHECK(user_error_of([&] { read_image(folder.path("none.png"), false); }, folder.path("none.png")) ==
        "none.png: no such file");
  std::filesystem::create_directory(folder.path("folder.png"));
  CHECK(user_error_of([&] { read_image(folder.path("folder.png"), false); }, folder.path("folder.png")) ==
        "folder.png: is a folder; expected an image");
  CHECK(user_error_of([] { read_image("/dev/zero", false); }) ==
        "/dev/zero: is not a regular file; expected an image");

  // The width and height of a PNG are the bytes 16 to 23.
  std::string zero = png_bytes(), huge = png_bytes();
  zero.replace(16, 8, std::string(8, '\0'));
  huge.replace(16, 8, std::string("\0\0\xff\xff\0\0\xff\xff", 8));
  CHECK(fault("a.png", zero) == "a.png: cannot be decoded: 0-pixel image");
  CHECK(fault("a.png", huge) ==
        "a.png: cannot be decoded: 65535x65535 pixels are too many; at most 2^28 are read");
  // A TGA without pixels.
  CHECK(fault("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\0\0\0\0\x18\0", 18)).find("a.tga: cannot be") ==
        0);

  // A Huffman table (marker FF C4, length, class, 16 counts) of too many codes overruns the decoder's own.
  std::string jpg;
  stbi_write_jpg_to_func(append_to_string, &jpg, 2, 2, 4, four_texels.data(), 90);
  const auto table = jpg.find("\xff\xc4");
  REQUIRE(table != jpg.npos);
  CHECK(fault("a.jpg", jpg) == "");
  jpg.replace(table + 5, 2, "\xff\xff");
  CHECK(fault("a.jpg", jpg) == "a.jpg: cannot be decoded: a Huffman table has more than 256 codes");

  // Every single damaged byte of a small image is refused or decoded, but never a crash.
  const std::string exr = encode_exr(small_picture(), {});
  for (const auto& [name, bytes] :
       std::map<std::string, std::string>{{"b.png", png_bytes()}, {"b.exr", exr}}) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ 0x81);
      const std::string message = fault(name, damaged);
      CHECK(message.find('\n') == message.npos);
      if (i % 7 == 0) CHECK(fault(name, bytes.substr(0, i)) != "");
    }
  }
}

TEST_CASE("EXR keeps every bit and carries its metadata") {
  const TemporaryFolder folder;
  const std::string file = folder.path("a.exr");
  Picture picture = small_picture();
  picture.rgb[4] = std::numeric_limits<float>::infinity();
  picture.channels = {{"error.noise", {1, 2, 3, 4, 5, 6}}, {"sppm.N", {7, 8, 9, 10, 11, 12}}};
  const Metadata metadata{{"scene", "a b.json"}, {"seed", "7"}, {"version", "0.1"}, {"device", "x"}};
  write_picture(file, picture, metadata);
  const Picture back = read_picture(file);
  CHECK(back.width == 3);
  CHECK(back.height == 2);
  CHECK(back.rgb == picture.rgb);
  const std::string bytes = bytes_of(file);
  for (const auto& [name, text] : metadata) {
    CAPTURE(name);
    const std::string size{static_cast<char>(text.size()), '\0', '\0', '\0'};
    CHECK(bytes.find(name + '\0' + "string" + '\0' + size + text) != bytes.npos);
  }
  Imf::InputFile exr(file.c_str());
  for (const auto& [name, values] : picture.channels) {
    std::vector<float> read(6);
    Imf::FrameBuffer frame;
    frame.insert(
        name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.data()), sizeof(float), 3 * sizeof(float)));
    exr.setFrameBuffer(frame);
    exr.readPixels(0, 1);
    CHECK(read == values);
  }
  // As a texture the same file has its bottom row first, and its values are not touched by the sRGB curve.
  const Image image = read_image(file, true);
  CHECK(texel(image, 0, 0) == std::vector<float>{picture.rgb[9], picture.rgb[10], picture.rgb[11], 1});
  CHECK(has_no_temporary(folder));
}

TEST_CASE("EXR of luminance and chroma, and of luminance alone") {
  const TemporaryFolder folder;
  const std::vector<Imf::Rgba> pixels(8 * 4, Imf::Rgba(0.5f, 0.25f, 0.125f, 1.0f));
  for (const auto channels : {Imf::WRITE_YC, Imf::WRITE_Y}) {
    const std::string file = folder.path("a.exr");
    {
      // The window lies off the origin.
      const Imath::Box2i window({-2, 6}, {5, 9});
      Imf::RgbaOutputFile out(file.c_str(), Imf::Header(window, window), channels);
      out.setFrameBuffer(pixels.data() + 2 - 8 * 6, 1, 8);
      out.writePixels(4);
    }
    const Image image = read_image(file, false);
    REQUIRE(image.width == 8);
    REQUIRE(image.height == 4);
    const auto color = texel(image, 7, 3);
    if (channels == Imf::WRITE_YC) {
      CHECK(color[0] == Approx(0.5).epsilon(0.01));
      CHECK(color[2] == Approx(0.125).epsilon(0.01));
    } else {
      CHECK(color[0] == Approx(0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 0.125).epsilon(0.01));
      CHECK(color[2] == color[0]);
    }
    CHECK(color[3] == 1);
  }
}

TEST_CASE("PFM keeps every bit; both byte orders and grey are read") {
  const TemporaryFolder folder;
  const Picture picture = small_picture();
  write_picture(folder.path("a.PFM"), picture, {});
  CHECK(read_picture(folder.path("a.PFM")).rgb == picture.rgb);
  const std::string bytes = bytes_of(folder.path("a.PFM"));
  CHECK(bytes.substr(0, 12) == "PF\n3 2\n-1.0\n");
  CHECK(bytes.size() == 12 + 18 * 4);
  if (std::endian::native == std::endian::little)
    CHECK(std::memcmp(bytes.data() + 12, picture.rgb.data() + 9, 36) == 0);  // the bottom row comes first

  const std::string grey = "Pf\n1 2\n1.0\n" + big_endian(2.5f) + big_endian(-7);
  CHECK(read_picture(folder.write("b.pfm", grey)).rgb == std::vector<float>{-7, -7, -7, 2.5f, 2.5f, 2.5f});

  const auto fault = [&](const std::string& text) {
    const std::string file = folder.write("c.pfm", text);
    return user_error_of([&] { read_picture(file); }, file);
  };
  CHECK(fault("") == "c.pfm: is empty; expected an image");
  CHECK(fault("P6\n1 1\n255\n") ==
        "c.pfm: cannot be decoded: expected PF or Pf at its beginning; is it a PFM file?");
  CHECK(fault("PF\n1 x\n") ==
        "c.pfm: cannot be decoded: its header is damaged; expected width, height and scale");
  CHECK(fault("PF\n1 1\n0\n1234") ==
        "c.pfm: cannot be decoded: its header is damaged; expected width, height and scale");
  CHECK(fault("PF\n0 1\n-1\n") == "c.pfm: cannot be decoded: it has no pixels");
  CHECK(fault("PF\n-4 1\n-1\n") == "c.pfm: cannot be decoded: it has no pixels");
  CHECK(fault("PF\n1000000 1000000\n-1\n") ==
        "c.pfm: cannot be decoded: 1000000x1000000 pixels are too many; at most 2^28 are read");
  CHECK(fault("PF\n1 1\n-1") ==
        "c.pfm: cannot be decoded: its pixels end early; expected 12 bytes of them; is it truncated?");
  CHECK(fault("PF\n1 1\n-1.0\n12345678901") ==
        "c.pfm: cannot be decoded: its pixels end early; expected 12 bytes of them; is it truncated?");
}

TEST_CASE("Real images: the assets folder") {
  const std::filesystem::path folder = std::filesystem::path(CAUSTICL_SOURCE_DIR) / "../shared/assets";
  for (const std::string name : {"studio.exr", "sunset.exr"}) {
    if (!std::filesystem::exists(folder / name)) {
      WARN("skipped: there is no " << (folder / name).lexically_normal().string());
      continue;
    }
    const Image image = read_image((folder / name).string(), false);
    CHECK(image.width == 512);
    CHECK(image.height == 256);
    CHECK(std::all_of(image.rgba.begin(), image.rgba.end(), [](float c) { return std::isfinite(c); }));
    const Picture picture = read_picture((folder / name).string());
    CHECK(picture.rgb[0] == texel(image, 0, 255)[0]);
    CHECK(picture.rgb.back() == texel(image, 511, 0)[2]);
  }
}

}  // namespace causticl
