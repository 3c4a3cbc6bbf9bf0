// The markers of a JPEG file, walked as stb_image walks them, before it does.
#pragma once

#include <cstdint>
#include <string>

namespace causticl {

/// Whether stb_image takes the bytes for a JPEG file: a start marker, which fill bytes may precede.
bool is_jpeg(const std::string& bytes);

/// Bytes that stb_image takes for the planes of a JPEG file. Throws std::runtime_error for a Huffman table of
/// more than 256 codes, past which stb_image before 2.28 writes beyond its own tables, and for more scans
/// than any encoder makes, each of which passes over the whole picture.
std::uint64_t check_jpeg(const std::string& bytes);

}  // namespace causticl
