// Files that appear whole or not at all.
#pragma once

#include <string>

namespace causticl {

/// Throws UserError if `file` cannot be written: no folder, no permission, a read-only or full file system, a
/// folder of this name.
void check_writable(const std::string& file);

/// Writes to a temporary name in the folder of `file`, then renames; a link stays a link, and a device or
/// pipe is written to directly. Throws UserError.
void write_file(const std::string& file, const std::string& bytes);

}  // namespace causticl
