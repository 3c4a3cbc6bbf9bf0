// Hard case 21: random numbers.
#include <array>

#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "sampling/rng.cl"
typedef struct {
  uint4 bits;
  float4 numbers;
} Draw;
// in: path, pass, dimension, seed
kernel void draw(global const uint4 *in, global Draw *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {in[i].w, in[i].y, in[i].x};
  Draw drawn = {pcg4d(in[i]), convert_float4(random4(stream, in[i].z))};
  out[i] = drawn;
}
kernel void streams(global float4 *out, uint count, uint first, uint seed, uint pass, uint dimension) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, pass, first + i};
  out[i] = convert_float4(random4(stream, dimension));
}
// A stream's numbers, and those of its neighbours in path, pass, dimension and seed.
kernel void neighbours(global float4 *out, uint count, uint first, uint seed) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint path = first + i;
  RandomStream here = {seed, 0, path}, next_path = {seed, 0, path + 1u}, next_pass = {seed, 1, path},
               next_seed = {seed + 1u, 0, path};
  out[5 * i] = convert_float4(random4(here, DIM_FILM));
  out[5 * i + 1] = convert_float4(random4(next_path, DIM_FILM));
  out[5 * i + 2] = convert_float4(random4(next_pass, DIM_FILM));
  out[5 * i + 3] = convert_float4(random4(here, DIM_FILM + 1u));
  out[5 * i + 4] = convert_float4(random4(next_seed, DIM_FILM));
}
)";

struct Words {
  std::uint32_t w[4];
};
struct Draw {
  Words bits;
  float numbers[4];
};

/// PCG4D as published (Jarzynski & Olano 2020), written out on the host.
Words pcg4d(Words in) {
  auto& [v] = in;
  for (auto& x : v) x = x * 1664525u + 1013904223u;
  const auto mix = [&v = v] {
    v[0] += v[1] * v[3];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    v[3] += v[1] * v[2];
  };
  mix();
  for (auto& x : v) x ^= x >> 16;
  mix();
  return in;
}

/// The published words to the bit, and as numbers their upper 24 bits, in [0, 1).
CheckResult known_answers(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "draw");
  return run_random_check(
      context, 0, "",
      [](InputRandom& random, std::uint64_t index) {
        constexpr std::uint32_t corners[] = {0u, 1u, 0x7fffffffu, 0x80000000u, 0xfffffffeu, 0xffffffffu};
        Words in;
        for (auto& x : in.w)
          x = index % 3 == 0 ? corners[random.below(6)] : static_cast<std::uint32_t>(random.bits());
        return in;
      },
      [&](const auto& inputs) { return kernel.run<Draw>(inputs); },
      [](const Words& in, const Draw& out) {
        const Words expected = pcg4d(in);
        for (int i = 0; i < 4; ++i) {
          if (out.bits.w[i] != expected.w[i]) return 1.0;
          if (out.numbers[i] != static_cast<float>(expected.w[i] >> 8) * 0x1p-24f) return 1.0;
          if (!(out.numbers[i] >= 0 && out.numbers[i] < 1)) return 1.0;
        }
        return 0.0;
      });
}

/// Windows of 2^20 consecutive paths, each from a pass, dimension and first path of its own; the first window
/// crosses 2^32. Four numbers have 96 bits: any two equal tuples among 2^20 are a fault (by chance once in
/// 10^17).
CheckResult distinct_streams(CheckContext& context) {
  CheckResult result;
  const auto program = context.program(source, 0);
  for (std::uint64_t window = 0; result.inputs < context.inputs; ++window) {
    InputRandom random(context.seed, window);
    const auto first = window == 0 ? 0xfff80000u : static_cast<std::uint32_t>(random.bits());
    SampleKernel<std::array<float, 4>> streams(context, program, "streams", random.below(1000),
                                               random.below(100));
    auto tuples = streams(
        first, static_cast<std::size_t>(std::min<std::uint64_t>(1u << 20, context.inputs - result.inputs)));
    std::sort(tuples.begin(), tuples.end());
    for (std::size_t i = 1; i < tuples.size(); ++i) result.failures += tuples[i] == tuples[i - 1];
    result.inputs += tuples.size();
  }
  return result;
}

/// Pairs of numbers in 32 x 32 squares: within a tuple, and of a tuple with each of its neighbours.
CheckResult independent_streams(CheckContext& context) {
  using Tuples = std::array<std::array<float, 4>, 5>;
  constexpr std::size_t n = 32;
  SampleKernel<Tuples> neighbours(context, context.program(source, 0), "neighbours");
  return run_histogram_check(
      context, std::vector<Histogram>(19, flat_histogram(n * n)), neighbours,
      [](const Tuples& tuples, std::uint64_t, std::vector<Histogram>& histograms) {
        const auto add = [&](std::size_t h, float x, float y) {
          histograms[h].add(static_cast<std::size_t>(x * n) * n + static_cast<std::size_t>(y * n));
        };
        for (std::size_t c = 0; c < 3; ++c) add(c, tuples[0][c], tuples[0][c + 1]);
        for (std::size_t other = 1; other < 5; ++other)
          for (std::size_t c = 0; c < 4; ++c) add(3 + 4 * (other - 1) + c, tuples[0][c], tuples[other][c]);
      });
}

}  // namespace

std::vector<Check> random_number_checks() {
  return {{21, "PCG4D gives its published words, below 1", 1, known_answers},
          {21, "no two streams draw the same, also past 2^32", 1, distinct_streams},
          {21, "neighbouring streams are independent", 1, independent_streams}};
}

}  // namespace causticl
