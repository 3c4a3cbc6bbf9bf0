#include "mesh_input.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <limits>

#include "error.hpp"
#include "input_file.hpp"

namespace causticl {
namespace {

constexpr std::size_t block_size = 1 << 20;
// A longer line is no mesh: it bounds what a binary file without line ends can make us hold.
constexpr std::size_t longest_line = 64 << 20;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

MeshInput::MeshInput(const std::string& file) : file_(file) {
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
}

bool MeshInput::fill() {
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

bool MeshInput::line(std::string_view& text) {
  std::size_t searched = 0;
  const char* newline = nullptr;
  while (true) {
    const char* start = buffer_.data() + begin_ + searched;
    const std::size_t unsearched = end_ - begin_ - searched;
    newline = unsearched ? static_cast<const char*>(std::memchr(start, '\n', unsearched)) : nullptr;
    if (newline) break;
    searched = end_ - begin_;
    if (searched > longest_line) {
      ++line_number_;
      fail("the line is longer than 64 MiB; is this a mesh file?");
    }
    if (!fill()) break;
  }
  const std::size_t length = newline ? newline - (buffer_.data() + begin_) : end_ - begin_;
  if (!newline && length == 0) return false;
  text = {buffer_.data() + begin_, length};
  begin_ += length + (newline ? 1 : 0);
  position_ += length + (newline ? 1 : 0);
  ++line_number_;
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return true;
}

const unsigned char* MeshInput::bytes(std::size_t count) {
  while (end_ - begin_ < count) {
    if (count > remaining() || !fill()) return nullptr;
  }
  const auto* result = reinterpret_cast<const unsigned char*>(buffer_.data() + begin_);
  begin_ += count;
  position_ += count;
  return result;
}

void MeshInput::fail(const std::string& fault) const {
  throw UserError(file_ + ":" + std::to_string(line_number_) + ": " + fault);
}

void MeshInput::fail_file(const std::string& fault) const { throw UserError(file_ + ": " + fault); }

std::string_view next_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

bool parse_number(std::string_view word, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars has no plus
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return false;
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

std::string quoted(std::string_view word) {
  std::string result = "'";
  for (const char c : word.substr(0, 32)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (word.size() > 32 ? "...'" : "'");
}

}  // namespace causticl
