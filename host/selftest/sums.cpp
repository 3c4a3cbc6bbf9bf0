// Hard case 16: sums over many passes.
#include <cfloat>

#include "film/film.hpp"
#include "selftest/many_passes.hpp"
#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

const std::string source = next_state_source + R"(
#include "film/film.cl"
#include "passes/pass_photon.cl"
// Adds samples to pixels, each of its own distribution: uniform in [0, 1); nearly 1; nearly 1e-3; and a rare one that
// is 10^6 times as bright.
kernel void add_many(global FilmPixel *film, global uint *states, volatile global Counters *counters, uint pixels,
                     uint passes) {
  uint i = get_global_id(0);
  if (i >= pixels) return;
  uint state = states[i];
  for (uint pass = 0; pass < passes; ++pass) {
    state = next_state(state);
    float u = (state >> 8) * 5.9604644775390625e-8f;
    float bright = state < 42950u ? 1e6f : 1.0f;
    film_add(film + i, (real3)(u, i % 2 ? 0.99999994f : 0.001f, u * bright), 0, pass, counters);
  }
  states[i] = state;
}
typedef struct {
  float x[8];
} Numbers;
typedef struct {
  ExactSum forward, backward, parts;
} Orders;
// The sum of eight numbers, as they come, in the opposite order, and of two parts.
kernel void add_in_orders(global const Numbers *in, global Orders *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  ExactSum none = {0, 0};
  ExactSum part = none;
  out[i].forward = out[i].backward = out[i].parts = none;
  for (uint k = 0; k < 8; ++k) film_sum(&out[i].forward, in[i].x[k]);
  for (uint k = 8; k > 0; --k) film_sum(&out[i].backward, in[i].x[k - 1]);
  for (uint k = 0; k < 3; ++k) film_sum(&out[i].parts, in[i].x[k]);
  for (uint k = 3; k < 8; ++k) part = exact_sum_add(part, in[i].x[k]);
  out[i].parts = exact_sum_of_parts(out[i].parts, part);
}
kernel void quantise(global const float2 *in, global uint2 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  bool saturated = false;
  uint units = flux_quantise(in[i].x, in[i].y, &saturated);
  out[i] = (uint2)(units, saturated);
}
)";

/// Relative error of each channel of eight pixels after context.inputs samples. Truth is a sum in long
/// double, whose own error is below 1e-11. A float stops growing at 2^24 times its samples.
CheckResult long_sums(CheckContext& context) {
  constexpr cl_uint pixels = 8;
  std::vector<cl_uint> states;
  for (cl_uint i = 0; i < pixels; ++i) states.push_back(context.seed + 77 * i);
  const auto film = context.device.upload(std::vector<FilmPixel>(pixels), "film of a check"),
             counters = context.device.upload(std::vector<Counters>(1), "counters of a check"),
             generators = context.device.upload(states, "states of a check");
  cl::Kernel kernel(context.program(source, 0), "add_many");
  launch_passes(context, kernel, pixels, film, generators, counters);
  const auto sums = context.device.download<FilmPixel>(film, pixels);
  std::vector<double> errors(pixels);
  parallel_chunks(pixels, 1, context.threads, [&](std::size_t i, std::size_t) {
    long double truth[3] = {0, 0, 0};
    std::uint32_t state = states[i];
    for (std::uint64_t pass = 0; pass < context.inputs; ++pass) {
      state = next_state(state);
      const float u = static_cast<float>(state >> 8) * 0x1p-24f;
      truth[0] += u;
      truth[1] += i % 2 ? 0.99999994f : 0.001f;
      truth[2] += u * (state < 42950u ? 1e6f : 1.0f);
    }
    for (int c = 0; c < 3; ++c) {
      const long double sum = mean_of(sums[i].radiance[c], 1);
      errors[i] = std::max(errors[i], static_cast<double>(std::fabs(sum / truth[c] - 1)));
    }
  });
  return result_of_passes(context, errors);
}

struct Numbers {
  float x[8];
};
struct Orders {
  ExactSum forward, backward, parts;
};

