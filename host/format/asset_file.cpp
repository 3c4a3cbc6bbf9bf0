#include "format/asset_file.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>

namespace causticl {
namespace {

/// File systems whose files are made by the kernel as they are read.
constexpr long kernel_file_systems[] = {PROC_SUPER_MAGIC, SYSFS_MAGIC,        DEBUGFS_MAGIC,
                                        TRACEFS_MAGIC,    CGROUP_SUPER_MAGIC, CGROUP2_SUPER_MAGIC,
                                        SECURITYFS_MAGIC};

std::string fault_of_mode(mode_t mode) {
  if (S_ISREG(mode)) return "";
  if (S_ISDIR(mode)) return "that is a directory";
  if (S_ISFIFO(mode)) return "that is a pipe";
  if (S_ISSOCK(mode)) return "that is a socket";
  return "that is a device";
}

}  // namespace

std::string asset_fault(const std::filesystem::path& file) {
  struct stat status {};
  // Opening some devices has effects: their kind is asked for first, and again of what was opened.
  if (stat(file.c_str(), &status) != 0) return "";
  if (std::string fault = fault_of_mode(status.st_mode); !fault.empty()) return fault;
  const int descriptor = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return "";  // whoever reads it says why that fails
  std::string fault;
  struct statfs system {};
  if (fstat(descriptor, &status) == 0) fault = fault_of_mode(status.st_mode);
  if (fault.empty() && fstatfs(descriptor, &system) == 0) {
    const long kind = static_cast<long>(system.f_type);
    if (std::find(std::begin(kernel_file_systems), std::end(kernel_file_systems), kind) !=
        std::end(kernel_file_systems))
      fault = "that is a file of the kernel";
  }
  close(descriptor);
  return fault;
}

}  // namespace causticl
