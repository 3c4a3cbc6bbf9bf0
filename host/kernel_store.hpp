// Compiled kernels on disk, from one run to the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace causticl {

/// A file that a driver made of a program: its path in the driver's folder, or any name that the caller
/// knows.
struct KernelFile {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// What was compiled of one program.
using KernelFiles = std::vector<KernelFile>;

/// A folder with an entry a program, found by a text that says all that its kernels depend on. An entry
/// appears whole or not at all, and is used only if its checksum holds. Any number of processes may use one
/// folder.
class KernelStore {
 public:
  static constexpr std::uint64_t default_limit = 256u << 20;

  /// `limit`: bytes of all entries, above which those go that were not used for longest.
  explicit KernelStore(std::filesystem::path folder, std::uint64_t limit = default_limit);

  /// The entry of `key`; none where there is none. One that is damaged is removed and described in `damage`.
  std::optional<KernelFiles> load(const std::string& key, std::string& damage) const;

  /// Throws UserError where the folder cannot be written to.
  void save(const std::string& key, const KernelFiles& files) const;

  std::filesystem::path file_of(const std::string& key) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t limit_;
  void remove_oldest() const;
};

}  // namespace causticl
