#include <algorithm>
#include <cstring>
#include <limits>

#include "kernels/film_samples.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "photons/sppm.cl"
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
    const long double sum = mean_of(pixel.radiance[i % 3], 1);
    worst = std::max(worst, static_cast<double>(std::fabs(sum / expected[i] - 1)));
  }
  CHECK(worst < 1e-7);  // of 10^-6 beside 10^3 no more than 2^-28 of that is lost
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
    left_out += film[i].left_out[0] + film[i].left_out[1];
    CHECK(std::memcmp(film[i].radiance, without[i].radiance, sizeof film[i].radiance) == 0);
  }
  CHECK(left_out == bad);
}

TEST_CASE("exact sums have the same bits in any order and in any parts, on the device and on the host") {
  RandomInputs random(55);
  constexpr uint pixels = 64, count = 500;
  std::vector<float4> samples(pixels * count);
  for (auto& sample : samples)
    for (float* x : {&sample.x, &sample.y, &sample.z, &sample.w})
      *x = static_cast<float>(std::pow(10, random.uniform(-44, 38)));
  Counters counters{};
  const auto film = add_samples(samples, pixels, counters);
  for (uint i = 0; i < pixels; ++i) {
    const auto own = samples.begin() + i * count;
    std::vector<float> numbers;
    for (uint n = 0; n < count; ++n) numbers.push_back(own[n].x);
    std::shuffle(numbers.begin(), numbers.end(), random.engine);
    ExactSum parts[3]{};
    for (uint n = 0; n < count; ++n) {
      ExactSum& part = parts[random.engine() % 3];
      part = exact_sum_add(part, numbers[n]);
    }
    std::shuffle(std::begin(parts), std::end(parts), random.engine);
    const ExactSum whole = exact_sum_of_parts(exact_sum_of_parts(parts[0], parts[1]), parts[2]);
    CAPTURE(i, random.seed);
    CHECK(whole.high == film[i].radiance[0].high);
    CHECK(whole.low_and_bin == film[i].radiance[0].low_and_bin);
  }
}
