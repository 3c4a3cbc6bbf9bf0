// The header of a PLY file: what its elements are and how they are stored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text_input.hpp"

namespace causticl::ply {

enum class Format { ascii, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a number in a binary file.
std::size_t size_of(Type type);

// What a property means to us: where its value goes.
enum Role { x, y, z, nx, ny, nz, u, v, roles, indices, corner_uvs, texture_number, unused };

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count_type;  // of a list
  Role role = unused;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has(Role role) const {
    for (const Property& property : properties)
      if (property.role == role) return true;
    return false;
  }
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  std::uint64_t vertices = 0;
  bool has_corner_uvs = false;  // the faces
};

/// Reads up to and including end_header. Throws UserError unless there is an element vertex with x, y and z,
/// and any faces have a list of vertices: vertex_indices, vertex_index, or the only list that can be one.
Header read_header(TextInput& input);

}  // namespace causticl::ply
