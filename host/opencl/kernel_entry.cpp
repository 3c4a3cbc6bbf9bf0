#include "opencl/kernel_entry.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstring>

namespace causticl {
namespace {

constexpr std::size_t checksum_size = 16;

/// A number of 8 bytes, the lowest first.
void append_number(std::string& bytes, std::uint64_t number) {
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

/// Takes pieces off the front of an entry.
class EntryReader {
 public:
  EntryReader(const std::uint8_t* begin, const std::uint8_t* end) : at_(begin), end_(end) {}

  bool number(std::uint64_t& value) {
    if (end_ - at_ < 8) return false;
    value = 0;
    for (int i = 0; i < 8; ++i) value |= std::uint64_t{*at_++} << (8 * i);
    return true;
  }

  /// As many bytes as the number before them says.
  template <typename Bytes>
  bool bytes(Bytes& value) {
    std::uint64_t size = 0;
    if (!number(size) || size > static_cast<std::uint64_t>(end_ - at_)) return false;
    value.assign(at_, at_ + size);
    at_ += size;
    return true;
  }

  bool done() const { return at_ == end_; }

 private:
  const std::uint8_t *at_, *end_;
};

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::array<std::uint8_t, 16> checksum(const void* data, std::size_t size) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(data, size));
  std::array<std::uint8_t, checksum_size> result;
  std::memcpy(result.data(), canonical.digest, checksum_size);
  return result;
}

bool is_name_within(const std::string& name) {
  if (std::any_of(name.begin(), name.end(), is_control)) return false;
  for (std::size_t begin = 0, end = 0; end != name.npos; begin = end + 1) {
    end = name.find('/', begin);
    const std::string part = name.substr(begin, end - begin);
    if (part.empty() || part == "." || part == ".." || part.size() > 255) return false;
  }
  return true;
}

std::string pack_kernels(const KernelFiles& files) {
  std::string body;
  for (const auto& file : files) {
    append_number(body, file.name.size());
    body += file.name;
    append_number(body, file.bytes.size());
    body.append(file.bytes.begin(), file.bytes.end());
  }
  const auto sum = checksum(body.data(), body.size());
  return std::string(sum.begin(), sum.end()) + body;
}

std::optional<KernelFiles> unpack_kernels(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < checksum_size) return {};
  const std::uint8_t* body = bytes.data() + checksum_size;
  const auto sum = checksum(body, bytes.size() - checksum_size);
  if (!std::equal(sum.begin(), sum.end(), bytes.begin())) return {};
  KernelFiles files;
  for (EntryReader reader(body, bytes.data() + bytes.size()); !reader.done();) {
    KernelFile& file = files.emplace_back();
    if (!reader.bytes(file.name) || !is_name_within(file.name) || !reader.bytes(file.bytes)) return {};
  }
  return files;
}

}  // namespace causticl
