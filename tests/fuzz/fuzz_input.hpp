// What the fuzz targets share: a folder for their input, and what every message must be.
#pragma once

#include <string>

#include "base/error.hpp"
#include "fuzz_targets.hpp"
#include "temporary_folder.hpp"

namespace causticl {

/// The folder of this process for inputs; removed at its end.
const TemporaryFolder& fuzz_folder();

/// Throws BrokenPromise unless `holds`.
inline void promise(bool holds, const std::string& what) {
  if (!holds) throw BrokenPromise("broken promise: " + what);
}

/// Throws BrokenPromise unless `text` is one line that is safe on a terminal once it was cleaned as all that
/// is printed.
void promise_one_line(const std::string& text);

/// Throws BrokenPromise for a line that is long, or has characters that a terminal obeys.
void promise_for_terminal(const std::string& line);

/// Calls `read`. Where it throws UserError, its message must be one line; any other exception passes.
template <typename Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const UserError& error) {
    promise_one_line(error.what());
  }
}

}  // namespace causticl
