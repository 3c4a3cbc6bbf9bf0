#include <cmath>

#include "fuzz_input.hpp"
#include "mesh/mesh.hpp"

namespace causticl {
namespace {

void promise_indices(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::size_t count,
                     bool may_lack) {
  for (const auto& triangle : triangles)
    for (const std::uint32_t index : triangle)
      promise(index < count || (may_lack && index == no_index), "indices of a mesh are in range");
}

template <typename T, std::size_t N>
void promise_finite(const std::vector<std::array<T, N>>& values) {
  for (const auto& value : values)
    for (const T component : value) promise(std::isfinite(component), "a mesh has finite numbers");
}

void promise_mesh(const Mesh& mesh) {
  promise(mesh.triangles() > 0, "a mesh has triangles");
  promise(mesh.normal_index.size() == mesh.triangles() && mesh.uv_index.size() == mesh.triangles(),
          "every triangle has its normals and texture coordinates");
  promise_indices(mesh.position_index, mesh.positions.size(), false);
  promise_indices(mesh.normal_index, mesh.normals.size(), true);
  promise_indices(mesh.uv_index, mesh.uvs.size(), true);
  promise_finite(mesh.positions);
  promise_finite(mesh.normals);
  promise_finite(mesh.uvs);
}

void read(const std::string& name, const std::string& bytes) {
  const std::string file = fuzz_folder().write(name, bytes);
  read_or_refuse([&] {
    Mesh mesh = read_mesh(file);
    promise_mesh(mesh);
    add_missing_normals(mesh);
    promise_mesh(mesh);
    promise_indices(mesh.normal_index, mesh.normals.size(), false);
  });
}

}  // namespace

void fuzz_obj(const std::string& bytes) { read("fuzz.obj", bytes); }
void fuzz_ply(const std::string& bytes) { read("fuzz.ply", bytes); }

}  // namespace causticl
