#include "mesh/mesh_ply_records.hpp"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace causticl::ply {
namespace {

constexpr std::uint64_t most_items = 0xffffffff;  // indices have 32 bits

template <typename T>
double decode(const unsigned char* bytes, bool swap) {
  unsigned char raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = bytes[swap ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

std::string shortest(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", number);
  return text;
}

Records::Records(TextInput& input, Format format)
    : input_(input),
      format_(format),
      swap_((format == Format::big_endian) != (std::endian::native == std::endian::big)) {}

void Records::fail(const std::string& fault) const {
  const std::string message = element_->name + " " + std::to_string(index_) + ": " + fault;
  format_ == Format::ascii ? input_.fail(message) : input_.fail_file(message);
}

void Records::begin(const Element& element) {
  element_ = &element;
  index_ = begun_ = 0;
  std::uint64_t smallest = 0;  // bytes of a record
  for (const Property& property : element.properties)
    smallest += format_ == Format::ascii ? 2 : size_of(property.count_type.value_or(property.type));
  // The last line may lack its end.
  const std::uint64_t room = input_.remaining() + (format_ == Format::ascii ? 1 : 0);
  if (smallest > 0 && element.count > room / smallest)
    input_.fail_file("the header declares " + std::to_string(element.count) + " of element " +
                     quoted(element.name) + ", but only " + std::to_string(input_.remaining()) +
                     " bytes follow; is the file truncated?");
  if ((element.name == "vertex" || element.name == "face") && element.count >= most_items)
    input_.fail_file("the header declares " + std::to_string(element.count) + " of element " +
                     quoted(element.name) + "; expected at most 4294967294");
}

bool Records::next() {
  if (begun_ == element_->count) return false;
  index_ = begun_++;
  if (format_ != Format::ascii) return true;
  do {
    if (!input_.line(line_)) fail("the file ends before it; is it truncated?");
    while (!line_.empty() && (line_.front() == ' ' || line_.front() == '\t')) line_.remove_prefix(1);
  } while (line_.empty());
  return true;
}

void Records::end_record() {
  if (format_ != Format::ascii) return;
  if (const auto word = next_word(line_); !word.empty())
    fail(quoted(word) + " is more than the header declares for it");
}

double Records::value(Type type) {
  if (format_ == Format::ascii) {
    const std::string_view word = next_word(line_);
    double result = 0;
    if (word.empty()) fail("has fewer values than the header declares");
    if (!parse_number(word, result)) fail(no_number(word));
    return result;
  }
  const unsigned char* bytes = input_.bytes(size_of(type));
  if (!bytes) fail("the file ends within it; is it truncated?");
  switch (type) {
    case Type::int8:
      return decode<std::int8_t>(bytes, swap_);
    case Type::uint8:
      return decode<std::uint8_t>(bytes, swap_);
    case Type::int16:
      return decode<std::int16_t>(bytes, swap_);
    case Type::uint16:
      return decode<std::uint16_t>(bytes, swap_);
    case Type::int32:
      return decode<std::int32_t>(bytes, swap_);
    case Type::uint32:
      return decode<std::uint32_t>(bytes, swap_);
    case Type::float32:
      return decode<float>(bytes, swap_);
    case Type::float64:
      return decode<double>(bytes, swap_);
  }
  return 0;
}

std::uint64_t Records::list_count(const Property& property) {
  const double count = value(*property.count_type);
  if (!(count >= 0) || count != std::floor(count))
    fail("list " + quoted(property.name) + " has " + shortest(count) + " entries");
  const std::size_t smallest = format_ == Format::ascii ? 1 : size_of(property.type);
  const std::uint64_t room = format_ == Format::ascii ? line_.size() : input_.remaining();
  const std::uint64_t most = room / smallest;
  if (count > static_cast<double>(most))
    fail("list " + quoted(property.name) + " has " + shortest(count) +
         " entries, more than the rest of the file holds");
  return static_cast<std::uint64_t>(count);
}

void Records::skip(const Property& property) {
  const std::uint64_t count = property.count_type ? list_count(property) : 1;
  for (std::uint64_t i = 0; i < count; ++i) value(property.type);
}

}  // namespace causticl::ply
