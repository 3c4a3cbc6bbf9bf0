// Hard case 21: the sample dimensions of camera paths.
#include <array>

#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "sampling/sobol.cl"
// Paths `first` ... of one half of a pixel's, in the order of their index.
kernel void pixel_paths(global float4 *out, uint count, uint first, uint seed, uint pixel, uint dimension, uint samples) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint index = first + i, pair = index / samples * 2u;
  // Of the two passes with the same index one is in the first half.
  PathSampler sampler = path_sampler(seed, pair + half_of_passes(pair), pixel, index % samples, samples, 1u);
  out[i] = convert_float4(path_random4(&sampler, dimension));
}
// A path's numbers, and those of another dimension, pixel, half and seed.
kernel void neighbours(global float4 *out, uint count, uint first, uint seed, uint pass) {
  uint i = get_global_id(0);
  if (i >= count) return;
  uint pixel = first + i;
  PathSampler here = path_sampler(seed, pass, pixel, 0, 1, 1u), beside = path_sampler(seed, pass, pixel + 1u, 0, 1, 1u),
              other_half = path_sampler(seed, pass ^ 1u, pixel, 0, 1, 1u),
              other_seed = path_sampler(seed + 1u, pass, pixel, 0, 1, 1u);
  out[5 * i] = convert_float4(path_random4(&here, DIM_FILM));
  out[5 * i + 1] = convert_float4(path_random4(&here, DIM_FILM + 1u));
  out[5 * i + 2] = convert_float4(path_random4(&beside, DIM_FILM));
  out[5 * i + 3] = convert_float4(path_random4(&other_half, DIM_FILM));
  out[5 * i + 4] = convert_float4(path_random4(&other_seed, DIM_FILM));
}
)";

using Numbers = std::array<float, 4>;

/// How many of the cells of 2^a x 2^(k - a), for every a, do not hold one of these 2^k points of the unit
/// square.
std::uint64_t empty_cells(const Numbers* points, int k, int x, int y) {
  std::uint64_t empty = 0;
  const std::size_t n = std::size_t{1} << k;
  for (int a = 0; a <= k; ++a) {
    std::vector<bool> held(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto column = static_cast<std::size_t>(std::ldexp(points[i][static_cast<std::size_t>(x)], a));
      const auto row = static_cast<std::size_t>(std::ldexp(points[i][static_cast<std::size_t>(y)], k - a));
      held[column << (k - a) | row] = true;
    }
    empty += static_cast<std::uint64_t>(std::count(held.begin(), held.end(), false));
  }
  return empty;
}

/// In both pairs of a dimension, every 2^k paths of a half that follow a multiple of 2^k are a (0, k, 2)-net:
/// each cell of 2^a x 2^(k - a) holds one of them. Up to k = 11: 24 bits are enough for that many.
CheckResult pixels_are_filled_evenly(CheckContext& context) {
  constexpr int largest = 11;
  constexpr std::size_t window = std::size_t{1} << largest;
  CheckResult result;
  const auto program = context.program(source, 0);
  for (std::uint64_t number = 0; result.inputs < context.inputs; ++number) {
    InputRandom random(context.seed, number);
    const auto pixel = static_cast<std::uint32_t>(random.bits());
    const std::uint32_t dimension = random.below(200), samples = 1u << random.below(5);
    SampleKernel<Numbers> paths(context, program, "pixel_paths", pixel, dimension, samples);
    const auto block = static_cast<std::uint32_t>(random.below(1000));
    const auto points = paths(block << largest, window);
    for (int k = 0; k <= largest; ++k)
      for (std::size_t first = 0; first < window; first += std::size_t{1} << k)
        result.failures += empty_cells(&points[first], k, 0, 1) + empty_cells(&points[first], k, 2, 3);
    result.inputs += window;
  }
  return result;
}

/// Pairs of numbers in 32 x 32 squares, over pixels: within a path, and of a path with others.
CheckResult pixels_are_independent(CheckContext& context) {
  using Tuples = std::array<Numbers, 5>;
  constexpr std::size_t n = 32;
  SampleKernel<Tuples> neighbours(context, context.program(source, 0), "neighbours", cl_uint{77});
  return run_histogram_check(
      context, std::vector<Histogram>(22, flat_histogram(n * n)), neighbours,
      [](const Tuples& tuples, std::uint64_t, std::vector<Histogram>& histograms) {
        std::size_t next = 0;
        const auto add = [&](float x, float y) {
          histograms[next++].add(static_cast<std::size_t>(x * n) * n + static_cast<std::size_t>(y * n));
        };
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = a + 1; b < 4; ++b) add(tuples[0][a], tuples[0][b]);
        for (std::size_t other = 1; other < 5; ++other)
          for (std::size_t c = 0; c < 4; ++c) add(tuples[0][c], tuples[other][c]);
      });
}

}  // namespace

std::vector<Check> path_number_checks() {
  return {{21, "a pixel's paths fill it evenly", 1, pixels_are_filled_evenly},
          {21, "paths of different pixels are independent", 1, pixels_are_independent}};
}

}  // namespace causticl
