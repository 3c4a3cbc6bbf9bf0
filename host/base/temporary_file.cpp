#include "base/temporary_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <random>
#include <system_error>

namespace causticl {
namespace {

namespace fs = std::filesystem;

const std::string name_begin = ".causticl-", name_end = ".tmp";
constexpr int most_attempts = 100;

[[noreturn]] void fail(int number) { throw std::system_error(number, std::generic_category()); }

std::string new_name() {
  // Numbers of processes repeat: in containers all programs may be number 1.
  static thread_local std::random_device device;
  const std::uint64_t random = std::uint64_t{device()} << 32 | device();
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(random));
  return name_begin + digits + name_end;
}

enum class Lock { taken, held_by_another, unsupported };

Lock try_lock(int descriptor) {
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Lock::taken;
  return errno == EWOULDBLOCK ? Lock::held_by_another : Lock::unsupported;
}

/// Whether the open file has a name still.
bool has_name(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

bool is_old(const fs::path& file) {
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  return !error && fs::file_time_type::clock::now() - written > std::chrono::hours(1);
}

/// A file that may have been left behind, and its lock as long as nobody else has it.
class Candidate {
 public:
  explicit Candidate(const fs::path& file) : file_(file) {
    const std::string name = file.filename().string();
    if (name.starts_with(name_begin) && name.ends_with(name_end))
      descriptor_ = open(file.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY);
  }
  ~Candidate() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;

  bool is_abandoned() const {
    struct stat status {};
    if (descriptor_ < 0 || fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    const Lock lock = try_lock(descriptor_);
    return lock == Lock::taken || (lock == Lock::unsupported && is_old(file_));
  }

 private:
  const fs::path file_;
  int descriptor_ = -1;
};

}  // namespace

int write_all(int descriptor, std::string_view bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  return 0;
}

TemporaryFile::TemporaryFile(const fs::path& folder) {
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    path_ = folder / new_name();
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0 && errno != EEXIST) fail(errno);
    if (descriptor_ < 0) continue;
    // Another process may take the file for an abandoned one before it is locked.
    if (try_lock(descriptor_) != Lock::held_by_another && has_name(descriptor_)) return;
    close(descriptor_);
    unlink(path_.c_str());
  }
  descriptor_ = -1;
  fail(EEXIST);
}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) unlink(path_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

void TemporaryFile::sync() {
  // Some file systems cannot.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
}

void TemporaryFile::write(std::string_view bytes) {
  if (const int fault = write_all(descriptor_, bytes); fault != 0) fail(fault);
}

void TemporaryFile::rename_to(const fs::path& target) {
  // The lock stays until the file has its final name. Some file systems tell of a full disk when a descriptor
  // is closed: any of them will do.
  const int copy = dup(descriptor_);
  if (copy < 0 || close(copy) != 0) fail(errno);
  if (std::rename(path_.c_str(), target.c_str()) != 0) fail(errno);
  path_.clear();
}

void remove_if_abandoned(const fs::path& file) {
  // The lock is held meanwhile: whoever made the file and is about to lock it finds it taken, and makes
  // another.
  const Candidate candidate(file);
  if (candidate.is_abandoned()) unlink(file.c_str());
}

}  // namespace causticl
