// Folders that nobody else can have put anything into, or another folder in the place of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace causticl {

/// A file descriptor, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int descriptor = -1) : descriptor_(descriptor) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  int get() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_;
};

/// An open folder, and its path without links.
struct OpenFolder {
  Descriptor descriptor;
  std::filesystem::path path;
};

enum class FolderUse {
  own,    // of this user, and no other may write to it
  parent  // others may make things of their own in it, as in /tmp, but not replace ours
};

/// Opens a folder, with all of it that is missing made for this user alone. It and every folder and link on
/// the way to it must belong to this user or to the system (who owns `/`), and no other user may write to
/// them; but on the way a folder may have the sticky bit. Throws UserError "FOLDER: why".
OpenFolder open_trusted_folder(const std::filesystem::path& folder, FolderUse use);

/// The bytes of a file in a folder, if it is a regular file of this user that no other may write to, and has
/// at most `limit` bytes. Where it is none of these, nothing, with the reason in `fault`; where there is no
/// such file, nothing and no reason.
std::optional<std::vector<std::uint8_t>> read_own_file(int folder, const std::string& name,
                                                       std::uint64_t limit, std::string& fault);

/// Writes a file for this user alone: under a new name, which then takes the place of `name`. Throws
/// UserError "PATH: cannot be written: why".
void write_own_file(const OpenFolder& folder, const std::string& name, const std::string& bytes);

/// Whether write_own_file() writes to files of this name on their way.
bool is_own_temporary(const std::string& name);

}  // namespace causticl
