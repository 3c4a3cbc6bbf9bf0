#include "base/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "causticl-run-";
constexpr const char* lock_name = "in_use";

/// Files and folders that the kernels of one run become, generously.
constexpr fsfilcnt_t files_of_a_run = 1000;

/// Whether this user made `name`, nobody holds its lock, and nobody can be about to take it.
bool is_left_behind(int parent, const std::string& name) {
  struct stat status {};
  if (fstatat(parent, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISDIR(status.st_mode) ||
      status.st_uid != geteuid() || status.st_mtim.tv_sec > std::time(nullptr) - 60)
    return false;
  const Descriptor folder(openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  const Descriptor lock(
      openat(folder.get(), lock_name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!lock) return folder && errno == ENOENT;
  return flock(lock.get(), LOCK_EX | LOCK_NB) == 0;
}

void remove_left_behind(const OpenFolder& parent) {
  std::error_code error;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(parent.path, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && is_left_behind(parent.descriptor.get(), name))
      folders.push_back(entry.path());
  }
  for (const auto& folder : folders) fs::remove_all(folder, error);
}

/// Throws where there are fewer bytes or files left than that.
void check_room(const OpenFolder& parent, std::uintmax_t room) {
  struct statvfs space {};
  if (fstatvfs(parent.descriptor.get(), &space) != 0) return;
  const std::uintmax_t left = std::uintmax_t{space.f_bavail} * space.f_frsize;
  if (left < room)
    throw UserError(parent.path.string() + ": there are " + std::to_string(left >> 20) +
                    " MiB left, and kernels take up to " + std::to_string(room >> 20));
  // Some file systems have no number of files, and say 0 of 0.
  if (space.f_files > 0 && space.f_favail < files_of_a_run)
    throw UserError(parent.path.string() + ": there is room for " + std::to_string(space.f_favail) +
                    " files, and kernels take up to " + std::to_string(files_of_a_run));
}

}  // namespace

RunFolder::RunFolder(const fs::path& parent_path, std::uintmax_t room) {
  const OpenFolder parent = open_trusted_folder(parent_path, FolderUse::parent);
  check_room(parent, room);
  std::error_code error;
  try {
    remove_left_behind(parent);
  } catch (const fs::filesystem_error&) {
    // Another process removes the same ones.
  }
  std::string name = (parent.path / (std::string(prefix) + "XXXXXX")).string();
  if (!mkdtemp(name.data()))
    throw UserError(parent.path.string() + ": cannot be written to: " + std::strerror(errno));
  path_ = name;
  removed_at_signal_ = std::make_unique<RemovedAtSignal>(name);
  const Descriptor folder(open(name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  lock_ = Descriptor(openat(folder.get(), lock_name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (lock_ && flock(lock_.get(), LOCK_EX | LOCK_NB) == 0) return;
  // Without the lock another process would take the folder for one left behind.
  const std::string fault = std::strerror(errno);
  fs::remove_all(path_, error);
  throw UserError(path_.string() + ": cannot be locked: " + fault);
}

RunFolder::~RunFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

}  // namespace causticl
