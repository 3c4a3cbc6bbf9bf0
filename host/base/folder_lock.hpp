// A folder that one process at a time may work in.
#pragma once

#include <string>

namespace causticl {

/// Holds flock(2) on a folder from lock() until it is destroyed or its process ends, however that comes
/// about.
class FolderLock {
 public:
  FolderLock() = default;
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// False where another process holds it. Where the file system has no locks, true.
  bool lock(const std::string& folder);

 private:
  int descriptor_ = -1;
};

}  // namespace causticl
