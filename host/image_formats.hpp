// The decoders and encoders behind image.hpp, from and to bytes in memory.
#pragma once

#include <string>

#include "image.hpp"

namespace causticl {

/// Throws std::runtime_error for an image without pixels, and for one of more than 2^28, so that a damaged
/// header cannot ask for all memory.
void check_image_size(long long width, long long height);

/// Whether the bytes begin as an OpenEXR file does.
bool is_exr(const std::string& bytes);

/// Decodes an EXR file: four floats a pixel, top row first. A file with Y but no R, G, B is grey; a missing
/// alpha is 1. Throws std::exception.
void decode_exr(const std::string& bytes, int& width, int& height, std::vector<float>& rgba);

/// The channels of an EXR file whose names begin with `prefix`, top row first. Throws std::exception.
std::vector<Channel> decode_exr_channels(const std::string& bytes, const std::string& prefix);

/// R, G, B and all other channels as 32-bit floats, ZIP compressed, with one string attribute for each entry
/// of `metadata`.
std::string encode_exr(const Picture& picture, const Metadata& metadata);

/// Whether the bytes begin as a PFM file does.
bool is_pfm(const std::string& bytes);

/// Clamp to [0, 1], power 1/2.2, 8 bits a channel. Throws std::runtime_error.
std::string encode_png(const Picture& picture);

/// PFM, colour (PF) or grey (Pf), of either byte order. Throws std::runtime_error.
Picture decode_pfm(const std::string& bytes);

/// PFM, little-endian, bottom row first.
std::string encode_pfm(const Picture& picture);

}  // namespace causticl
