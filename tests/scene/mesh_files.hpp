// Mesh files written by a test, and what is asked of the meshes that are read from them.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "base/vec.hpp"
#include "mesh/mesh.hpp"
#include "temporary_folder.hpp"

namespace causticl {

using Triangle = std::array<std::uint32_t, 3>;

inline Mesh read_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return read_mesh(folder.write(name, text));
}

inline std::string message_for(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = folder.write(name, bytes);
  return user_error_of([&] { read_mesh(file); }, file);
}

template <typename Real>
Vec3 to_vec(const std::array<Real, 3>& p) {
  return {p[0], p[1], p[2]};
}

/// The sum of the triangles' vector areas, and the sum of their areas.
inline std::pair<Vec3, double> areas(const Mesh& mesh) {
  Vec3 sum;
  double total = 0;
  for (const auto& [a, b, c] : mesh.position_index) {
    const Vec3 p = to_vec(mesh.positions[a]);
    const Vec3 area = cross(to_vec(mesh.positions[b]) - p, to_vec(mesh.positions[c]) - p) * 0.5;
    sum = sum + area;
    total += length(area);
  }
  return {sum, total};
}

template <typename T>
std::string raw(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace causticl
