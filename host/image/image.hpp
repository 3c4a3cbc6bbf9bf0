// Images: decoding textures, and writing what was rendered.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/image_limits.hpp"

namespace causticl {

/// A decoded texture: linear RGB and alpha as floats, four a texel, BOTTOM row first.
struct Image {
  std::string file;
  int width = 0, height = 0;
  std::vector<float> rgba;
  std::vector<std::string> notes = {};  // what the file says that is not applied, or not as usual
};

/// Reads PNG, JPEG, BMP, TGA, HDR (stb_image), PFM or EXR, turned upright as the file says. `srgb` decodes
/// integers by the sRGB curve, or by another that the file names; otherwise they are value/max. Throws
/// UserError naming the file and the fault.
Image read_image(const std::string& file, bool srgb, const ImageLimits& limits = {});

/// One number of every pixel beside its colour, under the name that it has in an EXR file.
struct Channel {
  std::string name;
  std::vector<float> values;
};

/// A rendered picture: linear RGB, three floats a pixel, TOP row first; and what else is known of its pixels.
struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;
  std::vector<Channel> channels = {};
};

/// Text attributes for formats that can hold them (EXR).
using Metadata = std::map<std::string, std::string>;

/// Throws UserError if `file` has no extension that write_picture knows (.png, .exr, .pfm) or if its folder
/// does not exist or cannot be written, so that this is known before hours of rendering.
void check_output(const std::string& file);

/// Whether a file of this name can hold Picture::channels.
bool holds_channels(const std::string& file);

/// Writes by extension: PNG (clamp to [0,1], power 1/2.2, 8 bit), EXR (float, with channels and metadata),
/// PFM. Writes to a temporary name in the same folder, then renames. Throws UserError.
void write_picture(const std::string& file, const Picture& picture, const Metadata& metadata);

/// Whether what cannot be written may be lost, as a newer picture will follow, or is kept elsewhere.
enum class Unwritable { lost, kept };

struct UnwrittenPicture {
  std::string file, fault;  // the fault names the file, and where its bytes are now
};

/// Writes the picture to every one of `files`, also where some fail. Returns those that failed.
std::vector<UnwrittenPicture> write_pictures(const std::vector<std::string>& files, const Picture& picture,
                                             const Metadata& metadata, Unwritable unwritable);

/// Reads .pfm or .exr back as linear RGB, an EXR file with its channels error.*. Throws UserError.
Picture read_picture(const std::string& file, const ImageLimits& limits = {});

}  // namespace causticl
