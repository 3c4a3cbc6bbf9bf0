// From the errors of pixels to that of a picture and to what is still to be done.
#include <cmath>
#include <random>

#include "accuracy/error_estimate.hpp"
#include "catch2.hpp"

using namespace causticl;

namespace {

constexpr unsigned seed = 71;

/// Pixels of many luminances, noises and biases.
std::vector<PixelError> many_pixels(std::mt19937& engine) {
  std::uniform_real_distribution<float> uniform;
  std::normal_distribution<float> normal;
  std::vector<PixelError> pixels(20000);
  for (auto& pixel : pixels) {
    pixel.luminance = std::pow(10.0f, 4 * uniform(engine) - 2);
    pixel.noise = pixel.luminance * 0.1f * uniform(engine);
    pixel.half_difference = pixel.noise * normal(engine);
    pixel.bias = uniform(engine) < 0.3f ? pixel.luminance * 0.2f * uniform(engine) : 0.0f;
  }
  return pixels;
}

/// The fraction of pixels off by less than `error` times what they are judged against, as drawn.
double fraction_within(const std::vector<PixelError>& pixels, double error, std::mt19937& engine) {
  double mean = 0, within = 0;
  for (const auto& pixel : pixels) mean += pixel.luminance / static_cast<double>(pixels.size());
  std::normal_distribution<double> normal;
  for (const auto& pixel : pixels)
    within += std::fabs(pixel.bias + pixel.noise * normal(engine)) <=
              error * std::max<double>(pixel.luminance, 0.1 * mean);
  return within / static_cast<double>(pixels.size());
}

/// As many pixels of luminance 1 whose errors lie at even steps of a normal distribution's probability.
std::vector<PixelError> even_pixels(double noise, double bias) {
  constexpr int count = 2000;
  std::vector<PixelError> pixels;
  double half_difference = -4;
  for (int i = 0; i < count; ++i) {
    while (0.5 * std::erfc(-half_difference / std::sqrt(2)) < (i + 0.5) / count) half_difference += 1e-4;
    pixels.push_back({1, static_cast<float>(noise), 0, static_cast<float>(bias),
                      static_cast<float>(noise * half_difference)});
  }
  return pixels;
}

}  // namespace

TEST_CASE("the error of a picture is what its fraction of pixels stays below") {
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const auto pixels = many_pixels(engine);
  for (const double confidence : {0.5, 0.9, 0.99}) {
    const auto error = picture_error(pixels, confidence);
    REQUIRE(error);
    CHECK(fraction_within(pixels, error->error, engine) == Approx(confidence).margin(0.006));
    CHECK(error->noise < error->error);
    CHECK(error->bias < error->error);
  }
}

TEST_CASE("noise alone and bias alone are what they would be without the other") {
  auto pixels = even_pixels(0.05, 0);
  auto error = picture_error(pixels, 0.9);
  CHECK(error->error == Approx(0.05 * 1.6449).epsilon(6e-3));
  CHECK(error->noise == error->error);
  CHECK(error->bias == 0);
  for (auto& pixel : pixels) pixel = {2, 0, 0, 0.1f, 0};
  error = picture_error(pixels, 0.9);
  CHECK(error->error == Approx(0.05).epsilon(6e-3));
  CHECK(error->noise == 0);
}

TEST_CASE("a black picture has no known error, and one without noise has none") {
  CHECK(!picture_error(std::vector<PixelError>(10), 0.9));
  CHECK(!picture_error({}, 0.9));
  CHECK(picture_error(std::vector<PixelError>(10, {1, 0, 0, 0, 0}), 0.9)->error == 0);
}

TEST_CASE("dark pixels are judged against a tenth of the mean") {
  std::vector<PixelError> pixels(1000, {1, 0, 0, 0, 0});
  for (std::size_t i = 0; i < 500; ++i) pixels[i] = {1e-6f, 0, 0, 0.01f, 0};
  // 0.01 against a tenth of the mean of 0.5.
  CHECK(picture_error(pixels, 0.9)->error == Approx(0.2).epsilon(6e-3));
}

