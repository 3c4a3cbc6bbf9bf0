#include "mesh/mesh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace causticl {
namespace {

Vec3 to_vec(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

/// For each position the first of those that are equal to it: exporters give every face corners of its own.
std::vector<std::uint32_t> merge_equal(const std::vector<std::array<double, 3>>& positions) {
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return positions[a] != positions[b] ? positions[a] < positions[b] : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

// Of more parts each is compared with no other: the mesh counts as one.
constexpr std::size_t most_parts = 4096;

class PartFinder {
 public:
  explicit PartFinder(const Mesh& mesh) : mesh_(mesh), merged_(merge_equal(mesh.positions)) {}

  std::vector<MeshPart> find() {
    std::vector<MeshPart> parts = connected();
    for (MeshPart& part : parts) {
      measure(part);
      part.closed = has_balanced_edges(part);
    }
    return parts;
  }

 private:
  const Mesh& mesh_;
  const std::vector<std::uint32_t> merged_;

  std::array<std::uint32_t, 3> corners(std::size_t triangle) const {
    const auto& [a, b, c] = mesh_.position_index[triangle];
    return {merged_[a], merged_[b], merged_[c]};
  }

  std::vector<MeshPart> connected() const {
    // A forest of triangles, whose trees are joined by the edges.
    std::vector<std::uint32_t> parent(mesh_.triangles());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t t) {
      while (parent[t] != t) t = parent[t] = parent[parent[t]];
      return t;
    };
    std::vector<std::array<std::uint32_t, 3>> edges;  // lower and higher end, triangle
    edges.reserve(3 * mesh_.triangles());
    for (std::uint32_t t = 0; t < mesh_.triangles(); ++t) {
      const auto ends = corners(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = ends[i], b = ends[(i + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 1; i < edges.size(); ++i)
      if (edges[i][0] == edges[i - 1][0] && edges[i][1] == edges[i - 1][1] && edges[i][0] != edges[i][1])
        parent[root(edges[i][2])] = root(edges[i - 1][2]);
    std::vector<MeshPart> parts;
    std::vector<std::uint32_t> part_of(mesh_.triangles(), no_index);
    for (std::uint32_t t = 0; t < mesh_.triangles(); ++t) {
      std::uint32_t& part = part_of[root(t)];
      if (part == no_index) {
        part = static_cast<std::uint32_t>(parts.size());
        parts.emplace_back();
      }
      parts[part].triangles.push_back(t);
    }
    if (parts.size() <= most_parts) return parts;
    parts.assign(1, {});
    parts[0].connected = false;
    parts[0].triangles.resize(mesh_.triangles());
    std::iota(parts[0].triangles.begin(), parts[0].triangles.end(), 0u);
    return parts;
  }

  void measure(MeshPart& part) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    part.low = {infinity, infinity, infinity};
    part.high = -part.low;
    for (const std::uint32_t t : part.triangles)
      for (const std::uint32_t corner : corners(t))
        for (int axis = 0; axis < 3; ++axis) {
          part.low[axis] = std::min(part.low[axis], mesh_.positions[corner][axis]);
          part.high[axis] = std::max(part.high[axis], mesh_.positions[corner][axis]);
        }
    // About the centre: far from the origin large terms would cancel.
    const Vec3 centre = 0.5 * (part.low + part.high);
    for (const std::uint32_t t : part.triangles) {
      const auto [a, b, c] = corners(t);
      const double term =
          dot(to_vec(mesh_.positions[a]) - centre,
              cross(to_vec(mesh_.positions[b]) - centre, to_vec(mesh_.positions[c]) - centre));
      part.volume += term;
      part.magnitude += std::fabs(term);
    }
  }

  bool has_balanced_edges(const MeshPart& part) const {
    std::vector<std::array<std::uint32_t, 3>> edges;  // lower and higher end, and whether it runs upwards
    edges.reserve(3 * part.triangles.size());
    for (const std::uint32_t t : part.triangles) {
      const auto ends = corners(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = ends[i], b = ends[(i + 1) % 3];
        if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      std::ptrdiff_t balance = 0;
      for (; end < edges.size() && edges[end][0] == edges[begin][0] && edges[end][1] == edges[begin][1];
           ++end)
        balance += edges[end][2] ? 1 : -1;
      if (balance != 0) return false;
    }
    return true;
  }
};

}  // namespace

bool MeshPart::contains(const MeshPart& other) const {
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
    inside = inside && low[axis] <= other.low[axis] && other.high[axis] <= high[axis];
  return inside;
}

std::vector<MeshPart> mesh_parts(const Mesh& mesh) { return PartFinder(mesh).find(); }

}  // namespace causticl
