// Images that cost far more than their size are refused by their headers, before memory is asked for.
#include <stb/stb_image_write.h>

#include <chrono>

#include "catch2.hpp"
#include "hostile_images.hpp"
#include "image/image.hpp"
#include "image/jpeg_markers.hpp"
#include "temporary_folder.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

/// What reading it as a texture complains of.
std::string fault(const std::string& name, const std::string& bytes, const ImageLimits& limits = {}) {
  const TemporaryFolder folder;
  const std::string file = folder.write(name, bytes);
  const std::string message = user_error_of([&] { read_image(file, false, limits); }, file);
  if (!message.empty()) CHECK_THAT(message, Catch::StartsWith(name + ": "));
  CHECK(message.find('\n') == message.npos);
  return message;
}

std::string small_jpeg() {
  std::string bytes;
  const std::vector<unsigned char> pixels(16 * 16 * 3, 200);
  stbi_write_jpg_to_func(
      [](void* target, void* data, int size) {
        static_cast<std::string*>(target)->append(static_cast<const char*>(data),
                                                  static_cast<std::size_t>(size));
      },
      &bytes, 16, 16, 3, pixels.data(), 90);
  return bytes;
}

/// A table segment of more codes than a decoder has room for.
std::string overfull_table() {
  return jpeg_segment(0xc4, std::string(7, '\0') + std::string(3, '\xff') + std::string(7 + 765, '\0'));
}

constexpr const char* too_dense = "are more than 128 a byte";
constexpr const char* too_large = "left for images; --max-image-memory";

}  // namespace

TEST_CASE("large pictures of small files are refused by their headers") {
  CHECK_THAT(fault("a.png", png_of_zeros(16384, 16384, 1, 0, 1000)), Contains(too_dense));
  CHECK_THAT(fault("a.png", png_of_zeros(16384, 16384, 16, 6, 1000)), Contains(too_dense));
  CHECK_THAT(fault("a.jpg", jpeg_without_data(16384, 16384, 1, false)), Contains(too_dense));
  CHECK_THAT(fault("a.jpg", jpeg_without_data(16384, 16384, 9, true)),
             Contains(too_dense) || Contains("too many of so many pixels in so small a file"));
  CHECK_THAT(fault("a.exr", exr_header(exr_window((1u << 28) - 1, 0), exr_window((1u << 28) - 1, 0))),
             Contains(too_dense));
  CHECK_THAT(fault("a.exr", exr_header(exr_window(3, 3), exr_window(16383, 16382))), Contains(too_dense));
  CHECK_THAT(
      fault("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n" + std::string(99, '\0')),
      Contains(too_dense));
  CHECK_THAT(fault("a.bmp", "BM" + std::string(8, '\0') + little_endian(54) + little_endian(40) +
                                little_endian(16000) + little_endian(16000) + std::string("\1\0\x18\0", 4) +
                                std::string(99, '\0')),
             Contains(too_dense));
  CHECK_THAT(
      fault("a.tga", std::string("\0\0\x0a\0\0\0\0\0\0\0\0\0\0\x40\0\x40\x18\0", 18) + std::string(99, 'a')),
      Contains(too_dense));
  CHECK_THAT(fault("a.exr", exr_header(exr_window(0xfffffff0u, 9), exr_window(9, 9))), Contains("no pixels"));
  CHECK_THAT(fault("a.exr", exr_header(exr_window(0x7ffffff0u, 0x7ffffff0u), exr_window(9, 9))),
             Contains("ends early"));
}

TEST_CASE("a picture within all limits is read, be it ever so even") {
  CHECK(fault("a.png", png_of_zeros(256, 200, 8, 2, 200 * (256 * 3 + 1))).empty());
  // A user who gives a limit is believed.
  const std::string low_discrepancy = png_of_zeros(8192, 1028, 1, 0, 1028 * 1025);
  REQUIRE(low_discrepancy.size() < 65000);
  CHECK_THAT(fault("a.png", low_discrepancy), Contains(too_dense));
  CHECK(fault("a.png", low_discrepancy, {std::uint64_t{1} << 30, true}).empty());
}

TEST_CASE("all images together have a limit") {
  const std::string bytes = png_of_zeros(256, 200, 8, 2, 200 * (256 * 3 + 1));
  const std::uint64_t pixels = 256 * 200, enough = bytes.size() + pixels * (4 + 16);
  CHECK(fault("a.png", bytes, {enough, false}).empty());
  CHECK_THAT(fault("a.png", bytes, {enough - 1, false}), Contains(too_large));
  const ImageLimits two{enough + pixels * 16, false};
  CHECK(fault("a.png", bytes, two.after(pixels)).empty());
  CHECK_THAT(fault("a.png", bytes, two.after(pixels + 1)), Contains(too_large));
  CHECK(two.after(UINT64_MAX / 16).memory == 0);
  CHECK_THAT(fault("a.png", bytes, {100, false}), Contains("expected an image of at most 100 bytes"));
}

