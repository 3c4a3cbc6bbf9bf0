#include "base/text_input.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>

#include "base/input_file.hpp"
#include "base/source_location.hpp"

namespace causticl {
namespace {

constexpr std::size_t block_size = 1 << 20;
// A longer line is no mesh: it bounds what a binary file without line ends can make us hold.
constexpr std::size_t longest_line = 64 << 20;

constexpr char dos_end_of_file = '\x1a';

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == dos_end_of_file;
}

/// Whether a text that begins so has two or four bytes a character: by its byte order mark, or because every
/// other byte of its first two characters is 0.
bool is_wide_text(std::string_view begin) {
  if (begin.size() < 4) return false;
  if (begin.substr(0, 2) == "\xff\xfe" || begin.substr(0, 2) == "\xfe\xff") return true;
  const auto printable = [&](std::size_t i) { return begin[i] >= ' ' && begin[i] <= '~'; };
  const std::string_view wide_mark("\0\0\xfe\xff", 4);
  return begin.substr(0, 4) == wide_mark || (begin[0] == 0 && printable(1) && begin[2] == 0) ||
         (printable(0) && begin[1] == 0 && begin[3] == 0);
}

}  // namespace

TextInput::TextInput(const std::string& file) : file_(file) {
  const InputFile input = open_input(file, "a mesh");
  size_ = input.size;
  const int descriptor = dup(input.descriptor.get());
  handle_.reset(fdopen(descriptor, "rb"));
  if (!handle_) {
    const std::string fault = std::strerror(errno);
    if (descriptor >= 0) close(descriptor);
    fail_file("cannot be read: " + fault);
  }
  std::setvbuf(handle_.get(), nullptr, _IONBF, 0);
  buffer_.resize(block_size);
  skip_byte_order_mark();
}

void TextInput::skip_byte_order_mark() {
  while (end_ < 4 && fill()) continue;
  const std::string_view begin(buffer_.data(), end_);
  if (is_wide_text(begin)) fail_file("is text in UTF-16 or UTF-32; expected UTF-8 or ASCII: save it so");
  if (begin.substr(0, 3) == "\xef\xbb\xbf") begin_ = position_ = 3;
}

bool TextInput::fill() {
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (buffer_.size() - end_ < block_size / 2) buffer_.resize(buffer_.size() * 2);
  const std::size_t count = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, handle_.get());
  if (count == 0 && std::ferror(handle_.get())) fail_file("cannot be read: " + std::string(strerror(errno)));
  end_ += count;
  return count > 0;
}

/// The end of a line that begins `offset` bytes into what is unread: \n, \r\n, or \r alone. A \r that some
/// program has doubled (\r\r\n) counts with it.
std::string_view TextInput::line_end_at(std::size_t offset) {
  while (end_ - begin_ < offset + 3 && fill()) continue;
  const std::string_view rest(buffer_.data() + begin_ + offset,
                              std::min<std::size_t>(3, end_ - begin_ - offset));
  for (const std::string_view end : {"\r\r\n", "\r\n", "\n"}) {
    // Where \r alone ends lines, a \n after it is the first byte of what follows the header.
    if (rest.substr(0, end.size()) == end && (line_end_ != "\r" || end == "\n")) return end;
  }
  return "\r";
}

bool TextInput::line(std::string_view& text) {
  std::size_t length = 0;
  const auto is_end = [](char c) { return c == '\n' || c == '\r'; };
  while (true) {
    const char* begin = buffer_.data() + begin_;
    const char* unread = buffer_.data() + end_;
    length = static_cast<std::size_t>(std::find_if(begin + length, unread, is_end) - begin);
    if (begin + length != unread) break;
    if (length > longest_line) {
      ++line_number_;
      fail("the line is longer than 64 MiB; is this a mesh file?");
    }
    if (!fill()) break;
  }
  const bool has_end = length < end_ - begin_;
  if (!has_end && length == 0) return false;
  std::string_view end;
  if (has_end) end = line_end_at(length);
  if (line_number_ == 0) line_end_ = end;
  text = {buffer_.data() + begin_, length};
  begin_ += length + end.size();
  position_ += length + end.size();
  ++line_number_;
  return true;
}

const unsigned char* TextInput::bytes(std::size_t count) {
  while (end_ - begin_ < count) {
    if (count > remaining() || !fill()) return nullptr;
  }
  const auto* result = reinterpret_cast<const unsigned char*>(buffer_.data() + begin_);
  begin_ += count;
  position_ += count;
  return result;
}

void TextInput::fail_at(std::uint64_t line, const std::string& fault) const {
  SourceLocation{file_, line, ""}.fail(fault);
}

void TextInput::fail_file(const std::string& fault) const { SourceLocation{file_, 0, ""}.fail(fault); }

std::string_view next_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

namespace {

/// What the C library of Windows printed for infinities and for what is no number, with any sign and any
/// number of zeros behind it: 1.#INF, 1.#IND, 1.#QNAN, 1.#SNAN; cut to few digits, 1.#J and 1.#R.
bool is_windows_nan(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  if (word.substr(0, 3) != "1.#") return false;
  word.remove_prefix(3);
  return !word.empty() &&
         (word[0] == 'I' || word[0] == 'Q' || word[0] == 'S' || word[0] == 'J' || word[0] == 'R');
}

}  // namespace

bool parse_number(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars has no plus
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) {
    value = std::numeric_limits<double>::quiet_NaN();
    return is_windows_nan(word);
  }
  if (error == std::errc::result_out_of_range) {
    // Too small or too large for a double; only the sign of the exponent tells.
    const auto exponent = word.find_first_of("eE");
    const bool tiny = exponent == word.npos ? word.find_first_of("123456789") > word.find('.')
                                            : word.substr(exponent + 1).front() == '-';
    value = tiny ? 0 : std::numeric_limits<double>::infinity();
  }
  return true;
}

bool parse_integer(std::string_view word, std::int64_t& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return stop == end && error == std::errc{};
}

std::string no_number(std::string_view word) {
  const auto comma = word.find(',');
  const bool decimal =
      comma != word.npos && comma > 0 && word.find_first_not_of("+-0123456789,eE") == word.npos;
  return quoted(word) + " is not a number" + (decimal ? "; write a decimal point in place of the comma" : "");
}

std::string quoted(std::string_view word) {
  std::string result = "'";
  for (const char c : word.substr(0, 32)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (word.size() > 32 ? "...'" : "'");
}

}  // namespace causticl
