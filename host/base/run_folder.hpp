// A folder of this process alone, gone when it ends.
#pragma once

#include <filesystem>
#include <memory>

#include "base/leftovers.hpp"
#include "base/private_folder.hpp"

namespace causticl {

/// A new folder within `parent`, for this user alone, removed with all that is in it by the destructor, or by
/// a signal that ends the process. Those that this user's processes left behind that were killed are removed
/// by the next that makes one beside them.
class RunFolder {
 public:
  /// Throws UserError where none can be made, where another user could put another folder in its place, or
  /// where less than `room` bytes are free.
  RunFolder(const std::filesystem::path& parent, std::uintmax_t room);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor lock_;
  std::unique_ptr<RemovedAtSignal> removed_at_signal_;
};

}  // namespace causticl
