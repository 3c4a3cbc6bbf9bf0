// Compiled kernels on disk, from one run to the next.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/private_folder.hpp"
#include "opencl/kernel_entry.hpp"

namespace causticl {

/// A folder with an entry a program, found by a text that says all that its kernels depend on. An entry
/// appears whole or not at all, and is used only if its checksum holds and nobody but this user can have
/// written it. Any number of processes may use one folder.
class KernelStore {
 public:
  static constexpr std::uint64_t default_limit = 256u << 20;

  /// `limit`: bytes of all entries, above which those go that were not used for longest. Throws UserError
  /// where other users could change what is in the folder, and where it cannot be made.
  explicit KernelStore(const std::filesystem::path& folder, std::uint64_t limit = default_limit);

  /// The entry of `key`; none where there is none. One that is damaged, or that others can have written, is
  /// removed and described in `damage`.
  std::optional<KernelFiles> load(const std::string& key, std::string& damage) const;

  /// Throws UserError where the folder cannot be written to.
  void save(const std::string& key, const KernelFiles& files) const;

  std::filesystem::path file_of(const std::string& key) const;

  /// Without links.
  const std::filesystem::path& path() const { return folder_.path; }

 private:
  OpenFolder folder_;
  std::uint64_t limit_;
  void remove_oldest() const;
};

}  // namespace causticl
