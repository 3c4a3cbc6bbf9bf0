// The two kinds of failure that end a run, told apart by exit code.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace causticl {

/// The user's input is at fault: exit code 2. The message is one line that says what, where, what was
/// expected and what to do.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The OpenCL device or its driver is at fault: exit code 3.
struct DeviceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Ctrl-C or SIGTERM before there was anything to keep: exit code 130.
struct Interrupted : std::exception {};

}  // namespace causticl
