// What a pixel keeps of its probes: the running mean against the host's, and which points are probed.
#include <algorithm>
#include <array>

#include "device_fixture.hpp"
#include "shared/effects.h"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/kernel_area_mean.cl"
kernel void means(global const uint *probes, global uint *states, uint each, uint pixels) {
  uint i = get_global_id(0), state = 0;
  if (i >= pixels) return;
  for (uint k = 0; k < each; ++k) states[i * each + k] = state = kernel_area_add(state, probes[i * each + k], k);
}
// For 64 passes of pixel `pixel` with four points each, of pixels in each of the states.
kernel void wanted(global const uint *states, global uint *asked, uint pixel) {
  uint i = get_global_id(0), pass = i / 4 % 64;
  if (i < 3 * 64 * 4) asked[i] = kernel_area_wanted(states[i / (64 * 4)], pixel, pass, i % 4 == pass % 4);
}
kernel void covered(global const uint *states, global const float *ratios, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = kernel_area_of(states[i], ratios[i]);
}
)";

}  // namespace

TEST_CASE("a pixel keeps the mean of its last probes, of both discs") {
  auto program = build_test_program(source, EFFECT_TRIANGLES);
  RandomInputs random(20261126);
  constexpr std::size_t pixels = 64, each = 1000;
  std::vector<cl_uint> probes(pixels * each);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double covered = static_cast<double>(i / each) / pixels;
    // Other bits of the word, as the normal's, must not matter; some points have no probe.
    probes[i] = static_cast<cl_uint>(random.uniform(0, 1 << 24)) | BEYOND_DIFFUSE;
    if (random.uniform() < 0.1) continue;
    probes[i] |= KERNEL_AREA_PROBED | (random.uniform() < 0.25 ? KERNEL_AREA_OF_HALF : 0u) |
                 (random.uniform() < covered ? 1u
                  : random.uniform() < 0.1   ? 2u
                                             : 0u)
                     << KERNEL_AREA_SHIFT;
  }
  const auto in = test_device().upload(probes, "probes");
  const auto states = test_device().buffer(probes.size() * sizeof(cl_uint), "states");
  cl::Kernel means(program, "means");
  set_arguments(means, in, states, static_cast<cl_uint>(each), static_cast<cl_uint>(pixels));
  test_device().launch(means, pixels);
  const auto words = test_device().download<cl_uint>(states, probes.size());

  std::vector<float> ratios(words.size());
  std::vector<double> expected(words.size());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    unsigned sum[2] = {}, number[2] = {};
    for (std::size_t k = 0; k < each; ++k) {
      const std::size_t i = pixel * each + k;
      if (probes[i] & KERNEL_AREA_PROBED) {
        const int disc = (probes[i] & KERNEL_AREA_OF_HALF) ? 1 : 0;
        if (number[disc] == 126) {
          number[disc] = 63;
          sum[disc] = (sum[disc] + k % 2) / 2;
        }
        sum[disc] += probes[i] >> KERNEL_AREA_SHIFT & 3u;
        ++number[disc];
      }
      const double whole = (sum[0] + 1.0) / (number[0] + 1.0), half = (sum[1] + 1.0) / (number[1] + 1.0);
      ratios[i] = static_cast<float>(random.uniform(0.05, 1));
      const double line = half + (whole - half) * (2.0 * static_cast<double>(ratios[i]) - 1);
      expected[i] = std::clamp(line, 0.125, std::max({whole, half, 1.0}));
    }
  }
  const auto ratio_buffer = test_device().upload(ratios, "ratios");
  const auto out = test_device().buffer(words.size() * sizeof(float), "covered");
  run_kernel(program, "covered", words.size(), states, ratio_buffer, out, static_cast<cl_uint>(words.size()));
  const auto covered = test_device().download<float>(out, words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    REQUIRE(static_cast<double>(covered[i]) == Approx(expected[i]).epsilon(1e-5));
}

TEST_CASE("a pixel whose probes find full discs alone divides by 1 for ever, and is seldom probed") {
  auto program = build_test_program(source, EFFECT_TRIANGLES);
  constexpr std::size_t each = 1000;
  std::vector<cl_uint> probes(each);
  for (std::size_t k = 0; k < each; ++k)
    probes[k] = KERNEL_AREA_PROBED | (k % 4 == 3 ? KERNEL_AREA_OF_HALF : 0u) | 1u << KERNEL_AREA_SHIFT;
  const auto states = test_device().buffer(each * sizeof(cl_uint), "states");
  cl::Kernel means(program, "means");
  const auto in = test_device().upload(probes, "probes");
  set_arguments(means, in, states, static_cast<cl_uint>(each), cl_uint{1});
  test_device().launch(means, 1);
  auto words = test_device().download<cl_uint>(states, each);
  for (const cl_uint word : words) {
    REQUIRE((word & 127u) == (word >> 7 & 511u));
    REQUIRE((word >> 16 & 127u) == word >> 23);
  }
  // After few probes one of each pass; then each pixel's own turn, of each of four strata; elsewhere all.
  cl::Kernel wanted(program, "wanted");
  const auto asked = test_device().buffer(3 * 64 * 4 * sizeof(cl_uint), "asked");
  const std::vector<cl_uint> kinds{words[3], words[500], words[500] - (1u << 7)};
  const auto kind_states = test_device().upload(kinds, "kinds");
  set_arguments(wanted, kind_states, asked, cl_uint{12});
  test_device().launch(wanted, 3 * 64 * 4);
  const auto found = test_device().download<cl_uint>(asked, 3 * 64 * 4);
  for (std::size_t kind = 0; kind < 3; ++kind) {
    std::array<int, 4> times{};
    for (std::size_t i = 0; i < 64 * 4; ++i) times[i % 4] += static_cast<int>(found[kind * 64 * 4 + i]);
    INFO("kind " << kind);
    for (const int time : times) {
      if (kind == 0) CHECK(time == 16);
      if (kind == 1) CHECK((time >= 2 && time <= 3));
      if (kind == 2) CHECK(time == 64);
    }
  }
}
