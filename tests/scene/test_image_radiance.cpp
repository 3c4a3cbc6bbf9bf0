// Radiance pictures (.hdr).
#include "catch2.hpp"

#include "image_files.hpp"

namespace causticl {
namespace {

/// A pixel of the grey value n / 128, 128 <= n < 256.
std::string pixel(int n) {
  const char mantissa = static_cast<char>(n);
  return {mantissa, mantissa, mantissa, '\x81'};
}

std::string header(const std::string& lines, const std::string& size) {
  return "#?RADIANCE\n# made by a test\n" + lines + "\n" + size + "\n";
}

const std::string rgbe = "FORMAT=32-bit_rle_rgbe\n";

std::vector<float> read_red(const TemporaryFolder& folder, const std::string& bytes) {
  std::vector<float> values = red_rows(read_image(folder.write("a.hdr", bytes), true));
  for (float& value : values) value *= 128;
  return values;
}

}  // namespace

TEST_CASE("HDR: values are divided by all EXPOSURE and COLORCORR lines") {
  const TemporaryFolder folder;
  const std::string data = pixel(128) + pixel(192);
  const auto texel = [&](const std::string& lines) {
    const Image image = read_image(folder.write("a.hdr", header(lines, "-Y 1 +X 2") + data), true);
    CHECK(notes_of(image) == "");
    return std::vector<double>{image.rgba[4], image.rgba[5], image.rgba[6], image.rgba[7]};
  };
  using Texel = std::vector<double>;
  CHECK(texel(rgbe) == Texel{1.5, 1.5, 1.5, 1});
  CHECK(texel("") == Texel{1.5, 1.5, 1.5, 1});
  CHECK(texel(rgbe + "EXPOSURE=0.5\n") == Texel{3, 3, 3, 1});
  CHECK(texel("EXPOSURE= 4\n" + rgbe + "EXPOSURE=\t0.5e0 \nSOFTWARE=x\n") == Texel{0.75, 0.75, 0.75, 1});
  CHECK(texel(rgbe + "\tEXPOSURE=0.5\n") == Texel{1.5, 1.5, 1.5, 1});  // of another picture
  CHECK(texel(rgbe + "COLORCORR=0.5 1 2\nEXPOSURE=2\n") == Texel{1.5, 0.75, 0.375, 1});

  const auto fault = [&](const std::string& bytes) {
    const std::string file = folder.write("a.hdr", bytes);
    const std::string message = user_error_of([&] { read_image(file, true); }, file);
    return message.substr(std::min(message.size(), std::string("a.hdr: cannot be decoded: ").size()));
  };
  for (const std::string value : {"0", "-1", "nan", "inf", "x", "", "1e999"})
    CHECK(fault(header("EXPOSURE=" + value + "\n", "-Y 1 +X 2") + data) ==
          "its EXPOSURE is not a positive number");
  CHECK(fault(header("EXPOSURE=1e-200\nEXPOSURE=1e-200\n", "-Y 1 +X 2") + data) ==
        "the product of its EXPOSURE lines is no number");
  CHECK(fault(header("FORMAT=16-bit\n", "-Y 1 +X 2") + data) ==
        "its FORMAT is unknown; expected 32-bit_rle_rgbe or 32-bit_rle_xyze");
  for (const std::string size : {"-Y 1 +Y 2", "-Y 1", "1 2", "-Y one +X 2", "-Z 1 +X 2"})
    CHECK(fault(header(rgbe, size) + data) == "its size is damaged; expected a line like -Y 512 +X 1024");
  CHECK(fault(header(rgbe, "-Y 0 +X 2") + data) == "it has no pixels");
  CHECK(fault(header(rgbe, "-Y 1000000 +X 1000000") + data).find("pixels are too many") != std::string::npos);
  CHECK(fault("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n") == "its header ends early; is it truncated?");
}

TEST_CASE("HDR: all eight orders of scanlines and pixels") {
  const TemporaryFolder folder;
  const std::vector<float> seen{130, 140, 150, 160, 170, 180};  // 3 x 2
  const std::vector<std::pair<std::string, std::vector<int>>> stored{
      {"-Y 2 +X 3", {130, 140, 150, 160, 170, 180}}, {"-Y 2 -X 3", {150, 140, 130, 180, 170, 160}},
      {"+Y 2 -X 3", {180, 170, 160, 150, 140, 130}}, {"+Y 2 +X 3", {160, 170, 180, 130, 140, 150}},
      {"+X 3 -Y 2", {130, 160, 140, 170, 150, 180}}, {"-X 3 -Y 2", {150, 180, 140, 170, 130, 160}},
      {"-X 3 +Y 2", {180, 150, 170, 140, 160, 130}}, {"+X 3 +Y 2", {160, 130, 170, 140, 180, 150}}};
  for (const auto& [size, values] : stored) {
    CAPTURE(size);
    std::string data;
    for (const int value : values) data += pixel(value);
    CHECK(read_red(folder, header(rgbe, size) + data) == seen);
    const Image image = read_image(folder.path("a.hdr"), true);
    CHECK(image.width == 3);
    CHECK(image.height == 2);
  }
}

TEST_CASE("HDR: old run lengths, new ones, and none, are the same picture") {
  const TemporaryFolder folder;
  // 300 x 2: 290 of one value and 10 of another in the first row, one value in the second.
  std::vector<float> expected(600, 200);
  for (std::size_t i = 0; i < 290; ++i) expected[i] = 150;
  std::string flat, newer;
  for (const float value : expected) flat += pixel(int(value));
  const auto run = [](int count) { return std::string{'\1', '\1', '\1', static_cast<char>(count)}; };
  // 290 = 1 + 33 + 256 * 1; the next runs begin to count anew. One may go on into the next row.
  const std::string old = pixel(150) + run(33) + run(1) + pixel(200) + run(9) + pixel(200) + run(43) + run(1);
  const std::string over_rows = pixel(150) + run(33) + run(1) + pixel(200) + run(53) + run(1);
  for (int row = 0; row < 2; ++row) {
    newer += "\2\2" + std::string{'\1', '\x2c'};
    for (int channel = 0; channel < 4; ++channel)
      for (int left = 300, x = 0; left > 0;) {
        const int same = row == 0 ? (x < 290 ? 290 - x : 10) : left;
        const int count = std::min(same, 127);
        newer += static_cast<char>(128 + count);
        newer += channel == 3 ? '\x81' : static_cast<char>(row == 0 && x < 290 ? 150 : 200);
        left -= count;
        x += count;
      }
  }
  for (const std::string& data : {flat, old, over_rows, newer})
    CHECK(read_red(folder, header(rgbe, "-Y 2 +X 300") + data) == expected);
  const auto fault = [&](const std::string& data) {
    const std::string file = folder.write("b.hdr", header(rgbe, "-Y 2 +X 300") + data);
    return user_error_of([&] { read_image(file, true); }, file);
  };
  CHECK(fault(old.substr(0, old.size() - 4)) == "b.hdr: cannot be decoded: it ends early; is it truncated?");
  CHECK(fault(run(3) + old) == "b.hdr: cannot be decoded: a run of pixels is longer than the picture");
  CHECK(fault(pixel(150) + run(255) + run(255)) ==
        "b.hdr: cannot be decoded: a run of pixels is longer than the picture");
}

TEST_CASE("HDR: XYZ becomes linear sRGB, and PRIMARIES have a note") {
  const TemporaryFolder folder;
  // D65 white, times 0.8: 0.95047, 1, 1.08883.
  const std::string white{'\xc3', '\xcd', '\xdf', '\x80'};
  const Image image = read_image(
      folder.write("a.hdr", header("FORMAT=32-bit_rle_xyze\nEXPOSURE=0.5\n", "-Y 1 +X 1") + white), true);
  for (std::size_t c = 0; c < 3; ++c) CHECK(image.rgba[c] == Approx(1.6).epsilon(0.01));
  const Image other = read_image(
      folder.write("a.hdr",
                   header(rgbe + "PRIMARIES=0.7 0.3 0.2 0.7 0.1 0.1 0.3 0.3\n", "-Y 1 +X 1") + white),
      true);
  CHECK(notes_of(other) == "its PRIMARIES are not applied: its colours are taken as linear sRGB\n");
}

}  // namespace causticl
