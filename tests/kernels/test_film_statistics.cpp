// What the sums of a pixel tell: its mean, deviation, kernel bias and half difference.
#include <bit>
#include <limits>

#include "kernels/film_samples.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

TEST_CASE(
    "the film's deviation, kernel bias and half difference equal two-pass ones of its finite estimates") {
  RandomInputs random(53);
  constexpr uint pixels = 256;
  for (const uint count : {1u, 2u, 3u, 7u, 300u}) {
    std::vector<float4> samples(pixels * count);
    for (uint i = 0; i < pixels * count; ++i) {
      const double size = random.uniform() < 0.01 ? 50 : 1;
      // Some pixels with estimates that hardly differ from each other.
      const double least = i / count % 4 == 0 ? 1000 : 0;
      const auto number = [&] { return static_cast<float>(least + size * random.uniform()); };
      samples[i] = {number(), number(), number(), float(random.uniform(-1, 2))};
      if (count > 7 && random.uniform() < 0.01) samples[i].y = std::numeric_limits<float>::quiet_NaN();
    }
    Counters counters{};
    const auto statistics = statistics_of(add_samples(samples, pixels, counters), count);
    for (uint i = 0; i < pixels; ++i) {
      double kernel_bias[2] = {}, half[2] = {};
      std::vector<double> finite;
      double in_half[2] = {0, 0};
      for (uint n = 0; n < count; ++n) {
        const float4& s = samples[i * count + n];
        if (std::isnan(s.y)) continue;
        const int which = std::popcount(n) % 2;
        ++in_half[which];
        finite.push_back(0.2126 * s.x + 0.7152 * s.y + 0.0722 * s.z);
        half[which] += finite.back();
        kernel_bias[which] += s.w;
      }
      const double all = static_cast<double>(finite.size());
      double sum = 0, squares = 0;
      for (const double value : finite) sum += value;
      for (const double value : finite) squares += (value - sum / all) * (value - sum / all);
      CAPTURE(i, count, random.seed);
      CHECK(statistics[i].estimates == all);
      // Luminance is of 14 bits.
      CHECK(statistics[i].luminance == Approx(sum / all).epsilon(1e-4));
      CHECK(statistics[i].deviation ==
            Approx(std::sqrt(squares / all)).epsilon(1e-3).margin(sum / all * 0x1p-13));
      for (int k = 0; k < 2; ++k)
        CHECK(statistics[i].kernel_bias[k] ==
              Approx(kernel_bias[k] / std::max(1.0, in_half[k])).margin(1e-6));
      const double difference = half[0] / std::max(1.0, in_half[0]) - half[1] / std::max(1.0, in_half[1]);
      CHECK(statistics[i].half_difference == Approx(difference * std::sqrt(in_half[0] * in_half[1]) / all)
                                                 .epsilon(1e-3)
                                                 .margin(sum / all * 0x1p-13));
    }
  }
}

TEST_CASE("estimates that are all the same have no deviation, after any number of passes") {
  constexpr uint count = 1 << 15;
  for (const float value : {1.0f, 0.1f, 1234.567f, 1e-30f, 3e30f}) {
    Counters counters{};
    const auto film = add_samples(std::vector<float4>(count, {value, value, value, 0}), 1, counters);
    const PixelStatistics one = statistics_of(film, count)[0];
    CAPTURE(value);
    CHECK(one.deviation <= 1e-6 * value);
    CHECK(one.half_difference == 0);
  }
}

TEST_CASE("deviation and kernel bias are as relative to light of any brightness") {
  RandomInputs random(54);
  constexpr uint pixels = 64, count = 200;
  std::vector<float4> samples(pixels * count);
  for (auto& sample : samples) {
    const float value = float(random.uniform());
    sample = {value, value, value, float(random.uniform(-1, 2))};
  }
  Counters counters{};
  const auto plain = statistics_of(add_samples(samples, pixels, counters), count);
  for (const int power : {-110, -100, -60, 60, 100, 110}) {
    auto scaled = samples;
    for (auto& sample : scaled)
      sample = {std::ldexp(sample.x, power), std::ldexp(sample.y, power), std::ldexp(sample.z, power),
                std::ldexp(sample.w, power)};
    const auto film = statistics_of(add_samples(scaled, pixels, counters), count);
    CAPTURE(power, random.seed);
    for (uint i = 0; i < pixels; ++i) {
      CHECK(std::ldexp(film[i].deviation, -power) == Approx(plain[i].deviation).epsilon(1e-3));
      CHECK(std::ldexp(film[i].half_difference, -power) ==
            Approx(plain[i].half_difference).epsilon(1e-3).margin(1e-5));
      CHECK(std::ldexp(film[i].kernel_bias[0], -power) == Approx(plain[i].kernel_bias[0]).epsilon(1e-4));
    }
  }
}

TEST_CASE("sums and deviation go on after a thousand million passes") {
  // Estimates of 0 and 2 in turn: mean 1, deviation 1. A sum of squares in a float would have stopped
  // growing.
  auto program = build_test_program(R"(
#include "film/film.cl"
kernel void go_on(global FilmPixel *film, volatile global Counters *counters, uint first, uint passes) {
  if (get_global_id(0) != 0) return;  // more items may run than were asked for
  for (uint n = first; n < first + passes; ++n) film_add(film, (real3)(2 * (n & 1u)), 2 * (n & 1u), n, counters);
}
)");
  // As many passes before, of the same sums: those of a short render, as often as is wanted.
  constexpr uint times = 1000000, short_passes = 1000, more = 2000000, first = times * short_passes;
  auto film = test_device().upload(std::vector<FilmPixel>(1), "film");
  auto counts = test_device().upload(std::vector<Counters>(1), "counters");
  run_kernel(program, "go_on", 1, film, counts, cl_uint(0), cl_uint(short_passes));
  FilmPixel pixel = test_device().download<FilmPixel>(film, 1)[0];
  const auto multiply = [](ExactSum& sum) {
    sum = exact_sum_bins(sum.high * times, exact_sum_low(sum) * times, exact_sum_bin(sum));
  };
  for (ExactSum* sums : {pixel.radiance, pixel.luminance, pixel.kernel_bias})
    multiply(sums[0]), multiply(sums[1]);
  multiply(pixel.radiance[2]);
  multiply(pixel.luminance2);
  film = test_device().upload(std::vector<FilmPixel>{pixel}, "film");
  run_kernel(program, "go_on", 1, film, counts, cl_uint(first), cl_uint(more));
  const FilmPixel now = test_device().download<FilmPixel>(film, 1)[0];
  const PixelStatistics one = statistics_of({now}, first + more)[0];
  CHECK(mean_of(now.radiance[0], 1) == double(first) + more);
  CHECK(one.luminance == Approx(1).epsilon(1e-4));
  CHECK(one.deviation == Approx(1).epsilon(1e-4));
  CHECK(one.kernel_bias[0] == Approx(1).epsilon(1e-4));
}
