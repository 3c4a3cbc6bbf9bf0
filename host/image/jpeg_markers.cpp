#include "image/jpeg_markers.hpp"

#include <algorithm>
#include <stdexcept>

namespace causticl {
namespace {

// A progressive picture of three channels takes 10 as a rule, and a few dozen where each bit has its own.
constexpr int most_scans = 64;

// Each scan passes over all pixels, be there data for them or not: 32 times over the largest picture that any
// small file may hold, and more as the file is larger.
constexpr std::uint64_t most_passed_pixels = std::uint64_t{1} << 28, most_passed_pixels_a_byte = 4096;

enum Marker : unsigned {
  baseline_frame = 0xc0,
  progressive_frame = 0xc2,
  huffman_tables = 0xc4,
  first_restart = 0xd0,
  last_restart = 0xd7,
  start_of_image = 0xd8,
  end_of_image = 0xd9,
  start_of_scan = 0xda
};

class Walk {
 public:
  explicit Walk(const std::string& bytes) : bytes_(bytes) {}

  std::uint64_t planes() {
    // Markers stand behind one or more FF. Between segments stb looks for the next FF; so it does within the
    // data of a scan, where FF 00 stands for a byte FF and restart markers go on with the scan.
    bool in_scan = false;
    while (next_marker()) {
      const unsigned marker = byte(at_++);
      if (in_scan && (marker == 0 || (marker >= first_restart && marker <= last_restart))) continue;
      if (marker == start_of_image) continue;
      if (marker == end_of_image) break;
      in_scan = marker == start_of_scan;
      segment(marker);
    }
    return planes_;
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
  std::uint64_t planes_ = 0, pixels_ = 0, passed_pixels_ = 0;
  int scans_ = 0;

  unsigned byte(std::size_t at) const {
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0u;
  }
  unsigned word(std::size_t at) const { return byte(at) << 8 | byte(at + 1); }

  /// Goes to the byte behind the next FFs, if there is one.
  bool next_marker() {
    at_ = bytes_.find('\xff', at_);
    while (at_ < bytes_.size() && byte(at_) == 0xff) ++at_;
    return at_ < bytes_.size();
  }

  void segment(unsigned marker) {
    const std::size_t end = at_ + word(at_);
    if (marker == huffman_tables) check_tables(at_ + 2, end);
    if (marker >= baseline_frame && marker <= progressive_frame) count_planes(marker == progressive_frame);
    if (marker == start_of_scan) count_scan();
    at_ = std::max(at_, end);
  }

  void count_scan() {
    passed_pixels_ += pixels_;
    if (++scans_ > most_scans)
      throw std::runtime_error("it has more than " + std::to_string(most_scans) + " scans");
    if (passed_pixels_ > most_passed_pixels + most_passed_pixels_a_byte * bytes_.size())
      throw std::runtime_error("it has " + std::to_string(scans_) +
                               " scans or more, too many of so many pixels in so small a file");
  }

  /// stb reads tables for as long as the segment's length is not used up.
  void check_tables(std::size_t table, std::size_t end) const {
    while (table < end) {
      std::size_t codes = 0;
      for (std::size_t length = 1; length <= 16; ++length) codes += byte(table + length);
      if (codes > 256) throw std::runtime_error("a Huffman table has more than 256 codes");
      table += 17 + codes;
    }
  }

  /// Length, bits, height, width, number of components; of each its name, sampling and table.
  void count_planes(bool progressive) {
    const std::uint64_t height = word(at_ + 3), width = word(at_ + 5), count = byte(at_ + 7);
    std::uint64_t across = 1, down = 1, blocks = 0;  // samplings: the most, and products of both
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t sampling = byte(at_ + 9 + 3 * i), h = sampling >> 4, v = sampling & 15;
      across = std::max(across, h);
      down = std::max(down, v);
      blocks += h * v;
    }
    const std::uint64_t units =
        (width + 8 * across - 1) / (8 * across) * ((height + 8 * down - 1) / (8 * down));
    pixels_ = std::max(pixels_, width * height);
    // A byte a sample, and two more for its coefficient.
    planes_ = std::max(planes_, units * blocks * 64 * (progressive ? 3 : 1));
  }
};

}  // namespace

bool is_jpeg(const std::string& bytes) {
  const std::size_t marker = bytes.find_first_not_of('\xff');
  return marker != bytes.npos && marker > 0 && static_cast<unsigned char>(bytes[marker]) == start_of_image;
}

std::uint64_t check_jpeg(const std::string& bytes) { return Walk(bytes).planes(); }

}  // namespace causticl
