#include "mesh/mesh_orientation.hpp"

#include "mesh/mesh_parts.hpp"

namespace causticl {
namespace {

const MeshPart& outermost_around(const std::vector<MeshPart>& parts, const MeshPart& part) {
  const MeshPart* result = &part;
  for (const MeshPart& other : parts)
    if (other.contains(*result) && !result->contains(other)) result = &other;
  return *result;
}

/// The triangles to turn.
std::vector<std::uint32_t> inwards(const std::vector<MeshPart>& parts) {
  std::vector<std::uint32_t> result;
  for (const MeshPart& part : parts) {
    const MeshPart& outermost = outermost_around(parts, part);
    if (outermost.is_inwards() && outermost.closed && part.closed)
      result.insert(result.end(), part.triangles.begin(), part.triangles.end());
  }
  return result;
}

}  // namespace

std::optional<Mesh> turned_outwards(const Mesh& mesh) {
  const std::vector<std::uint32_t> turned_triangles = inwards(mesh_parts(mesh));
  if (turned_triangles.empty()) return {};
  Mesh turned = mesh;
  for (const std::uint32_t t : turned_triangles)
    for (auto* index : {&turned.position_index, &turned.normal_index, &turned.uv_index})
      if (!index->empty()) std::swap((*index)[t][1], (*index)[t][2]);
  return turned;
}

}  // namespace causticl
