// The sample dimensions of camera paths against Sobol's sequence as it is defined, by generator matrices.
#include <bit>
#include <cmath>

#include "device_fixture.hpp"
#include "shared/dims.h"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

struct Path {
  uint pass, pixel, sample, samples, dimension, seed, sobol;
};

const char* const source = R"(
#include "sampling/sobol.cl"
typedef struct { uint pass, pixel, sample, samples, dimension, seed, sobol; } Path;
kernel void draw(global const Path *paths, global float4 *numbers, global float4 *parts, global float4 *independent,
                 global uint4 *hashes, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Path p = paths[i];
  PathSampler sampler = path_sampler(p.seed, p.pass, p.pixel, p.sample, p.samples, p.sobol);
  numbers[i] = convert_float4(path_random4(&sampler, p.dimension));
  parts[i] = convert_float4(path_random4_soa(&sampler, p.dimension));
  RandomStream stream = {p.seed, p.pass, p.pixel * p.samples + p.sample};
  independent[i] = convert_float4(random4(stream, p.dimension));
  hashes[i] = pcg4d((uint4)(p.pixel, 0x80000000u + half_of_passes(p.pass), p.dimension, p.seed));
}
)";

struct Drawn {
  std::vector<float4> numbers, parts, independent;
  std::vector<uint4> hashes;
};

Drawn draw(const std::vector<Path>& paths) {
  auto program = build_test_program(source);
  const auto in = test_device().upload(paths, "paths");
  const auto numbers = test_device().buffer(paths.size() * sizeof(float4), "numbers");
  const auto parts = test_device().buffer(paths.size() * sizeof(float4), "parts");
  const auto independent = test_device().buffer(paths.size() * sizeof(float4), "independent");
  const auto hashes = test_device().buffer(paths.size() * sizeof(uint4), "hashes");
  run_kernel(program, "draw", paths.size(), in, numbers, parts, independent, hashes, cl_uint(paths.size()));
  return {test_device().download<float4>(numbers, paths.size()),
          test_device().download<float4>(parts, paths.size()),
          test_device().download<float4>(independent, paths.size()),
          test_device().download<uint4>(hashes, paths.size())};
}

bool same_numbers(const float4& a, const float4& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

std::uint32_t reversed(std::uint32_t x) {
  std::uint32_t result = 0;
  for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1u) << (31 - bit);
  return result;
}

/// What a hash makes of the digits of an index, the first of them in the lowest bit.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= seed >> 16 | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Point `index` of Sobol's first two dimensions in units of 2^-32: digit j of the second is the sum, modulo
/// 2, of binomial(k, j) times bit k of the index.
std::array<std::uint32_t, 2> sobol(std::uint32_t index) {
  std::uint32_t second = 0;
  for (int j = 0; j < 32; ++j) {
    std::uint32_t digit = 0;
    for (int k = j; k < 32; ++k)
      if ((k & j) == j) digit ^= index >> k & 1u;  // binomial(k, j) is odd just then (Lucas)
    second |= digit << (31 - j);
  }
  return {reversed(index), second};
}

float number(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace

TEST_CASE(
    "sample dimensions of camera paths are those of Sobol's sequence, in an order of each pixel's own and "
    "shifted") {
  RandomInputs random(71);
  std::vector<Path> paths(1 << 16);
  for (auto& p : paths) {
    const auto any = [&] { return static_cast<uint>(random.engine()); };
    p = {any() >> (1 + any() % 31), any(), 0, 1 + any() % 16, any() % 1000, any(), 1};
    p.sample = any() % p.samples;
  }
  const Drawn drawn = draw(paths);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Path& p = paths[i];
    const uint4 hash = drawn.hashes[i];
    const std::uint32_t index = (p.pass >> 1) * p.samples + p.sample;
    // Scrambling takes an index's digits from the last on: as its bits are in reverse order.
    const auto first = sobol(reversed(scrambled(reversed(index), hash.x)));
    const auto other = sobol(reversed(scrambled(reversed(index), hash.w)));
    const float4 v = drawn.numbers[i];
    wrong += !same_numbers(v, drawn.parts[i]);
    wrong += v.x != number(first[0] ^ hash.y) || v.y != number(first[1] ^ hash.z) ||
             v.z != number(other[0] ^ (hash.y << 16 | hash.x >> 16)) ||
             v.w != number(other[1] ^ (hash.z << 16 | hash.w >> 16));
  }
  CHECK(wrong == 0);
}

TEST_CASE("sample dimensions of camera paths are independent ones where the program is told so") {
  std::vector<Path> paths;
  for (uint i = 0; i < 4096; ++i)
    paths.push_back({i / 64, 1000 + i % 64, i % 4, 4, DIM_FILM + i % 3, 5, i % 2});
  const Drawn drawn = draw(paths);
  std::size_t alike[2] = {0, 0};
  for (std::size_t i = 0; i < paths.size(); ++i) {
    CHECK(same_numbers(drawn.numbers[i], drawn.parts[i]));
    const float4 a = drawn.numbers[i], b = drawn.independent[i];
    alike[paths[i].sobol] += a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
  }
  CHECK(alike[0] == 2048);
  CHECK(alike[1] == 0);
}

TEST_CASE("the samples that a pixel takes in each half of the passes leave no cell of a net empty") {
  // 64 passes of four samples each: in either half 128 points, in cells of all shapes of area 1/128.
  constexpr uint passes = 64, samples = 4, points = passes * samples / 2;
  for (const uint pixel : {0u, 17u, 123456u}) {
    std::vector<Path> paths;
    for (uint pass = 0; pass < passes; ++pass)
      for (uint sample = 0; sample < samples; ++sample)
        paths.push_back({pass, pixel, sample, samples, DIM_FILM, 9, 1});
    const auto numbers = draw(paths).numbers;
    for (int shape = 0; shape <= 7; ++shape) {
      std::vector<int> in_cell[2] = {std::vector<int>(points), std::vector<int>(points)};
      for (std::size_t i = 0; i < paths.size(); ++i) {
        const auto half = static_cast<std::size_t>(std::popcount(paths[i].pass) % 2);
        const auto column = static_cast<std::size_t>(std::ldexp(numbers[i].x, shape));
        const auto row = static_cast<std::size_t>(std::ldexp(numbers[i].y, 7 - shape));
        ++in_cell[half][(column << (7 - shape)) + row];
      }
      CAPTURE(pixel, shape);
      for (const auto& cells : in_cell) CHECK(std::count(cells.begin(), cells.end(), 1) == points);
    }
  }
}
