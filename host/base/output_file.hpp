// Files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace causticl {

/// Throws UserError if `file` cannot be written: no folder, no permission, a read-only or full file system, a
/// folder of this name. Removes what killed processes left half written beside it.
void check_writable(const std::string& file);

/// Whether it is a device, pipe or terminal, which is written to as it is: there is nothing to replace.
bool is_stream(const std::string& file);

/// The file that `file` leads to by links, whether it exists or not. Throws UserError where they lead
/// nowhere.
std::filesystem::path link_target(const std::string& file);

/// Writes to a temporary name in the folder of `file`, then renames; a link stays a link, also one to a file
/// that does not exist yet, and a device or pipe is written to directly. Throws UserError.
void write_file(const std::string& file, const std::string& bytes);

/// Writes these pieces one after the other as write_file() does, and has them on the disk before the file
/// gets its name: after a loss of power there is the old file or the new one. Throws UserError.
void write_file_synced(const std::string& file, const std::vector<std::string_view>& pieces);

/// As write_file(), but bytes that find no room there are kept under a new name beside `file`, or else in the
/// temporary folder. Throws UserError, which says where they are.
void write_file_or_keep(const std::string& file, const std::string& bytes);

/// Removes from `folder` what write_file() wrote in processes that were killed: what nobody holds the lock
/// of.
void remove_left_half_written(const std::filesystem::path& folder);

}  // namespace causticl
