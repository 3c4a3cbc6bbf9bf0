// What PNG, JPEG, TGA and PFM files say beside their pixels.
#include <cmath>
#include <cstring>

#include "catch2.hpp"
#include "image/image_metadata.hpp"
#include "image_files.hpp"
#include "scene_folder.hpp"

namespace causticl {
namespace {

std::string gama(std::uint32_t value) { return png_chunk("gAMA", big_endian_bytes(value)); }

std::string chrm(const std::vector<std::uint32_t>& values) {
  std::string data;
  for (const std::uint32_t value : values) data += big_endian_bytes(value);
  return png_chunk("cHRM", data);
}

std::string cicp(char primaries, char transfer) {
  return png_chunk("cICP", std::string{primaries, transfer, '\0', '\1'});
}

std::string iccp(const std::string& name, const std::string& profile) {
  return png_chunk("iCCP", name + std::string(2, '\0') + zlib_stored(profile));
}

const std::string rec2020 = chrm({31270, 32900, 70800, 29200, 17000, 79700, 13100, 4600});
const std::string rec709 = chrm({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000});
const std::string srgb = png_chunk("sRGB", std::string(1, '\0'));
const std::string by_curve = ", not by the sRGB curve\n";
const std::string other_primaries = ") are not those of sRGB: its colours are taken as if they were\n";

}  // namespace

TEST_CASE("PNG: the colours are decoded as the file says, where they are colours") {
  const TemporaryFolder folder;
  const double half = 0.21404114, bt709 = 0.25959;  // of 0.5 by sRGB, by Rec. 709
  struct Case {
    std::string chunks;
    double value;
    std::string notes;
  };
  for (const auto& [chunks, value, notes] : std::vector<Case>{
           {"", half, ""},
           {srgb, half, ""},
           {gama(100000), 0.5, "its colours are decoded by its gAMA 1" + by_curve},
           {gama(45455), std::pow(0.5, 2.2), "its colours are decoded by its gAMA 0.4546" + by_curve},
           {gama(55556), std::pow(0.5, 1.8), "its colours are decoded by its gAMA 0.5556" + by_curve},
           {gama(0), half, "its gAMA 0 is no gamma: its colours are decoded by the sRGB curve\n"},
           {srgb + gama(100000), half, ""},
           {gama(100000) + srgb + rec2020, half, ""},
           {rec709, half, ""},
           {rec2020, half, "its primaries (cHRM" + other_primaries},
           {gama(100000) + rec2020, 0.5,
            "its colours are decoded by its gAMA 1" + by_curve + "its primaries (cHRM" + other_primaries},
           {cicp(1, 13) + gama(100000), half, ""},
           {cicp(1, 8), 0.5, "its colours are decoded as its chunk cICP says" + by_curve},
           {cicp(1, 1), bt709, "its colours are decoded as its chunk cICP says" + by_curve},
           {cicp(9, 16), half,
            "its transfer function (cICP 16) is not supported: its colours are decoded by the sRGB curve\n"
            "its primaries (cICP" +
                other_primaries},
           {iccp("Adobe RGB", "desc Adobe RGB (1998)") + gama(100000), half,
            "its colour profile (iCCP) is not applied: its colours are taken as sRGB\n"},
           {iccp("ICC profile", "desc sRGB IEC61966-2.1"), half, ""},
           {iccp("ICC", std::string("m\0l\0u\0c\0s\0R\0G\0B\0", 16)), half, ""},
           {iccp("sRGB", "damaged"), half, ""},
       }) {
    for (const int bits : {8, 16}) {
      CAPTURE(chunks, bits);
      const unsigned most = bits == 8 ? 255 : 65535;
      const std::string file = folder.write("a.png", grey_png(2, 1, {most / 2, most}, bits, chunks));
      const Image image = read_image(file, true), raw = read_image(file, false);
      CHECK(image.rgba[1] == Approx(value).epsilon(bits == 8 ? 0.01 : 1e-4));
      CHECK(image.rgba[4] == 1);
      CHECK(notes_of(image) == notes);
      CHECK(raw.rgba[1] == Approx(0.5).epsilon(0.01));  // no colours: their own business
      CHECK(notes_of(raw) == "");
    }
  }
}

TEST_CASE("a scene tells what its images say, once a file") {
  const SceneFolder folder;
  folder.folder.write("a.png", grey_png(2, 1, {127, 255}, 8, gama(100000)));
  const std::string object =
      R"({"type": "rectangle", "material": {"type": "diffuse", "color": {"type": "image", "path": "a.png"}}})";
  const Scene scene = folder.objects(object + ", " + object + ", " + lamp);
  REQUIRE(scene.notices.size() == 1);
  CHECK(scene.notices[0].ends_with("a.png: its colours are decoded by its gAMA 1, not by the sRGB curve"));
  CHECK(scene.images[0].rgba[0] == Approx(127 / 255.0));
}

TEST_CASE("the orientation of Exif is applied, all eight, in JPEG and PNG") {
  const TemporaryFolder folder;
  // 3 x 2 values as they should be seen, and as they are stored for each orientation.
  const std::vector<float> seen{10, 60, 110, 160, 210, 250};
  const std::vector<std::vector<unsigned>> stored{{10, 60, 110, 160, 210, 250}, {110, 60, 10, 250, 210, 160},
                                                  {250, 210, 160, 110, 60, 10}, {160, 210, 250, 10, 60, 110},
                                                  {10, 160, 60, 210, 110, 250}, {110, 250, 60, 210, 10, 160},
                                                  {250, 110, 210, 60, 160, 10}, {160, 10, 210, 60, 250, 110}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const int width = orientation >= 5 ? 2 : 3, height = 5 - width;
    const auto& values = stored[static_cast<std::size_t>(orientation) - 1];
    for (const bool big : {false, true}) {
      CAPTURE(orientation, big);
      const std::string exif = exif_block(orientation, big, big ? 3 : orientation % 2 == 0 ? 3 : 4);
      const std::string chunk = png_chunk("eXIf", exif);
      const std::string png = grey_png(width, height, values, 8, "");
      const std::string end = png_chunk("IEND", "");
      for (const std::string& bytes : {grey_png(width, height, values, 8, chunk),
                                       png.substr(0, png.size() - end.size()) + chunk + end}) {
        const Image image = read_image(folder.write("a.png", bytes), false);
        REQUIRE(image.width == 3);
        REQUIRE(image.height == 2);
        for (std::size_t i = 0; i < 6; ++i) CHECK(red_rows(image)[i] * 255 == Approx(seen[i]));
      }
      // Blocks of 16 texels a value, which JPEG keeps.
      std::vector<unsigned char> pixels;
      for (int y = 0; y < 16 * height; ++y)
        for (int x = 0; x < 16 * width; ++x)
          pixels.push_back(
              static_cast<unsigned char>(values[static_cast<std::size_t>(y / 16 * width + x / 16)]));
      std::string jpeg;
      stbi_write_jpg_to_func(append_to_string, &jpeg, 16 * width, 16 * height, 1, pixels.data(), 95);
      const std::string data = std::string("Exif\0\0", 6) + exif;
      jpeg.insert(2,
                  "\xff\xff\xe1" + big_endian_bytes(static_cast<std::uint32_t>(data.size() + 2), 2) + data);
      const Image image = read_image(folder.write("a.jpg", jpeg), true);
      REQUIRE(image.width == 48);
      REQUIRE(image.height == 32);
      CHECK(notes_of(image) == "");
      const Transfer curve{Transfer::Curve::srgb};
      for (std::size_t i = 0; i < 6; ++i)
        CHECK(red_rows(image)[(i / 3 * 16 + 8) * 48 + i % 3 * 16 + 8] ==
              Approx(curve.to_linear(seen[i] / 255)).margin(0.03));
    }
  }
}

TEST_CASE("damaged metadata are as none") {
  CHECK(exif_orientation("") == 1);
  const std::string whole = exif_block(6, true);
  CHECK(exif_orientation(whole) == 6);
  for (std::size_t size = 0; size < whole.size(); ++size)
    CHECK((exif_orientation(whole.substr(0, size)) == 1 || size + 8 > whole.size()));
  CHECK(exif_orientation(exif_block(0, false)) == 1);
  CHECK(exif_orientation(exif_block(9, false)) == 1);
  CHECK(exif_orientation(exif_block(6, false, 2)) == 1);
  std::string far_away = whole;
  far_away.replace(4, 4, "\xff\xff\xff\xff");
  CHECK(exif_orientation(far_away) == 1);
  const std::string png = grey_png(1, 1, {7}, 8, gama(100000) + iccp("x", "y"));
  const std::string jpeg = std::string(
                               "\xff\xd8\xff\xe1\0\x40"
                               "Exif\0\0",
                               12) +
                           whole;
  for (std::size_t size = 0; size < png.size(); ++size) png_metadata(png.substr(0, size));
  for (std::size_t size = 0; size < jpeg.size(); ++size) jpeg_metadata(jpeg.substr(0, size));
  CHECK(jpeg_metadata(jpeg).orientation == 6);
}

TEST_CASE("JPEG: a colour profile other than sRGB's has a note") {
  const TemporaryFolder folder;
  std::string jpeg;
  const unsigned char pixel[3] = {9, 9, 9};
  stbi_write_jpg_to_func(append_to_string, &jpeg, 1, 1, 3, pixel, 95);
  for (const std::string name : {"sRGB IEC61966-2.1", "Display P3"}) {
    const std::string data = std::string("ICC_PROFILE\0\1\1", 14) + "desc " + name;
    std::string bytes = jpeg;
    bytes.insert(2, "\xff\xe2" + big_endian_bytes(static_cast<std::uint32_t>(data.size() + 2), 2) + data);
    const Image image = read_image(folder.write("a.jpg", bytes), true);
    CHECK(notes_of(image) ==
          (name[0] == 's' ? "" : "its colour profile (ICC) is not applied: its colours are taken as sRGB\n"));
  }
}

TEST_CASE("TGA: rows may run from right to left") {
  const TemporaryFolder folder;
  for (const char descriptor : {'\x00', '\x10', '\x20', '\x30'}) {
    CAPTURE(int(descriptor));
    std::string bytes("\0\0\3\0\0\0\0\0\0\0\0\0\2\0\2\0\x08", 17);
    bytes += descriptor;
    const bool top = descriptor & 0x20, right = descriptor & 0x10;
    std::vector<int> rows = top ? std::vector<int>{1, 2, 3, 4} : std::vector<int>{3, 4, 1, 2};
    if (right) rows = {rows[1], rows[0], rows[3], rows[2]};
    for (const int value : rows) bytes += static_cast<char>(value);
    const Image image = read_image(folder.write("a.tga", bytes), false);
    for (std::size_t i = 0; i < 4; ++i) CHECK(red_rows(image)[i] * 255 == Approx(i + 1));
  }
}

TEST_CASE("PFM: line ends of Windows, and scale factors") {
  const TemporaryFolder folder;
  const auto floats = [](std::initializer_list<float> values, bool big) {
    std::string bytes;
    for (const float value : values) {
      std::string one(4, '\0');
      std::memcpy(one.data(), &value, 4);
      bytes += big ? std::string(one.rbegin(), one.rend()) : one;
    }
    return bytes;
  };
  float line_feed;  // its first byte, of little-endian ones, is a line feed
  std::memcpy(&line_feed, "\n\0\0\x3f", 4);
  for (const std::string end : {"\n", "\r\n", "\r", " "}) {
    for (const bool big : {false, true})
      for (const std::string factor : {"1.0", "2.5"}) {
        CAPTURE(end, big, factor);
        const std::string header = "Pf" + end + "2 1" + end + (big ? "" : "-") + factor + end;
        const Image image = read_image(folder.write("a.pfm", header + floats({line_feed, 3}, big)), true);
        const double scale = factor == "1.0" ? 1 : 2.5;
        CHECK(image.rgba[0] == Approx(scale * line_feed));
        CHECK(image.rgba[5] == Approx(3 * scale));
        CHECK(notes_of(image) ==
              (scale == 1 ? "" : "its values are multiplied by the scale factor in its header\n"));
      }
  }
}

}  // namespace causticl
