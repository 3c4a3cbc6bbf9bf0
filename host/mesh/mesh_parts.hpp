// The connected parts of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec.hpp"
#include "mesh/mesh.hpp"

namespace causticl {

/// Triangles that hang together by edges between the same positions, in the order of the mesh.
struct MeshPart {
  std::vector<std::uint32_t> triangles;
  Vec3 low, high;         // bounds
  double volume = 0;      // signed, six times: positive where wound counter-clockwise seen from outside
  double magnitude = 0;   // the sum of the absolute terms of `volume`
  bool connected = true;  // false where it is a whole mesh of too many parts
  bool closed = false;    // each edge is run along as often in one direction as in the other

  // Of a flat sheet with two sides rounding alone decides the sign.
  bool has_volume() const { return volume > 1e-9 * magnitude || volume < -1e-9 * magnitude; }
  bool is_inwards() const { return has_volume() && volume < 0; }
  bool contains(const MeshPart& other) const;
};

/// Each triangle of the mesh is in one part. A mesh of more than 4096 parts counts as one.
std::vector<MeshPart> mesh_parts(const Mesh& mesh);

}  // namespace causticl
