#include "base/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "base/error.hpp"

namespace causticl {
namespace {

/// Bytes of the file that were ever written, or at least `enough`: a file system that knows no holes says
/// all.
std::uint64_t written_bytes(int file, std::uint64_t size, std::uint64_t enough) {
  std::uint64_t written = 0;
  for (off_t at = 0; written < enough;) {
    const off_t data = lseek(file, at, SEEK_DATA);
    if (data < 0) return errno == ENXIO ? written : size;
    at = lseek(file, data, SEEK_HOLE);
    if (at < 0) return size;
    written += static_cast<std::uint64_t>(at - data);
  }
  return written;
}

}  // namespace

InputFile open_input(const std::string& file, const std::string& what) {
  const auto fail = [&](const std::string& fault) { throw UserError(file + ": " + fault); };
  struct stat status {};
  // Looked at before it is opened, which may have effects on a device. O_NONBLOCK: a pipe that has taken its
  // place since would be waited for.
  if (stat(file.c_str(), &status) != 0)
    fail(errno == ENOENT || errno == ENOTDIR ? "no such file"
                                             : std::string("cannot be read: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail("is a folder; expected " + what);
  if (!S_ISREG(status.st_mode)) fail("is not a regular file; expected " + what);
  InputFile input{Descriptor(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)), 0};
  if (!input.descriptor || fstat(input.descriptor.get(), &status) != 0)
    fail(std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) fail("is not a regular file; expected " + what);
  input.size = static_cast<std::uint64_t>(status.st_size);
  if (input.size == 0) fail("is empty; expected " + what);

  constexpr std::uint64_t large = 64u << 20;
  if (input.size > large) {
    const std::uint64_t enough = input.size / 16;
    const std::uint64_t written = written_bytes(input.descriptor.get(), input.size, enough);
    if (written < enough)
      fail("is a sparse file: " + bytes_text(written) + " of its " + bytes_text(input.size) +
           " were ever written; expected " + what);
    lseek(input.descriptor.get(), 0, SEEK_SET);
  }
  return input;
}

std::string read_input(const std::string& file, const std::string& what, std::uint64_t limit) {
  const InputFile input = open_input(file, what);
  if (input.size > limit)
    throw UserError(file + ": has " + bytes_text(input.size) + "; expected " + what + " of at most " +
                    bytes_text(limit));
  std::string bytes(static_cast<std::size_t>(input.size), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::read(input.descriptor.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw UserError(file + ": cannot be read: " + std::strerror(errno));
    if (count == 0) bytes.resize(done);  // it was cut meanwhile
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr const char* units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(units); ++unit) value /= 1024;
  char text[32];
  std::snprintf(text, sizeof text, value < 999 ? "%.3g %s" : "%.0f %s", value, units[unit]);
  return text;
}

}  // namespace causticl
