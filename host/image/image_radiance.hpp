// What the header of a Radiance picture (.hdr) says, and its older ways to store pixels: stb_image reads one
// way alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "image/image_limits.hpp"

namespace causticl {

struct RadiancePicture {
  std::string bytes;                       // of the same pixels as stb_image reads them
  int orientation = 1;                     // see Upright; each scanline is a row
  std::array<double, 3> factors{1, 1, 1};  // of red, green and blue: what EXPOSURE and COLORCORR undo
  bool is_xyz = false;                     // the pixels are CIE XYZ
  std::vector<std::string> notes;          // for the user
};

bool is_radiance(const std::string& bytes);

/// Reads the header, and unpacks the run lengths of before 1991 (Ward, "Real Pixels", Graphics Gems II).
/// Throws std::runtime_error, also for pictures beyond the limits.
RadiancePicture read_radiance(const std::string& bytes, const ImageLimits& limits);

/// Makes radiance in linear sRGB of the floats that stb_image has decoded, four a pixel.
void finish_radiance(const RadiancePicture& picture, std::vector<float>& rgba);

}  // namespace causticl
