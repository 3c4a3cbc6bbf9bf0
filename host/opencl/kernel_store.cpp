#include "opencl/kernel_store.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <vector>

namespace causticl {
namespace {

namespace fs = std::filesystem;

constexpr const char* extension = ".kernels";

std::string name_of(const std::string& key) {
  std::string name;
  for (const std::uint8_t byte : checksum(key.data(), key.size())) {
    constexpr const char* digits = "0123456789abcdef";
    name += {digits[byte >> 4], digits[byte & 15]};
  }
  return name + extension;
}

std::vector<std::string> names_in(int folder) {
  std::vector<std::string> names;
  const std::unique_ptr<DIR, int (*)(DIR*)> listing(
      fdopendir(openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)), closedir);
  if (!listing) return names;
  while (const dirent* entry = readdir(listing.get())) names.emplace_back(entry->d_name);
  return names;
}

}  // namespace

KernelStore::KernelStore(const fs::path& folder, std::uint64_t limit)
    : folder_(open_trusted_folder(folder, FolderUse::own)), limit_(limit) {}

fs::path KernelStore::file_of(const std::string& key) const { return folder_.path / name_of(key); }

std::optional<KernelFiles> KernelStore::load(const std::string& key, std::string& damage) const {
  const std::string name = name_of(key);
  const int folder = folder_.descriptor.get();
  std::string fault;
  const auto bytes = read_own_file(folder, name, default_limit, fault);
  if (!bytes && fault.empty()) return {};
  if (bytes) {
    if (auto files = unpack_kernels(*bytes)) {
      // Its age is the time of its last use.
      utimensat(folder, name.c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
      return files;
    }
    fault = "is damaged";
  }
  damage = "the kernel cache's " + file_of(key).string() + " " + fault + "; its kernels are built anew";
  unlinkat(folder, name.c_str(), 0);
  return {};
}

void KernelStore::save(const std::string& key, const KernelFiles& files) const {
  write_own_file(folder_, name_of(key), pack_kernels(files));
  remove_oldest();
}

void KernelStore::remove_oldest() const {
  struct Entry {
    timespec used;
    std::uint64_t size;
    std::string name;
  };
  const int folder = folder_.descriptor.get();
  const std::time_t an_hour_ago = std::time(nullptr) - 3600;
  std::vector<Entry> entries;
  std::uint64_t total = 0;
  for (const auto& name : names_in(folder)) {
    struct stat status {};  // another process may remove them at the same time
    if (fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    // Left by a process that was killed while it wrote: none takes an hour.
    if (is_own_temporary(name) && status.st_mtim.tv_sec < an_hour_ago) unlinkat(folder, name.c_str(), 0);
    if (fs::path(name).extension() != extension) continue;
    entries.push_back({status.st_mtim, static_cast<std::uint64_t>(status.st_size), name});
    total += entries.back().size;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
  });
  for (std::size_t i = 0; i < entries.size() && total > limit_; ++i) {
    unlinkat(folder, entries[i].name.c_str(), 0);
    total -= entries[i].size;
  }
}

}  // namespace causticl
