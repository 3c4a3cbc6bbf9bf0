#include <array>
#include <cstring>

#include "selftest/photon_grid.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "passes/pass_grid.cl"
kernel void normals(global const float4 *in, global uint *packed, global float4 *unpacked, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  packed[i] = normal_pack(in[i].xyz);
  unpacked[i] = (float4)(normal_unpack(packed[i]), 0);
}
kernel void coordinates(global const float *in, global int *cubes, global uint *wrapped, uint count, float origin,
                        float inverse_cell, uint n) {
  uint i = get_global_id(0);
  if (i >= count) return;
  cubes[i] = grid_coordinate(in[i], origin, inverse_cell);
  wrapped[i] = grid_wrap(cubes[i], n);
}
)";

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

constexpr double largest_cube = 2147483520;  // the largest int that is a float

/// The bucket of a photon, in the device's arithmetic: the difference and the product round once each.
std::size_t bucket_of(const Grid& grid, const Photon& photon) {
  const float origin[3] = {grid.origin.x, grid.origin.y, grid.origin.z};
  const uint n[3] = {grid.nx, grid.ny, grid.nz};
  std::size_t bucket = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const float scaled = (photon.position[axis] - origin[axis]) * grid.origin.w;
    const double cube = std::clamp(std::floor(static_cast<double>(scaled)), -2147483648.0, largest_cube);
    const auto wrapped = static_cast<long long>(cube) % n[axis];
    bucket = bucket * n[axis] + static_cast<std::size_t>(wrapped < 0 ? wrapped + n[axis] : wrapped);
  }
  return bucket;
}

using Words = std::array<uint, sizeof(Photon) / sizeof(uint)>;

}  // namespace

TEST_CASE("the counting sort gives exact prefix sums and a permutation, whatever the table and work-group") {
  RandomInputs random(71);
  struct Case {
    uint nx, ny, nz;
    std::size_t photons, local;
    double spread;
  };
  for (const Case c :
       {Case{1, 1, 1, 5000, 64, 1}, Case{8, 8, 8, 40000, 32, 10}, Case{32, 16, 16, 100000, 256, 3},
        Case{64, 64, 64, 200000, 64, 1}, Case{4, 8, 2, 20000, 1, 1e4}, Case{256, 1, 1, 1000, 64, 1},
        Case{512, 1, 1, 1000, 64, 1}, Case{2, 1, 128, 1, 64, 1}, Case{4, 4, 4, 0, 64, 1},
        Case{64, 64, 64, 700000, 64, 0}}) {
    CAPTURE(c.nx, c.ny, c.nz, c.photons);
    std::vector<Photon> photons(c.photons);
    for (auto& photon : photons) {
      for (float& x : photon.position) x = static_cast<float>(random.uniform(-c.spread, c.spread));
      photon.normal = static_cast<uint>(random.engine());
      photon.flux_rg = static_cast<uint>(random.engine());
      photon.flux_b = static_cast<uint>(random.engine());
    }
    const Grid grid = make_grid({0.1, -0.2, 0.3}, 0.05, c.nx, c.ny, c.nz);
    const WorkGroupSize restored;
    test_device().set_local_size(c.local);
    const SortedPhotons map = sort_photons(test_device(), program(), photons, one_grid(grid, photons.size()));
    const auto starts = test_device().download<uint>(map.starts, bucket_count(grid) + 1);

    std::vector<uint> expected(bucket_count(grid) + 1);
    for (const auto& photon : photons) ++expected[bucket_of(grid, photon) + 1];
    for (std::size_t b = 1; b < expected.size(); ++b) expected[b] += expected[b - 1];
    CHECK(starts == expected);

    // The photons of each bucket, as a set: compared bucket after bucket in sorted order.
    const auto blocks = test_device().download<PhotonBlock>(map.sorted, photon_blocks(c.photons));
    std::vector<std::pair<std::size_t, Words>> in, out;
    for (const auto& photon : photons) {
      Words w;
      std::memcpy(w.data(), &photon, sizeof photon);
      in.push_back({bucket_of(grid, photon), w});
    }
    std::size_t bucket = 0;
    for (std::size_t i = 0; i < c.photons; ++i) {
      while (expected[bucket + 1] <= i) ++bucket;
      const PhotonBlock& block = blocks[i / 8];
      const std::size_t lane = i % 8;
      const Photon photon{{block.position[0][lane], block.position[1][lane], block.position[2][lane]},
                          block.normal[lane],
                          block.flux_rg[lane],
                          block.flux_b[lane]};
      Words w;
      std::memcpy(w.data(), &photon, sizeof photon);
      out.push_back({bucket, w});
    }
    std::sort(in.begin(), in.end());
    std::sort(out.begin(), out.end());
    CHECK((in == out));
  }
}

TEST_CASE("cubes are cut by the floor and wrapped into the table, also below zero and past any integer") {
  RandomInputs random(72);
  std::vector<float> in{0.0f,    -0.0f,    1e-30f, -1e-30f,  1e30f,    -1e30f,
                        3.4e38f, -3.4e38f, NAN,    INFINITY, -INFINITY};
  while (in.size() < (1 << 20)) {
    const double reach = std::pow(10, random.uniform(-3, 9));
    in.push_back(static_cast<float>(random.uniform(-reach, reach)));
  }
  auto buffer = test_device().upload(in, "in");
  auto cubes = test_device().buffer(in.size() * sizeof(cl_int), "cubes");
  auto wrapped = test_device().buffer(in.size() * sizeof(cl_uint), "wrapped");
  for (const uint n : {1u, 2u, 32u, 64u, 512u}) {
    const float origin = 0.3f, inverse_cell = 7.7f;
    run_kernel(program(), "coordinates", in.size(), buffer, cubes, wrapped, cl_uint(in.size()), origin,
               inverse_cell, n);
    const auto cube = test_device().download<int>(cubes, in.size());
    const auto bucket = test_device().download<uint>(wrapped, in.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const double scaled = static_cast<float>((in[i] - origin) * inverse_cell);
      const double expected = std::clamp(std::floor(scaled), -2147483648.0, largest_cube);
      if (!std::isnan(in[i])) wrong += cube[i] != static_cast<int>(expected);
      wrong += bucket[i] != static_cast<uint>((static_cast<long long>(cube[i]) % n + n) % n);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("a packed normal is within half a step of each component") {
  RandomInputs random(73);
  std::vector<float4> normals;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Vec3 n;
      n[axis] = sign;
      normals.push_back(to_float4(n));
    }
  while (normals.size() < (1 << 20)) normals.push_back(to_float4(random_direction(random)));
  auto in = test_device().upload(normals, "normals");
  auto packed = test_device().buffer(normals.size() * sizeof(cl_uint), "packed");
  auto out = test_device().buffer(normals.size() * sizeof(float4), "unpacked");
  run_kernel(program(), "normals", normals.size(), in, packed, out, cl_uint(normals.size()));
  const auto words = test_device().download<uint>(packed, normals.size());
  const auto unpacked = test_device().download<float4>(out, normals.size());
  double worst = 0;
  std::size_t beyond = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 error = to_vec3(unpacked[i]) - to_vec3(normals[i]);
    worst = std::max({worst, std::fabs(error.x), std::fabs(error.y), std::fabs(error.z)});
    beyond += (words[i] >> 24) != 0;
  }
  CHECK(worst <= 0.5 / 127 + 1e-6);
  CHECK(beyond == 0);
  // Axes, the normals of most rooms, are exact.
  for (int i = 0; i < 6; ++i) CHECK(to_vec3(unpacked[i]) == to_vec3(normals[i]));
}
