#include "run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "error.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "causticl-run-";
constexpr const char* lock_name = "in_use";

/// Whether nobody holds the lock of `folder`, and nobody can be about to take it.
bool is_left_behind(const fs::path& folder) {
  std::error_code error;
  const auto changed = fs::last_write_time(folder, error);
  if (error || fs::file_time_type::clock::now() - changed < std::chrono::minutes(1)) return false;
  const int lock = open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC);
  if (lock < 0) return errno == ENOENT;
  const bool free = flock(lock, LOCK_EX | LOCK_NB) == 0;
  close(lock);
  return free;
}

void remove_left_behind(const fs::path& parent) {
  std::error_code error;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(parent, error))
    if (entry.path().filename().string().starts_with(prefix) && is_left_behind(entry.path()))
      folders.push_back(entry.path());
  for (const auto& folder : folders) fs::remove_all(folder, error);
}

}  // namespace

RunFolder::RunFolder(const fs::path& parent, std::uintmax_t room) {
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) throw UserError(parent.string() + ": cannot be made a folder: " + error.message());
  const auto space = fs::space(parent, error);
  if (!error && space.available < room)
    throw UserError(parent.string() + ": there are " + std::to_string(space.available >> 20) +
                    " MiB left, and kernels take up to " + std::to_string(room >> 20));
  try {
    remove_left_behind(parent);
  } catch (const fs::filesystem_error&) {
    // Another process removes the same ones.
  }
  std::string name = (parent / (std::string(prefix) + "XXXXXX")).string();
  if (!mkdtemp(name.data()))
    throw UserError(parent.string() + ": cannot be written to: " + std::strerror(errno));
  path_ = name;
  lock_ = open((path_ / lock_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  // Without the lock another process would take the folder for one left behind.
  const std::string fault = std::strerror(errno);
  if (lock_ >= 0) close(lock_);
  fs::remove_all(path_, error);
  throw UserError(path_.string() + ": cannot be locked: " + fault);
}

RunFolder::~RunFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  close(lock_);
}

}  // namespace causticl
