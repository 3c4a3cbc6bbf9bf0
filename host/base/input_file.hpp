// Files that are read as a whole: regular ones, of a size that was looked at before.
#pragma once

#include <cstdint>
#include <string>

#include "base/private_folder.hpp"

namespace causticl {

/// A regular file that is open for reading.
struct InputFile {
  Descriptor descriptor;
  std::uint64_t size = 0;
};

/// Throws UserError "FILE: fault; expected WHAT" for a missing, unreadable or empty file, for anything but a
/// regular file, and for a large one of which nearly nothing was ever written: it would cost what its size
/// says.
InputFile open_input(const std::string& file, const std::string& what);

/// All bytes of the file. Throws UserError also where it has more than `limit`.
std::string read_input(const std::string& file, const std::string& what, std::uint64_t limit);

/// "4 GiB", "1.5 MiB", "341 bytes".
std::string bytes_text(std::uint64_t bytes);

}  // namespace causticl
