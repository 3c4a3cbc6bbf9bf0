// The header of a PLY file: what its elements are and how they are stored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh_input.hpp"

namespace causticl::ply {

enum class Format { ascii, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a number in a binary file.
std::size_t size_of(Type type);

// What a property means to us: where its value goes.
enum Role { x, y, z, nx, ny, nz, u, v, roles, indices, unused };

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
};

/// Reads up to and including end_header. Throws UserError unless there is an element vertex with x, y and z,
/// and after it any faces with a list vertex_indices or vertex_index.
Header read_header(MeshInput& input);

}  // namespace causticl::ply
