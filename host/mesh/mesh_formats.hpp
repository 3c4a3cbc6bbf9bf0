// The readers behind read_mesh, one a format.
#pragma once

#include "base/text_input.hpp"
#include "mesh/mesh.hpp"

namespace causticl {

/// Wavefront OBJ: v, vt, vn and f, which may stand before what it uses; free-form geometry, lines, points,
/// groups and materials are passed over.
void read_obj(TextInput& input, Mesh& mesh);

/// Stanford PLY (Turk 1994), ASCII or binary: vertex x y z, nx ny nz, and s t or u v; face vertex_indices,
/// and texcoord, (u, v) for each of its corners. Other elements and properties are passed over.
void read_ply(TextInput& input, Mesh& mesh);

}  // namespace causticl
