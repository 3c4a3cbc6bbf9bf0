#include <bit>
#include <cstring>
#include <limits>

#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "film/film.cl"
// Each work-item adds `count` numbers of a linear congruential sequence, each an integer over 2^24.
kernel void sum_many(global float2 *sums, uint items, uint count, uint mask) {
  uint i = get_global_id(0);
  if (i >= items) return;
  float hi = 0, lo = 0;
  uint state = i * 747796405u + 1u;
  for (uint n = 0; n < count; ++n) {
    state = state * 1664525u + 1013904223u;
    sum_add(&hi, &lo, (float)((state >> 8) | mask) * 5.9604644775390625e-8f);
  }
  sums[i] = (float2)(hi, lo);
}
// Each work-item adds `count` samples to its own pixel.
kernel void add_samples(global const float4 *samples, global FilmPixel *film, volatile global Counters *counters,
                        uint pixels, uint count) {
  uint i = get_global_id(0);
  if (i >= pixels) return;
  for (uint n = 0; n < count; ++n) film_add(film + i, samples[i * count + n].xyz, samples[i * count + n].w, n, counters);
}
)";

/// Largest relative error of the sums of `count` numbers each, against exact integer sums. A mask of 2^24 - 1
/// makes all of them the same number.
double sum_error(uint items, uint count, uint mask) {
  auto program = build_test_program(source);
  auto out = test_device().buffer(items * sizeof(float2), "sums");
  run_kernel(program, "sum_many", items, out, items, count, mask);
  const auto sums = test_device().download<float2>(out, items);
  double worst = 0;
  for (uint i = 0; i < items; ++i) {
    std::uint64_t exact = 0;
    uint state = i * 747796405u + 1u;
    for (uint n = 0; n < count; ++n) {
      state = state * 1664525u + 1013904223u;
      exact += (state >> 8) | mask;
    }
    const double expected = std::ldexp(static_cast<double>(exact), -24);
    worst = std::max(worst, std::fabs((double(sums[i].x) + sums[i].y) / expected - 1));
    // The two halves do not overlap, so that hi alone is the rounded sum.
    CHECK(static_cast<float>(double(sums[i].x) + sums[i].y) == sums[i].x);
  }
  return worst;
}

/// Adds `count` samples to each pixel on the device.
std::vector<FilmPixel> add_samples(const std::vector<float4>& samples, uint pixels, Counters& counters) {
  auto program = build_test_program(source);
  auto in = test_device().upload(samples, "samples");
  auto film = test_device().buffer(pixels * sizeof(FilmPixel), "film");
  test_device().clear(film, pixels * sizeof(FilmPixel));
  auto counter = test_device().buffer(sizeof(Counters), "counters");
  test_device().clear(counter, sizeof(Counters));
  run_kernel(program, "add_samples", pixels, in, film, counter, pixels, uint(samples.size() / pixels));
  counters = test_device().download<Counters>(counter, 1)[0];
  return test_device().download<FilmPixel>(film, pixels);
}

}  // namespace

TEST_CASE("running sums of ten million numbers are exact to 1e-9") {
  CHECK(sum_error(2, 10000000, 0) < 1e-9);
  CHECK(sum_error(1, 10000000, 0xffffffu) < 1e-9);
}

TEST_CASE("running sums of a hundred million numbers are exact to 1e-9", "[long]") {
  CHECK(sum_error(2, 100000000, 0) < 1e-9);
  CHECK(sum_error(1, 100000000, 0xffffffu) < 1e-9);
}

TEST_CASE("the film adds every channel exactly, whatever the samples' sizes") {
  RandomInputs random(51);
  constexpr uint pixels = 64, count = 1 << 14;
  std::vector<float4> samples(pixels * count);
  std::vector<long double> expected(3 * pixels);
  for (uint i = 0; i < pixels * count; ++i) {
    float* channel = &samples[i].x;
    for (uint c = 0; c < 3; ++c) {
      channel[c] = static_cast<float>(std::pow(10, random.uniform(-6, 3)));
      expected[3 * (i / count) + c] += channel[c];
    }
  }
  Counters counters{};
  const auto film = add_samples(samples, pixels, counters);
  double worst = 0;
  for (uint i = 0; i < 3 * pixels; ++i) {
    const FilmPixel& pixel = film[i / 3];
    const long double sum = static_cast<long double>(pixel.sum[i % 3]) + pixel.low[i % 3];
    worst = std::max(worst, static_cast<double>(std::fabs(sum / expected[i] - 1)));
  }
  CHECK(worst < 1e-10);
  CHECK(counters.non_finite == 0);
}

TEST_CASE("samples that are not finite change counters and no pixel's sum") {
  RandomInputs random(52);
  constexpr uint pixels = 1024, count = 1024;
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  std::vector<float4> samples(pixels * count), clean;
  uint bad = 0;
  for (auto& sample : samples) {
    sample = {float(random.uniform()), float(random.uniform()), float(random.uniform()), 0};
    clean.push_back(sample);
    if (random.uniform() > 0.01) continue;
    // 0 changes no sum, so the clean film has it in the place of what is left out.
    clean.back() = {};
    (&sample.x)[bad % 3] = bad % 7 < 3 ? nan : bad % 7 < 5 ? infinity : -infinity;
    ++bad;
  }
  Counters counters{}, none{};
  const auto film = add_samples(samples, pixels, counters), without = add_samples(clean, pixels, none);
  CHECK(bad > 5000);
  CHECK(counters.non_finite == bad);
  CHECK((counters.photons == 0 && counters.rays == 0 && counters.saturated == 0));
  CHECK(none.non_finite == 0);
  uint left_out = 0;
  for (uint i = 0; i < pixels; ++i) {
    left_out += film[i].left_out;
    CHECK(std::memcmp(film[i].sum, without[i].sum, sizeof(float[6])) == 0);
  }
  CHECK(left_out == bad);
}

