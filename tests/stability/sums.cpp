// Hard cases 16, 17 and 18: sums, radii and statistics over many passes.
#include <cfloat>

#include "random_check.hpp"
#include "stability_checks.hpp"
#include "types.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "pass_gather.cl"
#include "pass_photon.cl"
// The state of a linear congruential generator that makes the same samples on the host.
INLINE uint next_state(uint state) { return state * 1664525u + 1013904223u; }
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
    film_add(film + i, (real3)(u, i % 2 ? 0.99999994f : 0.001f, u * bright), counters);
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
  FilmPixel pixel = {{in[i].sum[0], in[i].sum[1], in[i].sum[2]}, {0, 0, 0}};
  Counters counters = {0, 0, 0, 0};
  out[i].pixel = pixel;
  out[i].counters = counters;
  film_add(&out[i].pixel, (real3)(in[i].sample[0], in[i].sample[1], in[i].sample[2]), &out[i].counters);
}
kernel void quantise(global const float2 *in, global uint2 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  bool saturated = false;
  uint units = flux_quantise(in[i].x, in[i].y, &saturated);
  out[i] = (uint2)(units, saturated);
}
// `passes` updates of each pixel. Photons of a pass: shifted right by i % 32 bits, and none in a quarter of them.
kernel void update_many(global SppmPixel *pixels, global uint *states, global const float *alphas, uint items,
                        uint passes) {
  uint i = get_global_id(0);
  if (i >= items) return;
  SppmPixel pixel = pixels[i];
  uint state = states[i];
  for (uint pass = 0; pass < passes; ++pass) {
    state = next_state(state);
    uint found = (state & 0x300u) == 0 ? 0u : (state >> 1) >> i % 32u;
    pixel = sppm_update(pixel, found, alphas[i]);
  }
  pixels[i] = pixel;
  states[i] = state;
}
typedef struct {
  SppmPixel pixel;
  uint found;
  float alpha;
} Update;
kernel void update_one(global const Update *in, global SppmPixel *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = sppm_update(in[i].pixel, in[i].found, in[i].alpha);
}
)";

constexpr std::uint64_t launch_passes = 1
                                        << 16;  // short enough for the watchdog of a GPU that draws a screen

std::uint32_t next_state(std::uint32_t state) { return state * 1664525u + 1013904223u; }

