// Folders that are to go also where a signal ends the process.
#pragma once

#include <string>

namespace causticl {

/// While it lives, SIGINT, SIGTERM and SIGHUP remove the folder with all that is in it before they end the
/// process, where nothing else was to be done at them.
class RemovedAtSignal {
 public:
  explicit RemovedAtSignal(const std::string& folder);
  ~RemovedAtSignal();
  RemovedAtSignal(const RemovedAtSignal&) = delete;
  RemovedAtSignal& operator=(const RemovedAtSignal&) = delete;

 private:
  int slot_ = -1;
};

/// A handler of signals that removes these folders and ends the process as the signal would.
void end_at_signal(int signal);

/// From here on a driver that calls abort(), as LLVM does where it gets no memory, ends the process with a
/// line and exit code 3, and these folders are removed. Not where abort() is handled already.
void expect_driver_to_abort();

}  // namespace causticl
