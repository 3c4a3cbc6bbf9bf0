// Files that a test makes, and the messages of what it makes fail.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.hpp"

namespace causticl {

/// A folder of its own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "causticl-test-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
    return path(name);
  }

 private:
  std::filesystem::path path_;
};

/// Of a file; empty where it cannot be read.
inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether a failed output left nothing behind.
inline bool has_no_temporary(const TemporaryFolder& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("")))
    if (entry.path().extension() == ".tmp") return false;
  return true;
}

/// The message of the UserError that `action` throws, with `file` (where given) shortened to its name; empty
/// where it throws none.
template <typename Action>
std::string user_error_of(Action action, const std::string& file = "") {
  try {
    action();
  } catch (const UserError& error) {
    std::string message = error.what();
    if (const auto at = message.find(file); !file.empty() && at != message.npos)
      message.replace(at, file.size(), std::filesystem::path(file).filename().string());
    return message;
  }
  return "";
}

}  // namespace causticl
