// The decoders and encoders behind image.hpp, from and to bytes in memory.
#pragma once

#include <string>

#include "image/image.hpp"

namespace causticl {

/// Throws std::runtime_error for an image without pixels, and for one of more than 2^28, so that a damaged
/// header cannot ask for all memory.
void check_image_size(long long width, long long height);

/// Whether the bytes begin as an OpenEXR file does.
bool is_exr(const std::string& bytes);

/// Decodes an EXR file: four floats a pixel of its display window, top row first, by the channels that
/// choose_exr_channels() finds. Black where the data window does not reach; a missing alpha is 1. Appends to
/// `notes` what the user should know. Throws std::exception.
void decode_exr(const std::string& bytes, int& width, int& height, std::vector<float>& rgba,
                std::vector<std::string>* notes = nullptr);

/// The channels of an EXR file whose names begin with `prefix`, as decode_exr() gives pixels. Throws
/// std::exception.
std::vector<Channel> decode_exr_channels(const std::string& bytes, const std::string& prefix);

/// R, G, B and all other channels as 32-bit floats, ZIP compressed, with one string attribute for each entry
/// of `metadata`.
std::string encode_exr(const Picture& picture, const Metadata& metadata);

/// Whether the bytes begin as a PFM file does.
bool is_pfm(const std::string& bytes);

/// Clamp to [0, 1], power 1/2.2, 8 bits a channel. Throws std::runtime_error.
std::string encode_png(const Picture& picture);

/// PFM, colour (PF) or grey (Pf), of either byte order, times its scale factor. Appends to `notes` what the
/// user should know. Throws std::runtime_error.
Picture decode_pfm(const std::string& bytes, std::vector<std::string>* notes = nullptr);

/// PFM, little-endian, bottom row first.
std::string encode_pfm(const Picture& picture);

}  // namespace causticl
