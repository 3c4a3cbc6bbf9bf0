// Which way round the triangles of closed meshes are wound.
#pragma once

#include <optional>

#include "mesh/mesh.hpp"

namespace causticl {

/// The mesh with those of its closed parts turned inside out that are wound inwards, clockwise seen from
/// outside, so that their signed volume is negative; nothing where no part is. Parts are connected by
/// edges between the same positions. A part that lies within the bounds of another is turned with it: a
/// cavity is rightly wound against the wall around it.
std::optional<Mesh> turned_outwards(const Mesh& mesh);

}  // namespace causticl
