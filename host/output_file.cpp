#include "output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "error.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

const std::string temporary_prefix = ".causticl-", temporary_extension = ".tmp";

[[noreturn]] void fail(const std::string& file, const std::string& fault) {
  throw UserError(file + ": cannot be written: " + fault);
}

/// The file that `file` leads to: a link stays, and what it points to is replaced.
fs::path target_of(const std::string& file) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(file, error);
  return error ? fs::path(file) : target;
}

/// A device, pipe or terminal, which is written to as it is: there is nothing to replace.
bool is_stream(const std::string& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write_all(int descriptor, const std::string& file, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) fail(file, std::strerror(errno));
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

void write_stream(const std::string& file, const std::string& bytes) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) fail(file, std::strerror(errno));
  try {
    write_all(descriptor, file, bytes);
  } catch (...) {
    close(descriptor);
    throw;
  }
  if (close(descriptor) != 0) fail(file, std::strerror(errno));
}

/// A new file in the folder of `file`, gone again unless it is renamed to `file`.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& file) : file_(file), target_(target_of(file)) {
    static std::atomic<unsigned> count{0};
    const std::string name =
        temporary_prefix + std::to_string(getpid()) + "-" + std::to_string(count++) + temporary_extension;
    path_ = target_.parent_path() / name;
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(file, std::strerror(errno));
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!path_.empty()) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(const std::string& bytes) { write_all(descriptor_, file_, bytes); }

  void rename_to_target() {
    const int result = close(descriptor_);
    descriptor_ = -1;
    if (result != 0) fail(file_, std::strerror(errno));
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail(file_, std::strerror(errno));
    path_.clear();
  }

 private:
  std::string file_;
  fs::path target_, path_;
  int descriptor_ = -1;
};

}  // namespace

void check_writable(const std::string& file) {
  const fs::path folder = fs::path(file).has_parent_path() ? fs::path(file).parent_path() : fs::path(".");
  std::error_code error;
  const auto folder_status = fs::status(folder, error);
  if (!fs::exists(folder_status)) fail(file, "there is no folder " + folder.string() + "; create it first");
  if (!fs::is_directory(folder_status)) fail(file, folder.string() + " is not a folder");
  const auto status = fs::status(file, error);
  if (fs::is_directory(status)) fail(file, "a folder has this name");
  if (error && status.type() != fs::file_type::not_found) fail(file, error.message());
  if (is_stream(file)) {
    if (access(file.c_str(), W_OK) != 0) fail(file, std::strerror(errno));
    return;
  }
  // Permissions alone do not tell (root, read-only and full file systems): try.
  const TemporaryFile probe(file);
}

void write_file(const std::string& file, const std::string& bytes) {
  if (is_stream(file)) {
    write_stream(file, bytes);
    return;
  }
  TemporaryFile temporary(file);
  temporary.write(bytes);
  temporary.rename_to_target();
}

bool is_left_half_written(const fs::path& file) {
  if (!file.filename().string().starts_with(temporary_prefix) || file.extension() != temporary_extension)
    return false;
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  return !error && fs::file_time_type::clock::now() - written > std::chrono::hours(1);
}

}  // namespace causticl