TEST_CASE("the film's spread, blur and alternating sum equal two-pass ones of its finite estimates") {
  RandomInputs random(53);
  constexpr uint pixels = 256, count = 300;
  std::vector<float4> samples(pixels * count);
  for (auto& sample : samples) {
    const double size = random.uniform() < 0.01 ? 50 : 1;
    sample = {float(size * random.uniform()), float(size * random.uniform()), float(size * random.uniform()),
              float(random.uniform(-1, 2))};
    if (random.uniform() < 0.01) sample.y = std::numeric_limits<float>::quiet_NaN();
  }
  Counters counters{};
  const auto film = add_samples(samples, pixels, counters);
  for (uint i = 0; i < pixels; ++i) {
    double sum = 0, m2_deviation = 0, signed_half_sum = 0, kernel_bias[2] = {};
    std::vector<double> finite;
    int in_half[2] = {0, 0};
    for (uint n = 0; n < count; ++n) {
      const float4& s = samples[i * count + n];
      const int half = std::popcount(n) % 2;
      ++in_half[half];
      if (std::isnan(s.y)) continue;                        // the mean of blur stays as it is
      const bool minus = std::popcount(finite.size()) % 2;  // those that are left out take no sign
      finite.push_back(0.2126 * s.x + 0.7152 * s.y + 0.0722 * s.z);
      signed_half_sum += minus ? -finite.back() : finite.back();
      sum += finite.back();
      kernel_bias[half] += (s.w - kernel_bias[half]) / in_half[half];
    }
    const double mean = sum / static_cast<double>(finite.size());
    for (const double value : finite) m2_deviation += (value - mean) * (value - mean);
    CHECK(film[i].m2_deviation ==
          Approx(std::sqrt(m2_deviation / static_cast<double>(finite.size()))).epsilon(1e-5));
    CHECK(film[i].signed_half_sum == Approx(signed_half_sum).epsilon(1e-5).margin(1e-3));
    for (int parity = 0; parity < 2; ++parity)
      CHECK(film[i].kernel_bias[parity] == Approx(kernel_bias[parity]).margin(1e-4));
  }
}

TEST_CASE("spread and blur are as relative to light of any brightness, and after a thousand million passes") {
  RandomInputs random(54);
  constexpr uint pixels = 64, count = 200;
  std::vector<float4> samples(pixels * count);
  for (auto& sample : samples) {
    const float value = float(random.uniform());
    sample = {value, value, value, float(random.uniform(-1, 2))};
  }
  Counters counters{};
  const auto plain = add_samples(samples, pixels, counters);
  for (const int power : {-110, -100, -60, 60, 100, 110}) {
    auto scaled = samples;
    for (auto& sample : scaled)
      sample = {std::ldexp(sample.x, power), std::ldexp(sample.y, power), std::ldexp(sample.z, power),
                std::ldexp(sample.w, power)};
    const auto film = add_samples(scaled, pixels, counters);
    CAPTURE(power, random.seed);
    for (uint i = 0; i < pixels; ++i) {
      CHECK(std::ldexp(film[i].m2_deviation, -power) == Approx(plain[i].m2_deviation).epsilon(1e-4));
      CHECK(std::ldexp(film[i].kernel_bias[0], -power) == Approx(plain[i].kernel_bias[0]).epsilon(1e-4));
    }
  }

  // Estimates of 0 and 2 in turn: mean 1, deviation 1. A sum of squares in a float would have stopped
  // growing.
  auto program = build_test_program(R"(
#include "film/film.cl"
kernel void go_on(global FilmPixel *film, volatile global Counters *counters, uint first, uint passes) {
  if (get_global_id(0) != 0) return;  // more items may run than were asked for
  for (uint n = first; n < first + passes; ++n) film_add(film, (real3)(2 * (n & 1u)), 2 * (n & 1u), n, counters);
}
)");
  constexpr uint first = 1000000000, more = 2000000;
  FilmPixel pixel{};
  for (float& sum : pixel.sum) sum = first;
  pixel.m2_deviation = 1;
  pixel.kernel_bias[0] = pixel.kernel_bias[1] = 1;
  auto film = test_device().upload(std::vector<FilmPixel>{pixel}, "film");
  auto counts = test_device().upload(std::vector<Counters>(1), "counters");
  run_kernel(program, "go_on", 1, film, counts, cl_uint(first), cl_uint(more));
  const FilmPixel now = test_device().download<FilmPixel>(film, 1)[0];
  CHECK(now.m2_deviation == Approx(1).epsilon(0.05));
  CHECK(now.kernel_bias[0] == Approx(1).epsilon(0.01));
  CHECK(now.sum[0] + double(now.low[0]) == Approx(double(first) + more).epsilon(1e-6));
}
