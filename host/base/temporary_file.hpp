// Files under temporary names that other processes can tell from those that killed ones left behind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace causticl {

/// Writes all of `bytes`. Returns 0, or the error number.
int write_all(int descriptor, std::string_view bytes);

/// A new file in a folder, gone again unless it is renamed. It is locked (flock(2)) until then, and its name
/// is one that no other process uses, whatever its number. Throws std::system_error.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& folder);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view bytes);
  /// Waits until what was written is on the disk.
  void sync();
  void rename_to(const std::filesystem::path& target);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// Removes `file` if it is a TemporaryFile by its name that nobody holds any more. Where the file system has
/// no locks, it must also be an hour old.
void remove_if_abandoned(const std::filesystem::path& file);

}  // namespace causticl