bool same_bits(const ExactSum& a, const ExactSum& b) {
  return a.high == b.high && a.low_and_bin == b.low_and_bin;
}

/// The sum of numbers that are rounded as ExactSum has it: to the nearest multiple of the unit of the bin
/// below that of the largest.
double rounded_sum(const Numbers& in) {
  double largest = 0;
  for (const float x : in.x) largest = std::max(largest, std::fabs(static_cast<double>(x)));
  if (largest == 0) return 0;
  const int bin = (std::ilogb(largest) + 1 + EXACT_SUM_UNIT) / EXACT_SUM_BITS;
  const double unit = std::ldexp(1.0, EXACT_SUM_BITS * (bin - 1) - EXACT_SUM_UNIT);
  long double units = 0;
  for (const float x : in.x)
    units +=
        std::copysign(std::floor(std::fabs(static_cast<double>(x)) / unit + 0.5), static_cast<double>(x));
  return static_cast<double>(units * unit);
}

/// Sums have the same bits in any order and by parts, also where no float holds them, and lose nothing beyond
/// the rounding of each number.
CheckResult sums_in_any_order(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "add_in_orders");
  return run_random_check(
      context, 1e-15, "relative",
      [](InputRandom& random, std::uint64_t index) {
        Numbers in;
        // All of one size, or of any, or next to the largest and the smallest float.
        const double low = index % 4 == 0 ? -1 : -44.8, high = index % 4 == 0 ? 1 : 38.5;
        for (float& x : in.x) {
          x = static_cast<float>(random.scale(low, high));
          if (index % 4 == 1) x = next_float(FLT_MAX, -static_cast<int>(random.below(4)));
          if (random.below(8) == 0) x = index % 2 ? 0.0f : 0x1p-149f;
          if (index % 8 > 4 && random.below(2)) x = -x;
        }
        return in;
      },
      [&](const auto& inputs) { return kernel.run<Orders>(inputs); },
      [](const Numbers& in, const Orders& out) {
        if (!same_bits(out.forward, out.backward) || !same_bits(out.forward, out.parts))
          return INFINITY + 0.0;
        const double expected = rounded_sum(in);
        return std::fabs(mean_of(out.forward, 1) - expected) / std::max(std::fabs(expected), 1e-300);
      });
}

struct Flux {
  float flux, dither;
};
struct Quantised {
  std::uint32_t units, saturated;
};

/// A flux above what the record of a photon holds is clamped and says so; any other is a neighbouring
/// integer.
CheckResult full_records(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "quantise");
  return run_random_check(
      context, 1, "units",
      [](InputRandom& random, std::uint64_t index) {
        constexpr double full = 65536 / static_cast<double>(PHOTON_FLUX_UNIT);
        Flux in{static_cast<float>(random.scale(-7, 2)), random.uniform24()};
        if (index % 4 == 0)
          in.flux = next_float(static_cast<float>(full), static_cast<int>(random.below(65)) - 32);
        if (index % 64 == 1) in.flux = index % 128 == 1 ? INFINITY : 0;
        return in;
      },
      [&](const auto& inputs) { return kernel.run<Quantised>(inputs); },
      [](const Flux& in, const Quantised& out) {
        // In the device's arithmetic: the sum rounds to the next float, which at 65,536 is 1/256 apart.
        const float units = in.flux * PHOTON_FLUX_UNIT + in.dither;
        if ((out.saturated != 0) != (units >= 65536)) return INFINITY + 0.0;
        if (units >= 65536) return out.units == 65535 ? 0.0 : INFINITY;
        return std::fabs(out.units - static_cast<double>(in.flux) * PHOTON_FLUX_UNIT) * (1 - 0x1p-8);
      });
}

}  // namespace

std::vector<Check> sum_checks() {
  return {{16, "sums of a pixel over all its samples", 1, long_sums},
          {16, "sums of a pixel in any order and by parts", 1, sums_in_any_order},
          {16, "a photon's flux that is too bright is counted", 1, full_records}};
}

}  // namespace causticl