TEST_CASE("a trend follows the rate that is measured, and starts from the one that is expected") {
  const auto noisy = [](double noise) { return even_pixels(noise, 0); };
  ErrorTrend trend({0.5, 0}, 0.9);
  CHECK(!trend.last());
  trend.add(2, noisy(0.4));
  const double error = trend.last()->error;
  CHECK(error == Approx(0.4 * 1.6449).epsilon(6e-3));
  CHECK(trend.rates().noise == Approx(0.5));
  CHECK(trend.passes_until(error / 2) == Approx(8).epsilon(0.01));
  CHECK(trend.passes_until(error * 1.1) == 2);
  for (const std::uint64_t passes : {4, 8, 16, 32, 64, 128})
    trend.add(passes, noisy(0.4 * std::pow(passes / 2.0, -0.35)));
  // What was expected weighs three parts in eight: looks one and two octaves back weigh one and four.
  const double rate = trend.rates().noise;
  CHECK(rate == Approx(0.35 + 3.0 / 8 * (0.5 - 0.35)).margin(0.01));
  CHECK(trend.passes_until(trend.last()->error / 2) == Approx(128 * std::pow(2, 1 / rate)).epsilon(0.01));
}

TEST_CASE("bias goes down at the rate that is expected, and what does not go down never ends") {
  const std::vector<PixelError> biased(100, {1, 0, 0, 0.1f, 0});
  ErrorTrend trend({0.35, 0.2}, 0.9);
  trend.add(10, biased);
  CHECK(trend.passes_until(0.05) == Approx(10 * std::pow(2, 1 / 0.2)).epsilon(0.02));
  ErrorTrend constant({0.35, 0}, 0.9);
  constant.add(10, biased);
  CHECK(constant.passes_until(0.05) == INFINITY);
  // What it has done so far tells nothing.
  ErrorTrend halted({0.35, 0.2}, 0.9);
  for (const std::uint64_t passes : {16, 20, 24, 32, 40, 48, 64}) halted.add(passes, biased);
  CHECK(halted.passes_until(0.05) == Approx(64 * std::pow(2, 1 / 0.2)).epsilon(0.02));
  CHECK(halted.rates().bias == 0.2);
  // Nor does it beside noise that goes down.
  ErrorTrend noisy({0.35, 0.2}, 0.9);
  for (const std::uint64_t passes : {16, 20, 24, 32, 40, 48, 64})
    noisy.add(passes, even_pixels(std::pow(passes, -0.4), 0.1));
  CHECK(noisy.rates().bias == 0.2);
  // The two kinds of noise of SPPM, and a bias between that of areas and that of edges.
  CHECK(sppm_rates(0.7).noise == Approx((0.35 + 0.5) / 2));
  CHECK((sppm_rates(0.7).bias < 0.3 && sppm_rates(0.7).bias > 0.15));
  // Between the two: noise falls away, and the bias is left.
  ErrorTrend both({0.5, 0.2}, 0.9);
  both.add(10, even_pixels(0.1, 0.1));
  const double half = both.passes_until(both.last()->error / 2);
  CHECK((half > 10 * std::pow(2, 1 / 0.5) && half < 10 * std::pow(2, 1 / 0.2)));
}

TEST_CASE("a course of noise and bias is followed to where it halves") {
  // The noise is below the bias from about the hundredth pass on, and half the error is far beyond that.
  const auto at = [](double passes) {
    return even_pixels(0.8 * std::pow(passes, -0.45), 0.2 * std::pow(passes, -0.2));
  };
  ErrorTrend trend({0.4, 0.2}, 0.9);
  for (std::uint64_t passes = 4; passes <= 128; passes += std::max<std::uint64_t>(1, passes / 5))
    trend.add(passes, at(static_cast<double>(passes)));
  const double half = trend.last()->error / 2, told = trend.passes_until(half);
  CHECK(picture_error(at(told / 1.25), 0.9)->error > half);
  CHECK(picture_error(at(told * 1.25), 0.9)->error < half);
}

TEST_CASE("rare large errors do not count for more pixels than they are in") {
  // All pixels have the same deviation, but what was drawn is in 2% of them.
  std::vector<PixelError> pixels(1000, {1, 0.1f, 0, 0, 0.01f});
  for (std::size_t i = 0; i < pixels.size(); i += 50) pixels[i].half_difference = 0.7f;
  CHECK(picture_error(pixels, 0.9)->error == Approx(0.01));
  CHECK(picture_error(pixels, 0.99)->error == Approx(0.7));
}
