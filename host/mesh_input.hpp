// What the readers of mesh files share: a file read in blocks, numbers in text, and messages.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace causticl {

/// A file that is read once from front to end, by lines or by bytes, in blocks of 1 MiB.
class MeshInput {
 public:
  /// Throws UserError for a missing, unreadable or empty file, and for anything but a regular file.
  explicit MeshInput(const std::string& file);

  /// The next line without its end (\n or \r\n); false at the end of the file. Valid until the next call.
  bool line(std::string_view& text);

  /// The next `count` bytes, or nullptr if the file ends before. Valid until the next call.
  const unsigned char* bytes(std::size_t count);

  /// Bytes between here and the end of the file.
  std::uint64_t remaining() const { return size_ - position_; }

  /// Throws UserError "file:line: fault", with the line that line() gave last.
  [[noreturn]] void fail(const std::string& fault) const;
  /// Throws UserError "file: fault".
  [[noreturn]] void fail_file(const std::string& fault) const;

 private:
  struct Close {
    void operator()(std::FILE* handle) const { std::fclose(handle); }
  };
  std::string file_;
  std::unique_ptr<std::FILE, Close> handle_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // what of the buffer is read but not yet given out
  std::uint64_t size_ = 0, position_ = 0;
  std::uint64_t line_number_ = 0;

  bool fill();
};

/// Takes the next word (up to blank space) off the front of `text`; empty at its end.
std::string_view next_word(std::string_view& text);

/// The whole word as a number. False if it is none; an overflow gives an infinity. Needs no locale.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

/// The word in quotes for a message: shortened, and unprintable bytes replaced.
std::string quoted(std::string_view word);

}  // namespace causticl
