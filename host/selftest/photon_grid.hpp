// Photons sorted into the grid by the shipped kernels of pass_grid.cl, and gathered without it.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "opencl/device.hpp"
#include "selftest/vectors.hpp"

namespace causticl {

/// The coarse normals of grid.cl, on the host.
inline uint pack_normal(Vec3 n) {
  const auto component = [](double v) {
    return static_cast<uint>(std::lround(static_cast<float>(v) * 127.0f)) & 0xffu;
  };
  return component(n.x) | component(n.y) << 8 | component(n.z) << 16;
}

/// The three signed components of a packed normal, times 127.
inline std::array<int, 3> normal_components(uint packed) {
  return {static_cast<std::int8_t>(packed), static_cast<std::int8_t>(packed >> 8),
          static_cast<std::int8_t>(packed >> 16)};
}

inline Grid make_grid(Vec3 origin, double cell, uint nx, uint ny, uint nz) {
  if (!std::has_single_bit(nx) || !std::has_single_bit(ny) || !std::has_single_bit(nz))
    throw std::logic_error("a grid has powers of two of buckets along its axes");
  return {to_float4(origin, 1 / cell), nx, ny, nz, 0};
}
inline std::size_t bucket_count(const Grid& grid) { return std::size_t(grid.nx) * grid.ny * grid.nz; }

/// One grid for photons of all kinds.
inline PhotonGrids one_grid(const Grid& grid, std::size_t photons) {
  return {{grid, {}}, {1, 0}, 0, static_cast<uint>(photons)};
}

/// A grid for each kind; the buckets of the second follow those of the first.
inline PhotonGrids two_grids(const Grid& focused, Grid indirect, std::size_t photons) {
  indirect.first_bucket = static_cast<uint>(bucket_count(focused));
  return {{focused, indirect}, {1, 1}, 1, static_cast<uint>(photons)};
}

struct SortedPhotons {
  cl::Buffer starts, sorted;
};

inline std::size_t photon_blocks(std::size_t photons) { return (photons + 7) / 8; }

/// Runs count, sum, scan and move as the photon map does.
inline SortedPhotons sort_photons(Device& device, const cl::Program& program,
                                  const std::vector<Photon>& photons, const PhotonGrids& grids) {
  constexpr std::size_t segment = 256;  // SCAN_SEGMENT
  const std::size_t buckets =
      bucket_count(grids.grid[FOCUSED_PHOTONS]) + bucket_count(grids.grid[INDIRECT_PHOTONS]);
  const std::size_t segments = (buckets + segment - 1) / segment;
  auto in = device.upload(photons, "photons");
  auto counts = device.buffer(buckets * sizeof(cl_uint), "counts"),
       ranks = device.buffer(photons.size() * sizeof(cl_uint), "ranks"),
       sums = device.buffer(segments * sizeof(cl_uint), "sums");
  SortedPhotons result{device.buffer((buckets + 1) * sizeof(cl_uint), "starts"),
                       device.buffer(photon_blocks(photons.size()) * sizeof(PhotonBlock), "sorted")};
  device.clear(counts, buckets * sizeof(cl_uint));
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    if (items == 0) return;
    cl::Kernel kernel(program, name);
    set_arguments(kernel, arguments...);
    device.launch(kernel, items);
  };
  run("count_photons", photons.size(), in, counts, ranks, grids);
  run("sum_segments", segments, counts, sums, cl_uint(buckets));
  run("scan_sums", 1, sums, cl_uint(segments));
  run("scan_segments", segments, counts, sums, result.starts, cl_uint(buckets));
  run("move_photons", 8 * photon_blocks(photons.size()), in, ranks, result.starts, result.sorted, grids);
  device.queue().finish();
  return result;
}

/// A point to gather around; `normal` is packed.
struct GatherPoint {
  float x, y, z;
  uint normal;
};
/// Gathered as two ulong4 on the device.
struct GatherSums {
  std::uint64_t red = 0, green = 0, blue = 0, count = 0;
  std::uint64_t near_red = 0, near_green = 0, near_blue = 0, unused = 0;
  bool operator==(const GatherSums&) const = default;
};

/// Kernels that sort_photons and gather_photons run.
constexpr const char* gather_source = R"(
#include "passes/pass_grid.cl"
#include "passes/pass_gather.cl"
// One gather for each point; w of a point holds its packed normal.
kernel void gather_points(global const float4 *points, global const uint *starts, global const PhotonBlock *sorted,
                          global ulong4 *sums, Grid grid, float radius2, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Gathered sum = gather(grid, starts, sorted, convert_real3(points[i].xyz), as_uint(points[i].w),
                        radius2);
  sums[2 * i] = (ulong4)(sum.red, sum.green, sum.blue, sum.count);
  sums[2 * i + 1] = (ulong4)(sum.near_red, sum.near_green, sum.near_blue, 0);
}
)";

/// The shipped sort and gather, one gather for each point.
inline std::vector<GatherSums> gather_photons(Device& device, const cl::Program& program,
                                              const std::vector<GatherPoint>& points,
                                              const std::vector<Photon>& photons, const Grid& grid,
                                              float radius2) {
  const SortedPhotons map = sort_photons(device, program, photons, one_grid(grid, photons.size()));
  const auto in = device.upload(points, "points"),
             out = device.buffer(points.size() * sizeof(GatherSums), "sums");
  cl::Kernel kernel(program, "gather_points");
  set_arguments(kernel, in, map.starts, map.sorted, out, grid, radius2, static_cast<cl_uint>(points.size()));
  device.launch(kernel, points.size());
  return device.download<GatherSums>(out, points.size());
}

/// All photons tried for one point. The same single-precision comparison of distances as in gather.cl, and
/// normals compared exactly, so that the sums must be equal.
inline GatherSums gather_brute_force(const GatherPoint& p, const std::vector<Photon>& photons,
                                     float radius2) {
  GatherSums sums;
  const auto n = normal_components(p.normal);
  for (const Photon& photon : photons) {
    const float dx = photon.position[0] - p.x, dy = photon.position[1] - p.y, dz = photon.position[2] - p.z;
    const float distance2 = dx * dx + dy * dy + dz * dz;
    if (!(distance2 <= radius2)) continue;
    const auto q = normal_components(photon.normal);
    if (2 * (n[0] * q[0] + n[1] * q[1] + n[2] * q[2]) <= 127 * 127) continue;
    sums.red += photon.flux_rg & 0xffffu;
    sums.green += photon.flux_rg >> 16;
    sums.blue += photon.flux_b;
    ++sums.count;
    if (!(distance2 <= radius2 / 4)) continue;
    sums.near_red += photon.flux_rg & 0xffffu;
    sums.near_green += photon.flux_rg >> 16;
    sums.near_blue += photon.flux_b;
  }
  return sums;
}

}  // namespace causticl