/// Relative error of each channel of eight pixels after context.inputs samples. Truth is a sum in long
/// double, whose own error is below 1e-11. A float stops growing at 2^24 times its samples; hi + lo has 48
/// bits.
CheckResult long_sums(CheckContext& context) {
  constexpr cl_uint pixels = 8;
  CheckResult result;
  result.tolerance = 1e-6;
  result.unit = "relative";
  result.inputs = context.inputs;
  std::vector<cl_uint> states;
  for (cl_uint i = 0; i < pixels; ++i) states.push_back(context.seed + 77 * i);
  const auto film = context.device.upload(std::vector<FilmPixel>(pixels), "film of a check"),
             counters = context.device.upload(std::vector<Counters>(1), "counters of a check"),
             generators = context.device.upload(states, "states of a check");
  cl::Kernel kernel(context.program(source, 0), "add_many");
  for (std::uint64_t done = 0; done < context.inputs; done += launch_passes) {
    set_arguments(kernel, film, generators, counters, pixels,
                  static_cast<cl_uint>(std::min(launch_passes, context.inputs - done)));
    context.device.launch(kernel, pixels);
  }
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
  for (const double error : errors) {
    result.failures += !(error <= result.tolerance);
    result.worst_error = std::max(result.worst_error, error);
  }
  return result;
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

double radius2_of(const SppmPixel& pixel) { return static_cast<double>(pixel.radius2_hi) + pixel.radius2_lo; }
std::uint64_t photons_of(const SppmPixel& pixel) {
  return static_cast<std::uint64_t>(pixel.photons_high) << 32 | pixel.photons_low;
}

/// R^2 of 32 pixels after context.inputs passes against the recursion in double, which itself is off by less
/// than 1e-16 a pass. A float recursion drifts by 0.1% to 3% over 10^6 passes.
CheckResult long_recursion(CheckContext& context) {
  constexpr cl_uint items = 32;
  CheckResult result;
  result.tolerance = 1e-6;
  result.unit = "relative";
  result.inputs = context.inputs;
  std::vector<SppmPixel> pixels(items);
  std::vector<cl_uint> states;
  std::vector<float> alphas;
  for (cl_uint i = 0; i < items; ++i) {
    constexpr float some[] = {0.7f, 0.3f, 0.95f, 0.5f};
    InputRandom random(context.seed, i);
    pixels[i].radius2_hi = static_cast<float>(random.scale(-6, 6));
    states.push_back(static_cast<cl_uint>(random.bits()));
    alphas.push_back(some[i / 8]);
  }
  const auto start = pixels;
  const auto state = context.device.upload(pixels, "pixels of a check"),
             generators = context.device.upload(states, "states of a check"),
             shares = context.device.upload(alphas, "alphas of a check");
  cl::Kernel kernel(context.program(source, 0), "update_many");
  for (std::uint64_t done = 0; done < context.inputs; done += launch_passes) {
    set_arguments(kernel, state, generators, shares, items,
                  static_cast<cl_uint>(std::min(launch_passes, context.inputs - done)));
    context.device.launch(kernel, items);
  }
  pixels = context.device.download<SppmPixel>(state, items);
  std::vector<double> errors(items);
  parallel_chunks(items, 1, context.threads, [&](std::size_t i, std::size_t) {
    double n = 0, radius2 = start[i].radius2_hi;
    const double alpha = alphas[i];
    std::uint32_t generator = states[i];
    std::uint64_t photons = 0;
    for (std::uint64_t pass = 0; pass < context.inputs; ++pass) {
      generator = next_state(generator);
      const std::uint32_t found = (generator & 0x300u) == 0 ? 0u : (generator >> 1) >> i % 32u;
      photons += found;
      if (found == 0) continue;
      const double kept = n + alpha * found;
      radius2 *= kept / (n + found);
      n = kept;
    }
    errors[i] = photons_of(pixels[i]) == photons ? std::fabs(radius2_of(pixels[i]) / radius2 - 1) : INFINITY;
  });
  for (const double error : errors) {
    result.failures += !(error <= result.tolerance);
    result.worst_error = std::max(result.worst_error, error);
  }
  return result;
}

struct Update {
  SppmPixel pixel;
  std::uint32_t found;
  float alpha;
};

Update any_update(InputRandom& random, std::uint64_t index) {
  constexpr float alphas[] = {FLT_MIN, 1e-9f, 1e-6f, 0.5f, 0.7f, 0.999999f, 0x1.fffffep-1f, 1.0f};
  constexpr std::uint64_t counts[] = {0,
                                      1,
                                      0x7fffffffu,
                                      0x80000000u,
                                      0xffffffffu,
                                      0x100000000u,
                                      ~0ull >> 1,
                                      ~0ull - 0x80000000u,
                                      ~0ull - 0xffffffffu,
                                      ~0ull};
  constexpr std::uint32_t found[] = {0, 0, 1, 15, 1u << 31, 0xffffffffu};
  constexpr float radii[] = {FLT_MIN, 0x1.000002p-126f, 1.0f, FLT_MAX};
  Update update{};
  update.alpha = index % 2 ? alphas[random.below(8)] : static_cast<float>(random.uniform(0.001, 1));
  std::uint64_t photons = index % 4 == 0 ? 0 : static_cast<std::uint64_t>(random.scale(0, 15));
  if (index % 4 == 1) photons = counts[random.below(10)];
  update.pixel.photons_low = static_cast<std::uint32_t>(photons);
  update.pixel.photons_high = static_cast<std::uint32_t>(photons >> 32);
  update.found = index % 3 == 0 ? found[random.below(6)] : static_cast<std::uint32_t>(random.scale(0, 9.6));
  update.pixel.radius2_hi =
      index % 5 == 0 ? radii[random.below(4)] : static_cast<float>(random.scale(-30, 30));
  // The second half of a sum is at most half an ulp of the first.
  if (index % 5 != 0)
    update.pixel.radius2_lo = update.pixel.radius2_hi * static_cast<float>(random.uniform(-2e-8, 2e-8));
  return update;
}

/// One update from any state, N = M = 0, alpha near 0 and 1, R^2 at the smallest normal number, M = 2^31 and
/// N near 2^32 and 2^64 among them: no photon changes no bit, and equation (9) else holds to a few roundings.
/// R^2 never grows, and stays at or above the smallest normal number; the number of photons stops at 2^64
/// - 1.
CheckResult one_update(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "update_one");
  return run_random_check(
      context, 1e-6, "relative", any_update,
      [&](const auto& inputs) { return kernel.run<SppmPixel>(inputs); },
      [](const Update& in, const SppmPixel& out) {
        if (in.found == 0) return std::memcmp(&in.pixel, &out, sizeof out) == 0 ? 0.0 : INFINITY;
        const std::uint64_t before = photons_of(in.pixel), sum = before + in.found;
        if (photons_of(out) != (sum < before ? ~0ull : sum)) return INFINITY + 0.0;
        if (!(out.radius2_hi >= FLT_MIN && out.radius2_hi <= in.pixel.radius2_hi)) return INFINITY + 0.0;
        const long double n = static_cast<long double>(in.alpha) * before, m = in.found;
        const long double radius2 = radius2_of(in.pixel) * ((n + in.alpha * m) / (n + m));
        // Near the smallest normal number the products of the update have fewer bits.
        if (radius2 < 0x1p20L * FLT_MIN)
          return std::fabs(static_cast<double>((radius2_of(out) - radius2) / (0x1p20L * FLT_MIN)));
        return std::fabs(static_cast<double>(radius2_of(out) / radius2 - 1));
      });
}

}  // namespace

std::vector<Check> sum_checks() {
  return {{16, "sums of a pixel over all its samples", 1, long_sums},
          {16, "a pixel's sum that is full is counted, not lost", 1, full_sums},
          {16, "a photon's flux that is too bright is counted", 1, full_records},
          {17, "radius recursion over all passes", 1, long_recursion},
          {18, "one update of a pixel's statistics", 1, one_update}};
}

}  // namespace causticl
