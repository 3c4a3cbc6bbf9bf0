#include "image/image_metadata.hpp"

#include <stb/stb_image.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace causticl {
namespace {

std::uint32_t big_endian(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
  return value;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// The chunks of a PNG file that say what its colours are; empty where there is none.
struct PngChunks {
  std::string_view cicp, iccp, srgb, gama, chrm, exif;
};

PngChunks find_chunks(std::string_view bytes) {
  PngChunks chunks;
  constexpr std::size_t signature = 8, frame = 12;  // frame: length, type and checksum of a chunk
  for (std::size_t at = signature; at <= bytes.size() && bytes.size() - at >= frame;) {
    const std::size_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - frame) break;
    const std::string_view type = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, length);
    if (type == "cICP") chunks.cicp = data;
    if (type == "iCCP") chunks.iccp = data;
    if (type == "sRGB") chunks.srgb = data;
    if (type == "gAMA") chunks.gama = data;
    if (type == "cHRM") chunks.chrm = data;
    if (type == "eXIf") chunks.exif = data;
    at += frame + length;
  }
  return chunks;
}

/// The curve of an H.273 transfer characteristic, where it has one of ours.
std::optional<Transfer> transfer_of(std::uint32_t characteristic) {
  using Curve = Transfer::Curve;
  switch (characteristic) {
    case 1:
    case 6:
    case 14:
    case 15:
      return Transfer{Curve::rec709, 1};
    case 4:
      return Transfer{Curve::power, 2.2};
    case 5:
      return Transfer{Curve::power, 2.8};
    case 8:
      return Transfer{Curve::power, 1};
    case 13:
      return Transfer{Curve::srgb, 1};
    default:
      return {};
  }
}

void read_cicp(std::string_view chunk, ImageMetadata& metadata) {
  const std::uint32_t primaries = big_endian(chunk, 0, 1), characteristic = big_endian(chunk, 1, 1);
  const auto transfer = transfer_of(characteristic);
  if (!transfer) {
    metadata.notes.push_back("its transfer function (cICP " + std::to_string(characteristic) +
                             ") is not supported: its colours are decoded by the sRGB curve");
  } else if (transfer->curve != Transfer::Curve::srgb) {
    metadata.transfer = transfer;
    metadata.notes.push_back("its colours are decoded as its chunk cICP says, not by the sRGB curve");
  }
  constexpr std::uint32_t srgb_primaries = 1;
  if (primaries != srgb_primaries) metadata.notes.push_back(primaries_note("cICP"));
}

bool is_srgb_iccp(std::string_view chunk) {
  const auto name_end = chunk.find('\0');
  if (name_end == chunk.npos || name_end + 2 > chunk.size()) return false;
  if (chunk.substr(0, name_end).find("sRGB") != chunk.npos) return true;
  // A profile's description comes early: what does not fit is not needed.
  const std::string_view packed = chunk.substr(name_end + 2);
  std::vector<char> profile(1 << 16);
  if (packed.size() > 0x7fffffff) return false;
  stbi_zlib_decode_buffer(profile.data(), static_cast<int>(profile.size()), packed.data(),
                          static_cast<int>(packed.size()));
  return is_srgb_profile({profile.data(), profile.size()});
}

bool are_srgb_primaries(std::string_view chrm) {
  // x and y of white, red, green and blue, times 100000.
  constexpr std::array<double, 8> srgb{31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
  for (std::size_t i = 0; i < srgb.size(); ++i)
    if (std::fabs(big_endian(chrm, 4 * i, 4) - srgb[i]) > 200) return false;
  return true;
}

/// gAMA is the exponent of encoding, times 100000.
void read_gama(std::string_view chunk, ImageMetadata& metadata) {
  const std::uint32_t gamma = big_endian(chunk, 0, 4);
  constexpr std::uint32_t least = 1000, most = 10000000;  // beyond is no picture's
  if (gamma < least || gamma > most) {
    metadata.notes.push_back("its gAMA " + short_number(gamma / 1e5) +
                             " is no gamma: its colours are decoded by the sRGB curve");
    return;
  }
  metadata.transfer = Transfer{Transfer::Curve::power, 1e5 / gamma};
  metadata.notes.push_back("its colours are decoded by its gAMA " + short_number(gamma / 1e5) +
                           ", not by the sRGB curve");
}

}  // namespace

float Transfer::to_linear(float value) const {
  switch (curve) {
    case Curve::srgb:  // IEC 61966-2-1
      return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
    case Curve::rec709:  // ITU-R BT.709
      return value < 0.081f ? value / 4.5f : std::pow((value + 0.099f) / 1.099f, 1 / 0.45f);
    case Curve::power:
      break;
  }
  return exponent == 1 ? value : static_cast<float>(std::pow(value, exponent));
}

bool is_srgb_profile(std::string_view profile) {
  const std::string_view wide("\0s\0R\0G\0B", 8);  // UTF-16, in profiles of version 4
  return profile.find("sRGB") != profile.npos || profile.find(wide) != profile.npos;
}

std::string primaries_note(const std::string& where) {
  return "its primaries (" + where + ") are not those of sRGB: its colours are taken as if they were";
}

ImageMetadata png_metadata(const std::string& bytes) {
  const PngChunks chunks = find_chunks(bytes);
  ImageMetadata metadata;
  metadata.orientation = exif_orientation(chunks.exif);
  // Where several chunks speak of colour, the first of these counts (PNG, third edition, section 4.3).
  if (chunks.cicp.size() >= 4) {
    read_cicp(chunks.cicp, metadata);
  } else if (!chunks.iccp.empty()) {
    if (!is_srgb_iccp(chunks.iccp))
      metadata.notes.push_back("its colour profile (iCCP) is not applied: its colours are taken as sRGB");
  } else if (chunks.srgb.empty()) {
    if (chunks.gama.size() >= 4) read_gama(chunks.gama, metadata);
    if (chunks.chrm.size() >= 32 && !are_srgb_primaries(chunks.chrm))
      metadata.notes.push_back(primaries_note("cHRM"));
  }
  return metadata;
}

ImageMetadata jpeg_metadata(const std::string& file) {
  const std::string_view bytes = file, exif_mark("Exif\0\0", 6), icc_mark("ICC_PROFILE\0", 12);
  constexpr std::uint32_t start_of_scan = 0xda, app1 = 0xe1, app2 = 0xe2;
  ImageMetadata metadata;
  bool has_profile = false, is_srgb = false, has_exif = false;
  for (std::size_t at = 2; at + 4 <= bytes.size();) {
    if (big_endian(bytes, at, 1) != 0xff) break;
    const std::uint32_t marker = big_endian(bytes, at + 1, 1);
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    const std::size_t length = big_endian(bytes, at + 2, 2);
    if (marker == start_of_scan || length < 2) break;
    const std::string_view data = bytes.substr(at + 4, length - 2);
    if (marker == app1 && !has_exif && data.substr(0, exif_mark.size()) == exif_mark) {
      metadata.orientation = exif_orientation(data.substr(exif_mark.size()));
      has_exif = true;
    }
    if (marker == app2 && data.substr(0, icc_mark.size()) == icc_mark) {
      has_profile = true;
      is_srgb = is_srgb || is_srgb_profile(data);
    }
    at += 2 + length;
  }
  if (has_profile && !is_srgb)
    metadata.notes.push_back("its colour profile (ICC) is not applied: its colours are taken as sRGB");
  return metadata;
}

}  // namespace causticl
