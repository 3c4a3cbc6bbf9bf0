// Hard case 16: sums over many passes.
#include <cfloat>

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
  float sum[3], sample[3];
} Addition;
typedef struct {
  FilmPixel pixel;
  Counters counters;
} Added;
kernel void add_one(global const Addition *in, global Added *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  FilmPixel pixel = {{in[i].sum[0], in[i].sum[1], in[i].sum[2]}};
  Counters counters = {0, 0, 0, 0};
  out[i].pixel = pixel;
  out[i].counters = counters;
  film_add(&out[i].pixel, (real3)(in[i].sample[0], in[i].sample[1], in[i].sample[2]), 0, 1, &out[i].counters);
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
/// double, whose own error is below 1e-11. A float stops growing at 2^24 times its samples; hi + lo has 48
/// bits.
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
      const long double sum = static_cast<long double>(sums[i].sum[c]) + sums[i].low[c];
      errors[i] = std::max(errors[i], static_cast<double>(std::fabs(sum / truth[c] - 1)));
    }
  });
  return result_of_passes(context, errors);
}

struct Addition {
  float sum[3], sample[3];
};
struct Added {
  FilmPixel pixel;
  Counters counters;
};

/// A sample that no float can be added to changes one counter and no pixel; any other gives the exact sum.
CheckResult full_sums(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "add_one");
  return run_random_check(
      context, 0, "",
      [](InputRandom& random, std::uint64_t) {
        Addition in;
        for (int c = 0; c < 3; ++c) {
          in.sum[c] = static_cast<float>(random.scale(-3, 38.5));
          in.sample[c] = static_cast<float>(random.scale(30, 38.5));
          // Half an ulp below what overflows, and above it.
          if (random.below(4) == 0) in.sum[c] = next_float(FLT_MAX, -static_cast<int>(random.below(4)));
          if (random.below(4) == 0) in.sample[c] = std::ldexp(1.0f, 99 + static_cast<int>(random.below(10)));
        }
        return in;
      },
      [&](const auto& inputs) { return kernel.run<Added>(inputs); },
      [](const Addition& in, const Added& out) {
        bool fits = true;
        for (int c = 0; c < 3; ++c) fits = fits && std::isfinite(in.sum[c] + in.sample[c]);
        if (out.counters.saturated != (fits ? 0u : 1u) || out.counters.non_finite != 0) return 1.0;
        for (int c = 0; c < 3; ++c) {
          const double expected = in.sum[c] + (fits ? static_cast<double>(in.sample[c]) : 0.0);
          const double sum = static_cast<double>(out.pixel.sum[c]) + out.pixel.low[c];
          // 2^-48 of the sum is what hi + lo may lose.
          if (!(std::fabs(sum - expected) <= expected * 0x1p-47)) return 1.0;
        }
        return 0.0;
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
          {16, "a pixel's sum that is full is counted, not lost", 1, full_sums},
          {16, "a photon's flux that is too bright is counted", 1, full_records}};
}

}  // namespace causticl
