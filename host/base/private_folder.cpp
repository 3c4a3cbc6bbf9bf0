#include "base/private_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <random>

#include "base/error.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

constexpr mode_t others_write = S_IWGRP | S_IWOTH;
constexpr const char* temporary_prefix = ".entry-";

[[noreturn]] void fail(const fs::path& path, const std::string& fault) {
  throw UserError(path.string() + ": " + fault);
}

std::string octal(mode_t mode) {
  char text[16];
  std::snprintf(text, sizeof text, "%04o", static_cast<unsigned>(mode & 07777));
  return text;
}

/// In a container the system's files may belong to another number than 0.
bool is_trusted(uid_t owner) {
  static const uid_t system = [] {
    struct stat root {};
    return ::stat("/", &root) == 0 ? root.st_uid : 0;
  }();
  return owner == 0 || owner == system || owner == geteuid();
}

/// Throws unless nobody but this user and the system can change what stands in this folder.
void check_way(const fs::path& path, const struct stat& status) {
  if (!is_trusted(status.st_uid))
    fail(path,
         "it belongs to user " + std::to_string(status.st_uid) + ", who could put another in its place");
  if ((status.st_mode & others_write) && !(status.st_mode & S_ISVTX) && S_ISDIR(status.st_mode))
    fail(path, "other users may write to it (mode " + octal(status.st_mode) +
                   "); expected a folder that only its owner may write to, as after chmod go-w");
}

/// Throws unless this user alone can change what stands in this folder.
void check_own(const fs::path& path, const struct stat& status) {
  if (status.st_uid != geteuid())
    fail(path, "it belongs to user " + std::to_string(status.st_uid) + "; expected a folder of user " +
                   std::to_string(geteuid()));
  if (status.st_mode & others_write)
    fail(path, "other users may write to it (mode " + octal(status.st_mode) +
                   "); expected a folder that only its owner may write to, as after chmod go-w");
}

std::string link_target(int folder, const std::string& name, const fs::path& path) {
  char target[4096];
  const ssize_t size = readlinkat(folder, name.c_str(), target, sizeof target);
  if (size < 0) fail(path, std::string("cannot be read: ") + std::strerror(errno));
  return {target, static_cast<std::size_t>(size)};
}

/// Goes from `/` down a path, one name at a time, by descriptors.
class Walk {
 public:
  explicit Walk(const fs::path& path) {
    go_to_root();
    add(path);
  }

  bool done() const { return names_.empty(); }
  const fs::path& path() const { return path_; }
  int descriptor() const { return folder_.get(); }

  void step() {
    const std::string name = names_.front();
    names_.pop_front();
    if (name.empty() || name == ".") return;
    if (name == "..") {  // of a folder that was reached from there
      enter(name, path_.parent_path());
      return;
    }
    const fs::path next = path_ / name;
    struct stat status {};
    if (fstatat(folder_.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
      if (errno != ENOENT) fail(next, std::string("cannot be opened: ") + std::strerror(errno));
      if (mkdirat(folder_.get(), name.c_str(), 0700) != 0 && errno != EEXIST)
        fail(next, std::string("cannot be made a folder: ") + std::strerror(errno));
    } else if (S_ISLNK(status.st_mode)) {
      check_way(next, status);
      if (++links_ > 40) fail(next, "there are too many links on the way to it");
      const fs::path target = link_target(folder_.get(), name, next);
      if (target.is_absolute()) go_to_root();
      add(target);
      return;
    }
    enter(name, next);
  }

 private:
  std::deque<std::string> names_;  // that are still to go
  Descriptor folder_;
  fs::path path_;
  int links_ = 0;

  void add(const fs::path& path) {
    std::deque<std::string> names;
    for (const auto& part : path.relative_path()) names.push_back(part.string());
    names_.insert(names_.begin(), names.begin(), names.end());
  }

  void go_to_root() {
    path_ = "/";
    folder_ = Descriptor(open("/", O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!folder_) fail(path_, std::string("cannot be opened: ") + std::strerror(errno));
  }

  void enter(const std::string& name, const fs::path& path) {
    Descriptor next(openat(folder_.get(), name.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!next && errno == ENOTDIR) fail(path, "cannot be made a folder: there is a file of this name");
    struct stat status {};
    if (!next || fstat(next.get(), &status) != 0)
      fail(path, std::string("cannot be opened: ") + std::strerror(errno));
    check_way_or_end(path, status);
    folder_ = std::move(next);
    path_ = path;
  }

  /// The last folder is for the caller to judge.
  void check_way_or_end(const fs::path& path, const struct stat& status) const {
    if (!names_.empty()) check_way(path, status);
  }
};

std::string random_name() {
  std::random_device random;
  char text[40];
  std::snprintf(text, sizeof text, "%s%08x%08x", temporary_prefix, random(), random());
  return text;
}

void write_all(int file, const fs::path& path, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) fail(path, std::string("cannot be written: ") + std::strerror(errno));
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

}  // namespace

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) close(descriptor_);
}

OpenFolder open_trusted_folder(const fs::path& folder, FolderUse use) {
  std::error_code error;
  const fs::path absolute = fs::absolute(folder, error);
  if (folder.empty() || error) fail(folder, "is no folder that can be found from here");
  Walk traverse(absolute);
  while (!traverse.done()) traverse.step();
  OpenFolder result{Descriptor(openat(traverse.descriptor(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
                    traverse.path()};
  struct stat status {};
  if (!result.descriptor || fstat(result.descriptor.get(), &status) != 0)
    fail(result.path, std::string("cannot be opened: ") + std::strerror(errno));
  use == FolderUse::own ? check_own(result.path, status) : check_way(result.path, status);
  return result;
}

std::optional<std::vector<std::uint8_t>> read_own_file(int folder, const std::string& name,
                                                       std::uint64_t limit, std::string& fault) {
  // Without O_NONBLOCK a pipe of this name would be waited for.
  const Descriptor file(
      openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat status {};
  if (!file && errno == ENOENT) return {};
  if (!file) {
    fault = errno == ELOOP ? "is a link" : std::string("cannot be read: ") + std::strerror(errno);
  } else if (fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    fault = "is no regular file";
  } else if (status.st_uid != geteuid()) {
    fault = "belongs to user " + std::to_string(status.st_uid);
  } else if (status.st_mode & others_write) {
    fault = "may be written to by other users (mode " + octal(status.st_mode) + ")";
  } else if (static_cast<std::uint64_t>(status.st_size) > limit) {
    fault = "is larger than " + std::to_string(limit >> 20) + " MiB";
  }
  if (!fault.empty()) return {};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

void write_own_file(const OpenFolder& folder, const std::string& name, const std::string& bytes) {
  const int parent = folder.descriptor.get();
  const fs::path path = folder.path / name;
  std::string temporary;
  Descriptor file;
  for (int attempt = 0; !file && attempt < 100; ++attempt) {
    temporary = random_name();
    file = Descriptor(
        openat(parent, temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
    if (!file && errno != EEXIST) break;
  }
  if (!file) fail(path, std::string("cannot be written: ") + std::strerror(errno));
  try {
    write_all(file.get(), path, bytes);
    if (renameat(parent, temporary.c_str(), parent, name.c_str()) != 0)
      fail(path, std::string("cannot be written: ") + std::strerror(errno));
  } catch (...) {
    unlinkat(parent, temporary.c_str(), 0);
    throw;
  }
}

bool is_own_temporary(const std::string& name) { return name.starts_with(temporary_prefix); }

}  // namespace causticl
