// Photons sorted into the grid by the shipped kernels of pass_grid.cl, for tests.
#pragma once

#include <array>

#include "vector_inputs.hpp"

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

inline Grid make_grid(Vec3 origin, double cell, uint nx, uint ny, uint nz, std::size_t photons) {
  return {to_float4(origin, 1 / cell), nx, ny, nz, static_cast<uint>(photons)};
}
inline std::size_t bucket_count(const Grid& grid) { return std::size_t(grid.nx) * grid.ny * grid.nz; }

struct SortedPhotons {
  cl::Buffer starts, sorted;
};

inline std::size_t sorted_stride(std::size_t photons) { return (photons + 15) & ~std::size_t(7); }

/// Runs count, sum, scan and move as the photon map does.
inline SortedPhotons sort_photons(cl::Program& program, const std::vector<Photon>& photons,
                                  const Grid& grid) {
  constexpr std::size_t segment = 256;  // SCAN_SEGMENT
  Device& device = test_device();
  const std::size_t buckets = bucket_count(grid), segments = (buckets + segment - 1) / segment;
  auto in = device.upload(photons, "photons");
  auto cursors = device.buffer(buckets * sizeof(cl_uint), "cursors"),
       sums = device.buffer(segments * sizeof(cl_uint), "sums");
  SortedPhotons result{device.buffer((buckets + 1) * sizeof(cl_uint), "starts"),
                       device.buffer(sorted_stride(photons.size()) * sizeof(Photon), "sorted")};
  device.clear(cursors, buckets * sizeof(cl_uint));
  const auto run = [&](const char* name, std::size_t items, const auto&... arguments) {
    if (items == 0) return;
    cl::Kernel kernel(program, name);
    set_arguments(kernel, arguments...);
    device.launch(kernel, items);
  };
  run("count_photons", photons.size(), in, cursors, grid);
  run("sum_segments", segments, cursors, sums, cl_uint(buckets));
  run("scan_sums", 1, sums, cl_uint(segments));
  run("scan_segments", segments, cursors, sums, result.starts, cl_uint(buckets));
  run("move_photons", photons.size(), in, cursors, result.sorted, grid);
  device.queue().finish();
  return result;
}

}  // namespace causticl
