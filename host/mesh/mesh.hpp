// Triangle meshes from OBJ and PLY files.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace causticl {

constexpr std::uint32_t no_index = 0xffffffffu;

/// An indexed triangle mesh. Corner c of triangle t is position[position_index[t][c]], and so on; an index of
/// no_index says that the corner has no normal or no (u, v). Positions are doubles, so that a mesh far from
/// its own origin keeps its digits until its transform has brought it near.
struct Mesh {
  std::string file;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<double, 2>> uvs;
  std::vector<std::array<std::uint32_t, 3>> position_index, normal_index, uv_index;  // one per triangle
  bool has_normals = false;                                                          // in its file
  std::vector<std::string> notes;  // what the reader mended or passed over

  std::size_t triangles() const { return position_index.size(); }
};

/// Reads .obj or .ply (ASCII, binary of either byte order). Polygons are triangulated. Throws UserError with
/// the file, the line (or element of a binary file) and the fault.
Mesh read_mesh(const std::string& file);

/// Fills in unit normals for the corners whose index of a normal is `missing`: the average of the normals of
/// the triangles that share the position (index), weighted by their angle there (Thürmer and Wüthrich 1998).
void add_missing_normals(Mesh& mesh, std::uint32_t missing = no_index);

}  // namespace causticl
