// The values of a PLY file, element by element.
#pragma once

#include "mesh/mesh_ply_header.hpp"

namespace causticl::ply {

/// Reads the records of one element after another, text or binary. Messages name the element and which of
/// them is at fault.
class Records {
 public:
  /// `input` stands behind the header.
  Records(TextInput& input, Format format);

  /// Begins an element. Throws UserError for a count that the rest of the file cannot hold, before memory is
  /// asked for.
  void begin(const Element& element);
  /// Begins the next record of the element; false after the last.
  bool next();
  void end_record();

  /// The next value of a record, as any type.
  double value(Type type);
  /// The number of entries of a list, which follow as values.
  std::uint64_t list_count(const Property& property);
  void skip(const Property& property);

  [[noreturn]] void fail(const std::string& fault) const;

 private:
  TextInput& input_;
  Format format_;
  bool swap_;
  const Element* element_ = nullptr;
  std::uint64_t index_ = 0, begun_ = 0;  // the record being read, and how many were begun
  std::string_view line_;                // what is left of its line (text)
};

/// A number for a message.
std::string shortest(double number);

}  // namespace causticl::ply
