// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace causticl {

/// Throws UserError if `file` cannot be written: no folder, no permission, a read-only or full file system, a
/// folder of this name.
void check_writable(const std::string& file);

/// Writes to a temporary name in the folder of `file`, then renames; a link stays a link, and a device or
/// pipe is written to directly. Throws UserError.
void write_file(const std::string& file, const std::string& bytes);

/// Whether `file` is half of what write_file() wrote in a process that was killed: by its name, and because
/// no live one takes the hour that has passed since.
bool is_left_half_written(const std::filesystem::path& file);

}  // namespace causticl
