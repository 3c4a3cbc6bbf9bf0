// Hard cases 17 and 18: the progressive radius over many passes, and one update of it from any state.
#include <cfloat>
#include <cstring>

#include "selftest/many_passes.hpp"
#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

const std::string source = next_state_source + R"(
#include "passes/pass_gather.cl"
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

double radius2_of(const SppmPixel& pixel) { return static_cast<double>(pixel.radius2_hi) + pixel.radius2_lo; }
std::uint64_t photons_of(const SppmPixel& pixel) {
  return static_cast<std::uint64_t>(pixel.photons_high) << 32 | pixel.photons_low;
}

/// R^2 of 32 pixels after context.inputs passes against the recursion in double, which itself is off by less
/// than 1e-16 a pass. A float recursion drifts by 0.1% to 3% over 10^6 passes.
CheckResult long_recursion(CheckContext& context) {
  constexpr cl_uint items = 32;
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
             alpha_buffer = context.device.upload(alphas, "alphas of a check");
  cl::Kernel kernel(context.program(source, 0), "update_many");
  launch_passes(context, kernel, items, state, generators, alpha_buffer);
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
  return result_of_passes(context, errors);
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

std::vector<Check> progressive_radius_checks() {
  return {{17, "radius recursion over all passes", 1, long_recursion},
          {18, "one update of a pixel's statistics", 1, one_update}};
}

}  // namespace causticl
