// Entries of the kernel cache.
#include <algorithm>
#include <filesystem>

#include "fuzz_input.hpp"
#include "opencl/kernel_entry.hpp"
#include "opencl/kernel_store.hpp"

namespace causticl {
namespace {

/// The entry with the checksum that its body has: what a fuzzer cannot guess and an attacker computes.
std::string with_checksum(std::string entry) {
  constexpr std::size_t size = std::tuple_size_v<decltype(checksum(nullptr, 0))>;
  if (entry.size() < size) return entry;
  const auto sum = checksum(entry.data() + size, entry.size() - size);
  std::copy(sum.begin(), sum.end(), entry.begin());
  return entry;
}

bool same(const KernelFiles& a, const KernelFiles& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const KernelFile& one, const KernelFile& other) {
                      return one.name == other.name && one.bytes == other.bytes;
                    });
}

/// What is unpacked stays in its folder, and packs to the bytes that it came from.
bool unpacks(const std::string& entry) {
  const auto files = unpack_kernels({entry.begin(), entry.end()});
  if (!files) return false;
  for (const KernelFile& file : *files) {
    const std::filesystem::path name = file.name;
    promise(!file.name.empty() && name.is_relative(), "the name of a kernel's file is relative");
    for (const auto& part : name) promise(part != "..", "the name of a kernel's file stays in its folder");
    promise(file.name.find('\0') == std::string::npos, "the name of a kernel's file has no NUL");
  }
  promise(pack_kernels(*files) == entry, "an entry that unpacks packs to the same bytes");
  return true;
}

/// Puts the entry into a store: it loads and is saved as it was, or it is removed.
void load(const KernelStore& store, const std::string& entry, bool is_whole) {
  const std::string key = "fuzz";
  const std::string file = store.file_of(key).string();
  std::ofstream(file, std::ios::binary) << entry;
  std::filesystem::permissions(file,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::string damage;
  const auto files = store.load(key, damage);
  promise(files.has_value() == is_whole, "the store loads what unpacks");
  promise(files.has_value() == std::filesystem::exists(file), "what does not load is removed");
  if (!files) {
    promise_one_line(damage);
    return;
  }
  promise(damage.empty(), "an entry that loads is not called damaged");
  store.save(key, *files);
  const auto again = store.load(key, damage);
  promise(again && same(*again, *files), "a saved entry loads as it was");
}

}  // namespace

void fuzz_kernels(const std::string& bytes) {
  static const KernelStore store(fuzz_folder().path("store"));
  load(store, bytes, unpacks(bytes));
  const std::string forged = with_checksum(bytes);
  load(store, forged, unpacks(forged));
}

}  // namespace causticl
