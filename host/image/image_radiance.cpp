#include "image/image_radiance.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "image/image_formats.hpp"

namespace causticl {
namespace {

std::string_view next_word(std::string_view& text) {
  const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
  const auto end = std::min(text.find_first_of(" \t", begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// A factor that the header says has been applied to the pixels.
double read_factor(std::string_view& text, const char* key) {
  const std::string_view word = next_word(text);
  double value = 0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || stop != word.data() + word.size() || !(value > 0) || !std::isfinite(value))
    throw std::runtime_error(std::string("its ") + key + " is not a positive number");
  return value;
}

/// One axis of a picture's size: "-Y 512".
struct Axis {
  char name = 0;
  bool increasing = false;
  long long extent = 0;
};

Axis read_axis(std::string_view& text) {
  const std::string_view sign = next_word(text), number = next_word(text);
  Axis axis;
  const bool is_axis =
      sign.size() == 2 && (sign[0] == '+' || sign[0] == '-') && (sign[1] == 'X' || sign[1] == 'Y');
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), axis.extent);
  if (!is_axis || error != std::errc{} || stop != number.data() + number.size())
    throw std::runtime_error("its size is damaged; expected a line like -Y 512 +X 1024");
  axis.name = sign[1];
  axis.increasing = sign[0] == '+';
  return axis;
}

/// The way in which scanlines along `fast`, one after another along `slow`, are stored. X increases to the
/// right and Y upwards.
int orientation_of(const Axis& slow, const Axis& fast) {
  if (slow.name == 'Y') {
    const bool from_top = !slow.increasing, from_left = fast.increasing;
    return from_top ? (from_left ? 1 : 2) : (from_left ? 4 : 3);
  }
  const bool from_left = slow.increasing, from_top = !fast.increasing;
  return from_left ? (from_top ? 5 : 8) : (from_top ? 6 : 7);
}

/// Pixels of four bytes, of which (1, 1, 1, n) repeats the one before n times; the next such one right after
/// it n * 256 times, and so on.
std::string unpack_runs(std::string_view data, std::size_t pixels) {
  std::string unpacked;
  unpacked.reserve(std::min(4 * pixels, std::size_t{1} << 24));
  std::size_t at = 0;
  for (unsigned shift = 0; unpacked.size() < 4 * pixels; at += 4) {
    if (data.size() - at < 4) throw std::runtime_error("it ends early; is it truncated?");
    const std::string_view pixel = data.substr(at, 4);
    if (pixel.substr(0, 3) != "\1\1\1") {
      unpacked += pixel;
      shift = 0;
      continue;
    }
    const std::size_t left = pixels - unpacked.size() / 4;
    const std::size_t count = std::size_t{static_cast<unsigned char>(pixel[3])} << shift;
    if (unpacked.empty() || count > left)
      throw std::runtime_error("a run of pixels is longer than the picture");
    const std::string last = unpacked.substr(unpacked.size() - 4);
    for (std::size_t i = 0; i < count; ++i) unpacked += last;
    shift = std::min(shift + 8, 32u);
  }
  return unpacked;
}

class HeaderReader {
 public:
  HeaderReader(const std::string& bytes, const ImageLimits& limits)
      : bytes_(bytes), limits_(limits), rest_(bytes) {}

  RadiancePicture read() {
    next_line();  // "#?RADIANCE"
    for (std::string_view line = next_line(); !line.empty(); line = next_line()) read_line(line);
    std::string_view size = next_line();
    const Axis slow = read_axis(size), fast = read_axis(size);
    if (slow.name == fast.name)
      throw std::runtime_error("its size is damaged; expected a line like -Y 512 +X 1024");
    check_image_cost(stb_cost(bytes_, fast.extent, slow.extent), bytes_.size(), limits_);
    picture_.orientation = orientation_of(slow, fast);
    // Scanlines of the newer kind begin with 2, 2 and their length.
    const auto byte = [&](std::size_t i) {
      return i < rest_.size() ? static_cast<unsigned char>(rest_[i]) : 0u;
    };
    const bool newer =
        fast.extent >= 8 && fast.extent < 32768 && byte(0) == 2 && byte(1) == 2 && byte(2) < 128;
    picture_.bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(slow.extent) + " +X " +
                     std::to_string(fast.extent) + "\n";
    if (newer)
      picture_.bytes += rest_;
    else
      picture_.bytes += unpack_runs(rest_, static_cast<std::size_t>(slow.extent * fast.extent));
    return std::move(picture_);
  }

 private:
  const std::string& bytes_;
  const ImageLimits& limits_;
  std::string_view rest_;
  RadiancePicture picture_;

  std::string_view next_line() {
    constexpr std::size_t longest = 1 << 16;
    const auto end = rest_.substr(0, longest).find('\n');
    if (end == rest_.npos) throw std::runtime_error("its header ends early; is it truncated?");
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  /// "NAME=value". Indented lines are about the pictures that this one was made from.
  void read_line(std::string_view line) {
    const auto equals = line.find('=');
    if (equals == line.npos) return;
    const std::string_view name = line.substr(0, equals);
    std::string_view value = line.substr(equals + 1);
    if (name == "FORMAT") {
      const std::string_view format = next_word(value);
      picture_.is_xyz = format == "32-bit_rle_xyze";
      if (!picture_.is_xyz && format != "32-bit_rle_rgbe")
        throw std::runtime_error("its FORMAT is unknown; expected 32-bit_rle_rgbe or 32-bit_rle_xyze");
    } else if (name == "EXPOSURE") {
      const double exposure = read_factor(value, "EXPOSURE");
      for (double& factor : picture_.factors) factor /= exposure;
    } else if (name == "COLORCORR") {
      for (double& factor : picture_.factors) factor /= read_factor(value, "COLORCORR");
    } else if (name == "PRIMARIES") {
      picture_.notes.push_back("its PRIMARIES are not applied: its colours are taken as linear sRGB");
    }
    for (const double factor : picture_.factors)
      if (!(factor > 0) || !std::isfinite(factor))
        throw std::runtime_error("the product of its EXPOSURE lines is no number");
  }
};

}  // namespace

bool is_radiance(const std::string& bytes) { return bytes.compare(0, 2, "#?") == 0; }

RadiancePicture read_radiance(const std::string& bytes, const ImageLimits& limits) {
  return HeaderReader(bytes, limits).read();
}

void finish_radiance(const RadiancePicture& picture, std::vector<float>& rgba) {
  const auto& factors = picture.factors;
  if (factors != std::array<double, 3>{1, 1, 1})
    for (std::size_t i = 0; i < rgba.size(); ++i)
      if (i % 4 != 3) rgba[i] = static_cast<float>(rgba[i] * factors[i % 4]);
  if (!picture.is_xyz) return;
  // IEC 61966-2-1. What no mixture of the primaries can show is cut off.
  constexpr double to_rgb[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                   {-0.9692660, 1.8760108, 0.0415560},
                                   {0.0556434, -0.2040259, 1.0572252}};
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const double xyz[3] = {rgba[i], rgba[i + 1], rgba[i + 2]};
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = to_rgb[c][0] * xyz[0] + to_rgb[c][1] * xyz[1] + to_rgb[c][2] * xyz[2];
      rgba[i + c] = static_cast<float>(std::max(0.0, value));
    }
  }
}

}  // namespace causticl