TEST_CASE("what a file holds beyond its header is not unpacked") {
  // 16 MiB of zeros in a picture of one pixel.
  const auto start = std::chrono::steady_clock::now();
  CHECK_THAT(fault("a.png", png_of_zeros(1, 1, 8, 0, 16u << 20)), Contains("asks for more memory"));
  CHECK(fault("a.png", png_of_zeros(20, 20, 8, 0, 20 * 21 + 100)).empty());  // a little more is harmless
  // An attribute of an EXR, and a table of tiles, that the file cannot hold.
  std::string text =
      exr_header(exr_window(7, 7), exr_window(7, 7), exr_attribute("comments", "string", "abcd"));
  const auto length = text.find("abcd") - 4;
  text.replace(length, 4, little_endian(0x7ffffff0));
  CHECK_THAT(fault("a.exr", text), Contains("ends early"));
  text.replace(length, 4, little_endian(0x80000000));
  CHECK_THAT(fault("a.exr", text), Contains("negative size"));
  const auto tiles = [](std::uint32_t width, std::uint32_t height) {
    return exr_attribute("tiles", "tiledesc", little_endian(width) + little_endian(height) + '\0');
  };
  CHECK_THAT(fault("a.exr", exr_header(exr_window(2047, 2047), exr_window(2047, 2047), tiles(1, 1))),
             Contains("ends early"));
  CHECK_THAT(fault("a.exr", exr_header(exr_window(7, 7), exr_window(7, 7), tiles(65536, 65536))),
             Contains("tiles of 65536x65536"));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
}

TEST_CASE("a JPEG of more scans than any encoder makes is refused") {
  CHECK(fault("a.jpg", jpeg_without_data(16, 16, 64, true)).empty());
  CHECK_THAT(fault("a.jpg", jpeg_without_data(16, 16, 65, true)), Contains("more than 64 scans"));
  CHECK_THAT(fault("a.jpg", jpeg_without_data(2000, 2000, 4000, true)), Contains("more than 64 scans"));
  CHECK(check_jpeg(jpeg_without_data(2896, 2896, 32, true)) == 3u * 2896u * 2896u);
  CHECK_THAT(fault("a.jpg", jpeg_without_data(2896, 2896, 33, true)), Contains("33 scans or more, too many"));
  // Not where the file is large.
  CHECK_NOTHROW(check_jpeg(jpeg_without_data(2896, 2896, 33, true) + std::string(10000, '\0')));
}

TEST_CASE("an overfull Huffman table is found wherever the decoder would read it") {
  const std::string good = small_jpeg(), bad = overfull_table(), fill(3, '\xff'), many(1000, '\xff');
  REQUIRE(fault("a.jpg", good).empty());
  const std::size_t scan = good.find("\xff\xda"), tables = good.find("\xff\xc4");
  REQUIRE(scan != good.npos);
  REQUIRE(tables < scan);
  const auto with = [&](std::size_t at, const std::string& more) {
    std::string bytes = good;
    return bytes.insert(at, more);
  };
  constexpr const char* message = "a.jpg: cannot be decoded: a Huffman table has more than 256 codes";
  for (const std::string& before : {std::string(), fill, many}) {
    CAPTURE(before.size());
    CHECK(fault("a.jpg", with(2, before + bad)) == message);
    CHECK(fault("a.jpg", with(tables, before + bad)) == message);
    CHECK(fault("a.jpg", with(scan, before + bad)) == message);
    CHECK(fault("a.jpg", with(good.size() - 2, before + bad)) == message);  // after the scan's data
    CHECK(fault("a.jpg", before + "\xff\xd8" + bad) == message);
    CHECK(fault("a.jpg", with(2, "padding" + before + bad)) == message);
    // Fill bytes alone are as good as none, but for such as stb itself does not read.
    CHECK(fault("a.jpg", with(tables, before)).empty());
    CHECK(fault("a.jpg", with(good.size() - 2, before)).empty());
  }
  // Within a comment it is no table.
  CHECK(fault("a.jpg", with(2, jpeg_segment(0xfe, bad))).empty());
  // The second table of a segment, and the first of a second segment.
  CHECK(fault("a.jpg", with(2, jpeg_segment(0xc4, jpeg_table(0).substr(4) + bad.substr(4)))) == message);
  CHECK(fault("a.jpg", with(2, jpeg_table(0) + bad)) == message);
}

TEST_CASE("a failure without a reason of its own does not repeat another's") {
  std::string bytes = small_jpeg();
  CHECK_THAT(fault("b.png", "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", std::string(13, '\0'))),
             Contains("cannot be"));
  // A scan of a component that the frame does not name: stb gives no reason.
  bytes[bytes.find("\xff\xda") + 5] = 77;
  CHECK(fault("a.jpg", bytes) == "a.jpg: cannot be decoded: it is damaged");
}
