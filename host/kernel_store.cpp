#include "kernel_store.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "output_file.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

constexpr const char* extension = ".kernels";
constexpr std::size_t checksum_size = 16;

/// XXH3, 128 bits, in the order of bytes that is the same on every machine.
std::array<std::uint8_t, checksum_size> checksum(const void* data, std::size_t size) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(data, size));
  std::array<std::uint8_t, checksum_size> result;
  std::memcpy(result.data(), canonical.digest, checksum_size);
  return result;
}

std::optional<std::vector<std::uint8_t>> read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(in), {});
}

/// MessagePack, after its checksum.
std::string packed(const KernelFiles& files) {
  nlohmann::json entry = nlohmann::json::array();
  for (const auto& file : files) entry.push_back({file.name, nlohmann::json::binary(file.bytes)});
  const auto body = nlohmann::json::to_msgpack(entry);
  const auto sum = checksum(body.data(), body.size());
  std::string bytes(sum.begin(), sum.end());
  bytes.append(body.begin(), body.end());
  return bytes;
}

/// Throws nlohmann::json::exception for what packed() did not make.
KernelFiles unpacked(const std::uint8_t* body, std::size_t size) {
  KernelFiles files;
  for (const auto& file : nlohmann::json::from_msgpack(body, body + size)) {
    const std::vector<std::uint8_t>& bytes = file.at(1).get_binary();
    files.push_back({file.at(0).get<std::string>(), bytes});
  }
  return files;
}

bool checksum_holds(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < checksum_size) return false;
  const auto sum = checksum(bytes.data() + checksum_size, bytes.size() - checksum_size);
  return std::equal(sum.begin(), sum.end(), bytes.begin());
}

}  // namespace

KernelStore::KernelStore(fs::path folder, std::uint64_t limit) : folder_(std::move(folder)), limit_(limit) {}

fs::path KernelStore::file_of(const std::string& key) const {
  std::string name;
  for (const std::uint8_t byte : checksum(key.data(), key.size())) {
    constexpr const char* digits = "0123456789abcdef";
    name += {digits[byte >> 4], digits[byte & 15]};
  }
  return folder_ / (name + extension);
}

std::optional<KernelFiles> KernelStore::load(const std::string& key, std::string& damage) const {
  const fs::path file = file_of(key);
  const auto bytes = read_bytes(file);
  if (!bytes) return {};
  std::error_code error;
  try {
    if (checksum_holds(*bytes)) {
      // Its age is the time of its last use.
      fs::last_write_time(file, fs::file_time_type::clock::now(), error);
      return unpacked(bytes->data() + checksum_size, bytes->size() - checksum_size);
    }
  } catch (const nlohmann::json::exception&) {
    // Another format under a checksum that holds: as good as damaged.
  }
  damage = "the kernel cache's " + file.string() + " is damaged; its kernels are built anew";
  fs::remove(file, error);
  return {};
}

void KernelStore::save(const std::string& key, const KernelFiles& files) const {
  write_file(file_of(key).string(), packed(files));
  remove_oldest();
}

void KernelStore::remove_oldest() const {
  struct Entry {
    fs::file_time_type used;
    std::uint64_t size;
    fs::path file;
  };
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  std::error_code error;  // another process may remove them at the same time
  for (const auto& found : fs::directory_iterator(folder_, error)) {
    if (is_left_half_written(found.path())) fs::remove(found.path(), error);
    if (found.path().extension() != extension) continue;
    const auto used = found.last_write_time(error);
    const std::uint64_t size = error ? 0 : found.file_size(error);
    if (error) continue;
    entries.push_back({used, size, found.path()});
    total += size;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (std::size_t i = 0; i < entries.size() && total > limit_; ++i) {
    fs::remove(entries[i].file, error);
    total -= entries[i].size;
  }
}

}  // namespace causticl
