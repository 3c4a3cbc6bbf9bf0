#include "base/output_file.hpp"

#include <unistd.h>

#include <fcntl.h>
#include <cerrno>
#include <cstring>

#include "base/error.hpp"
#include "base/temporary_file.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& fault) {
  throw UserError(file + ": cannot be written: " + fault);
}

void write_stream(const std::string& file, const std::vector<std::string_view>& pieces) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) fail(file, std::strerror(errno));
  int fault = 0;
  for (const auto& piece : pieces)
    if (fault == 0) fault = write_all(descriptor, piece);
  if (close(descriptor) != 0 && fault == 0) fail(file, std::strerror(errno));
  if (fault != 0) fail(file, std::strerror(fault));
}

/// Writes to a new file in `folder` whose name begins and ends as that of `file`. Returns its path; empty
/// where that fails.
std::string keep_in(const fs::path& folder, const fs::path& file, const std::string& bytes) {
  const std::string extension = file.extension().string();
  std::string name = (folder / (file.stem().string() + "-kept-XXXXXX" + extension)).string();
  const int descriptor = mkostemps(name.data(), static_cast<int>(extension.size()), O_CLOEXEC);
  if (descriptor < 0) return "";
  const bool written = write_all(descriptor, bytes) == 0;
  if (close(descriptor) == 0 && written) return name;
  unlink(name.c_str());
  return "";
}

}  // namespace

bool is_stream(const std::string& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path link_target(const std::string& file) {
  constexpr int most_links = 40;  // as Linux has it
  fs::path path = file;
  for (int links = 0; links <= most_links; ++links) {
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    const fs::path next = fs::read_symlink(path, error);
    if (error) fail(file, error.message());
    path = path.parent_path() / next;  // `next` alone where it is absolute
  }
  fail(file, std::strerror(ELOOP));
}

void check_writable(const std::string& file) {
  if (file.find('\0') != std::string::npos) fail(file, "its name holds a NUL");
  const fs::path target = link_target(file);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code error;
  const auto folder_status = fs::status(folder, error);
  if (!fs::exists(folder_status)) fail(file, "there is no folder " + folder.string() + "; create it first");
  if (!fs::is_directory(folder_status)) fail(file, folder.string() + " is not a folder");
  const auto status = fs::status(target, error);
  if (fs::is_directory(status)) fail(file, "a folder has this name");
  if (error && status.type() != fs::file_type::not_found) fail(file, error.message());
  if (is_stream(file)) {
    if (access(file.c_str(), W_OK) != 0) fail(file, std::strerror(errno));
    return;
  }
  remove_left_half_written(folder);
  // Permissions alone do not tell (root, read-only and full file systems): try.
  try {
    const TemporaryFile probe(folder);
  } catch (const std::system_error& fault) {
    fail(file, fault.code().message());
  }
}

void write_file(const std::string& file, const std::string& bytes) {
  if (is_stream(file)) {
    write_stream(file, {bytes});
    return;
  }
  const fs::path target = link_target(file);
  try {
    TemporaryFile temporary(target.has_parent_path() ? target.parent_path() : fs::path("."));
    temporary.write(bytes);
    temporary.rename_to(target);
  } catch (const std::system_error& fault) {
    fail(file, fault.code().message());
  }
}

void write_file_synced(const std::string& file, const std::vector<std::string_view>& pieces) {
  if (is_stream(file)) {
    write_stream(file, pieces);
    return;
  }
  const fs::path target = link_target(file);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  try {
    TemporaryFile temporary(folder);
    for (const auto& piece : pieces) temporary.write(piece);
    temporary.sync();
    temporary.rename_to(target);
  } catch (const std::system_error& fault) {
    fail(file, fault.code().message());
  }
  // The name is kept by the folder. Where that cannot be synced, the file is none the worse.
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

void write_file_or_keep(const std::string& file, const std::string& bytes) {
  try {
    write_file(file, bytes);
  } catch (const UserError& error) {
    std::error_code no_temporary_folder;
    std::string kept;
    if (!is_stream(file)) kept = keep_in(fs::path(file).parent_path(), file, bytes);
    if (kept.empty()) kept = keep_in(fs::temp_directory_path(no_temporary_folder), file, bytes);
    if (kept.empty()) kept = keep_in(fs::temp_directory_path(no_temporary_folder), "picture", bytes);
    throw UserError(error.what() + (kept.empty()
                                        ? std::string("; there is no room for it elsewhere: it is lost")
                                        : "; it is kept as " + kept));
  }
}

void remove_left_half_written(const fs::path& folder) {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    remove_if_abandoned(entry->path());
}

}  // namespace causticl
