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
class TextInput {
 public:
  /// Throws UserError for a missing, unreadable or empty file, for anything but a regular file, and for text
  /// in UTF-16 or UTF-32. Skips the byte order mark of UTF-8.
  explicit TextInput(const std::string& file);

  /// The next line without its end (\n, \r\n, or \r alone); false at the end of the file. Valid until the
  /// next call. Bytes that follow a line begin right after an end of the kind that the first line has.
  bool line(std::string_view& text);

  /// The next `count` bytes, or nullptr if the file ends before. Valid until the next call.
  const unsigned char* bytes(std::size_t count);

  /// Bytes between here and the end of the file.
  std::uint64_t remaining() const { return size_ - position_; }

  /// The number of the line that line() gave last, from 1.
  std::uint64_t line_number() const { return line_number_; }

  /// Throws UserError "file:line: fault", with the line that line() gave last.
  [[noreturn]] void fail(const std::string& fault) const { fail_at(line_number_, fault); }
  [[noreturn]] void fail_at(std::uint64_t line, const std::string& fault) const;
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
  std::string_view line_end_;  // of the first line

  bool fill();
  void skip_byte_order_mark();
  std::string_view line_end_at(std::size_t offset);
};

/// Takes the next word (up to blank space) off the front of `text`; empty at its end. Blank space includes
/// the Ctrl-Z with which DOS programs end a text.
std::string_view next_word(std::string_view& text);

/// The whole word as a number. False if it is none; an overflow gives an infinity. What Windows programs
/// write for no number (-1.#IND, 1.#QNAN, 1.#INF) is read as NaN. Needs no locale.
bool parse_number(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

/// The fault of a word that parse_number() refuses: "'1,5' is not a number", with what to do about it.
std::string no_number(std::string_view word);

/// The word in quotes for a message: shortened, and unprintable bytes replaced.
std::string quoted(std::string_view word);

}  // namespace causticl
