#include "base/console.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"
#include "base/printable.hpp"

namespace causticl {

void console_start() {
  // open() takes the lowest free descriptor: where the first is closed, it becomes the first, and so on. What
  // is closed stays unusable for output.
  for (int descriptor = 0; descriptor <= STDERR_FILENO; ++descriptor)
    if (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
      [[maybe_unused]] const int opened =
          open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

void print_output(const std::string& text) {
  const std::string clean = printable(text);
  errno = 0;
  const bool written = std::fwrite(clean.data(), 1, clean.size(), stdout) == clean.size();
  if (written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) {
    signal(SIGPIPE, SIG_DFL);
    raise(SIGPIPE);
  }
  throw UserError(std::string("standard output cannot be written: ") + std::strerror(errno));
}

void print_message(std::FILE* stream, const std::string& text) {
  std::string line = "causticl: ";
  line += printable_line(text);
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stream);
  std::fflush(stream);
}

void draw_bar(std::FILE* stream, const std::string& text) {
  std::string line = "\r";
  line += printable_line(text);
  line += "\033[K";
  std::fwrite(line.data(), 1, line.size(), stream);
  std::fflush(stream);
}

void clear_bar(std::FILE* stream) {
  std::fputs("\r\033[K", stream);
  std::fflush(stream);
}

}  // namespace causticl
