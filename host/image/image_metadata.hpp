// What PNG and JPEG files say about their pixels beside them, which stb_image passes over.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace causticl {

/// How stored values of colours, from 0 to 1, become linear ones.
struct Transfer {
  enum class Curve { power, srgb, rec709 };
  Curve curve = Curve::power;
  double exponent = 1;  // of a power; 1 is linear

  float to_linear(float value) const;
};

struct ImageMetadata {
  int orientation = 1;               // see Upright
  std::optional<Transfer> transfer;  // of the colours, where the file names one other than sRGB's
  std::vector<std::string> notes;    // for the user, where its values are colours
};

/// Of the bytes of a PNG file (its chunks eXIf, cICP, iCCP, sRGB, gAMA and cHRM) or of a JPEG file (Exif and
/// ICC profile). Damaged or missing metadata are as none.
ImageMetadata png_metadata(const std::string& bytes);
ImageMetadata jpeg_metadata(const std::string& bytes);

/// The orientation that a block of Exif data (a TIFF header and its first directory) names, 1 where none.
int exif_orientation(std::string_view tiff);

/// Whether an ICC profile is, by its own description, that of sRGB.
bool is_srgb_profile(std::string_view profile);

/// The note about colours whose primaries are not those of sRGB; `where` is what in the file says so.
std::string primaries_note(const std::string& where);

/// Where stored pixels are to be seen: the top row first, each from left to right. EXIF and TIFF number the
/// ways in which they can be stored by the place of the first row and of the first column: 1 top left, 2 top
/// right, 3 bottom right, 4 bottom left, 5 left top, 6 right top, 7 right bottom, 8 left bottom.
class Upright {
 public:
  /// `width` and `height` are those of the stored pixels.
  Upright(int orientation, int width, int height);

  int width() const { return static_cast<int>(width_); }
  int height() const { return static_cast<int>(height_); }
  /// The number of the pixel that is stored at `row` and `column`.
  std::size_t place(std::size_t row, std::size_t column) const {
    std::size_t x = transposed_ ? row : column, y = transposed_ ? column : row;
    if (from_right_) x = width_ - 1 - x;
    if (from_bottom_) y = height_ - 1 - y;
    return y * width_ + x;
  }

 private:
  bool transposed_, from_right_, from_bottom_;
  std::size_t width_, height_;
};

}  // namespace causticl
