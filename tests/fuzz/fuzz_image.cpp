#include <cstring>

#include "fuzz_input.hpp"
#include "image/image.hpp"
#include "image/image_formats.hpp"

namespace causticl {
namespace {

// Little, so that no input takes long, and inputs beyond it are common.
constexpr ImageLimits limits{std::uint64_t{8} << 20, true};

/// `bytes` with the signature that makes them a file of this format.
std::string with_signature(std::string bytes, const std::string& signature) {
  return bytes.replace(0, std::min(bytes.size(), signature.size()), signature);
}

void read(const std::string& name, const std::string& bytes, bool srgb) {
  const std::string file = fuzz_folder().write(name, bytes);
  read_or_refuse([&] {
    const Image image = read_image(file, srgb, limits);
    promise(image.width > 0 && image.height > 0, "an image has pixels");
    promise(image.rgba.size() * sizeof(float) <= limits.memory, "an image stays within the limit");
    promise(image.rgba.size() == std::size_t{4} * static_cast<std::size_t>(image.width) *
                                     static_cast<std::size_t>(image.height),
            "an image has four floats a pixel");
  });
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

/// Reads a picture as `causticl compare` does. What encode() writes of it must read back the same.
template <typename Encode>
void read_back(const std::string& name, const std::string& bytes, Encode encode) {
  const std::string file = fuzz_folder().write(name, bytes);
  read_or_refuse([&] {
    const Picture picture = read_picture(file, limits);
    const std::size_t pixels =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    promise(pixels > 0 && picture.rgb.size() == 3 * pixels, "a picture has three floats a pixel");
    for (const Channel& channel : picture.channels)
      promise(channel.values.size() == pixels, "a channel has one number a pixel");
    if (pixels > 4096) return;  // writing takes long
    const Picture again = read_picture(fuzz_folder().write(name, encode(picture)));
    promise(again.width == picture.width && again.height == picture.height, "a written picture has its size");
    promise(same_bits(again.rgb, picture.rgb), "a written picture has the same pixels");
    promise(again.channels.size() == picture.channels.size(), "a written picture has its channels");
  });
}

}  // namespace

void fuzz_png(const std::string& bytes) {
  read("fuzz.png", with_signature(bytes, "\x89PNG\r\n\x1a\n"), true);
}

void fuzz_jpeg(const std::string& bytes) { read("fuzz.jpg", with_signature(bytes, "\xff\xd8\xff"), true); }

void fuzz_hdr(const std::string& bytes) { read("fuzz.hdr", with_signature(bytes, "#?R"), false); }

void fuzz_bmp(const std::string& bytes) { read("fuzz.bmp", with_signature(bytes, "BM"), true); }

// A TGA has no signature: what no other format claims.
void fuzz_tga(const std::string& bytes) { read("fuzz.tga", bytes, true); }

void fuzz_pfm(const std::string& bytes) {
  const std::string signed_bytes = with_signature(bytes, "P");
  read("fuzz.pfm", signed_bytes, false);
  read_back("fuzz.pfm", signed_bytes, encode_pfm);
}

void fuzz_exr(const std::string& bytes) {
  const std::string signed_bytes = with_signature(bytes, "\x76\x2f\x31\x01");
  read("fuzz.exr", signed_bytes, false);
  read_back("fuzz.exr", signed_bytes, [](const Picture& picture) { return encode_exr(picture, {}); });
}

}  // namespace causticl
