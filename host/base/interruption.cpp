#include "base/interruption.hpp"

#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "base/leftovers.hpp"

namespace causticl {
namespace {

volatile sig_atomic_t requested = 0, silent = 0;

/// Whether the process was started to ignore SIGHUP, as nohup(1) does. Asked before a driver can install a
/// handler of its own.
const bool hangup_ignored = [] {
  struct sigaction inherited {};
  return sigaction(SIGHUP, nullptr, &inherited) == 0 && inherited.sa_handler == SIG_IGN;
}();

void remember(int signal_number) {
  const int previous_errno = errno;
  // A terminal that goes away hangs up twice: itself, and through its shell. The picture is still to be
  // written.
  if (signal_number == SIGHUP && requested) return;
  requested = 1;
  signal(SIGINT, end_at_signal);
  signal(SIGTERM, end_at_signal);
  // The line break leaves a progress bar, or the terminal's ^C, alone on its line.
  constexpr char line_break[] = "\n",
                 text[] = "causticl: interrupted: finishing the pass, then writing (again to stop at once)\n";
  if (!silent) {
    if (isatty(STDERR_FILENO)) [[maybe_unused]]
      const auto ignored = write(STDERR_FILENO, line_break, sizeof line_break - 1);
    [[maybe_unused]] const auto ignored = write(STDERR_FILENO, text, sizeof text - 1);
  }
  errno = previous_errno;
}

}  // namespace

void interruption_listen(bool quiet) {
  silent = quiet;
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;  // no system call of a driver or of a file is to fail for it
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  if (hangup_ignored)
    signal(SIGHUP, SIG_IGN);
  else
    sigaction(SIGHUP, &action, nullptr);
}

bool interruption_requested() { return requested != 0; }

}  // namespace causticl
