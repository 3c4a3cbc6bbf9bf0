#include "mesh/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <new>

#include "base/spelling.hpp"
#include "base/vec.hpp"
#include "mesh/mesh_formats.hpp"

namespace causticl {
namespace {

template <typename Real>
Vec3 to_vec(const std::array<Real, 3>& p) {
  return {p[0], p[1], p[2]};
}

// The index of corners whose normal is to be computed anew.
constexpr std::uint32_t lost_normal = no_index - 1;

/// Brings normals to unit length. Those that have no direction, since they are 0 or no numbers, are computed
/// from the faces around; where all of the file's are 0, it has none.
void normalize_normals(Mesh& mesh) {
  std::size_t good = 0, zero = 0;
  for (auto& normal : mesh.normals) {
    const double norm = length(to_vec(normal));
    if (norm > 0 && std::isfinite(norm)) {
      for (float& component : normal) component = static_cast<float>(component / norm);
      ++good;
    } else {
      zero += norm == 0;
      normal = {};
    }
  }
  if (good == mesh.normals.size()) return;
  const bool flat = zero == mesh.normals.size();
  for (auto& triangle : mesh.normal_index)
    for (auto& index : triangle)
      if (index != no_index && mesh.normals[index] == std::array<float, 3>{})
        index = flat ? no_index : lost_normal;
  if (flat) return;
  mesh.notes.push_back(std::to_string(mesh.normals.size() - good) +
                       " of its normals are 0 or no numbers: they are computed from the faces around");
  add_missing_normals(mesh, lost_normal);
}

/// A format of meshes and its reader.
struct MeshFormat {
  const char* extension;  // in lower case
  void (*read)(TextInput& input, Mesh& mesh);
};
constexpr MeshFormat mesh_formats[] = {{".obj", read_obj}, {".ply", read_ply}};

/// ".obj or .ply".
std::string known_extensions() {
  std::vector<std::string> extensions;
  for (const MeshFormat& format : mesh_formats) extensions.emplace_back(format.extension);
  return listed(extensions);
}

double angle_between(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace

Mesh read_mesh(const std::string& file) {
  const std::string extension = lower(std::filesystem::path(file).extension().string());
  const auto format = std::find_if(std::begin(mesh_formats), std::end(mesh_formats),
                                   [&](const MeshFormat& each) { return extension == each.extension; });
  TextInput input(file);
  if (format == std::end(mesh_formats))
    input.fail_file("is no mesh by its name; expected the extension " + known_extensions());
  Mesh mesh;
  mesh.file = file;
  try {
    format->read(input, mesh);
  } catch (const std::bad_alloc&) {
    input.fail_file("the mesh does not fit into memory");
  }
  if (mesh.positions.size() >= lost_normal || mesh.normals.size() >= lost_normal ||
      mesh.uvs.size() >= lost_normal)
    input.fail_file("has more than 4294967293 vertices, which indices of 32 bits cannot count");
  if (mesh.triangles() == 0)
    input.fail_file("has no faces (" + std::to_string(mesh.positions.size()) + " vertices); expected a mesh");
  mesh.has_normals = !mesh.normals.empty();
  normalize_normals(mesh);
  return mesh;
}

void add_missing_normals(Mesh& mesh, std::uint32_t missing) {
  mesh.normal_index.resize(mesh.triangles(), {no_index, no_index, no_index});
  std::vector<Vec3> sums(mesh.positions.size());
  std::vector<bool> needed(mesh.positions.size(), false);
  const auto corner = [&](std::size_t t, int c) {
    return to_vec(mesh.positions[mesh.position_index[t][c % 3]]);
  };
  const auto face_normal = [&](std::size_t t) {
    const Vec3 n = cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    const double norm = length(n);
    return norm > 0 ? n / norm : Vec3{};
  };
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const Vec3 normal = face_normal(t);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t p = mesh.position_index[t][c];
      const Vec3 here = corner(t, c);
      sums[p] = sums[p] + angle_between(corner(t, c + 1) - here, corner(t, c + 2) - here) * normal;
      if (mesh.normal_index[t][c] == missing) needed[p] = true;
    }
  }

  const auto append = [&](Vec3 n) {
    mesh.normals.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    return static_cast<std::uint32_t>(mesh.normals.size() - 1);
  };
  std::vector<std::uint32_t> index(mesh.positions.size(), no_index);
  for (std::size_t p = 0; p < sums.size(); ++p)
    if (needed[p] && length(sums[p]) > 1e-6) index[p] = append(normalize(sums[p]));
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& normal = mesh.normal_index[t][c];
      if (normal != missing) continue;
      normal = index[mesh.position_index[t][c]];
      if (normal != no_index) continue;
      // The faces around this position cancel out (two sides of a sheet): each keeps its own normal. A face
      // without area has none, is never hit, and takes any.
      const Vec3 own = face_normal(t);
      normal = append(length(own) > 0 ? own : Vec3{0, 0, 1});
    }
  }
}

}  // namespace causticl
