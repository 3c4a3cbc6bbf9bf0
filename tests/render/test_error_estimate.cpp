// From the errors of pixels to that of a picture and to what is still to be done.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "error_estimate.hpp"

using namespace causticl;

namespace {

constexpr unsigned seed = 71;

/// Pixels of many luminances, noises and biases.
std::vector<PixelError> many_pixels(std::mt19937& engine) {
  std::uniform_real_distribution<float> uniform;
  std::vector<PixelError> pixels(20000);
  for (auto& pixel : pixels) {
    pixel.luminance = std::pow(10.0f, 4 * uniform(engine) - 2);
    pixel.noise = pixel.luminance * 0.1f * uniform(engine);
    pixel.bias = uniform(engine) < 0.3f ? pixel.luminance * 0.2f * uniform(engine) : 0.0f;
  }
  return pixels;
}

/// The share of pixels off by less than `error` times what they are judged against, as drawn.
double share_within(const std::vector<PixelError>& pixels, double error, std::mt19937& engine) {
  double mean = 0, within = 0;
  for (const auto& pixel : pixels) mean += pixel.luminance / static_cast<double>(pixels.size());
  std::normal_distribution<double> normal;
  for (const auto& pixel : pixels)
    within += std::fabs(pixel.bias + pixel.noise * normal(engine)) <=
              error * std::max<double>(pixel.luminance, 0.1 * mean);
  return within / static_cast<double>(pixels.size());
}

}  // namespace

TEST_CASE("the error of a picture is what its share of pixels stays below") {
  CAPTURE(seed);
  std::mt19937 engine(seed);
  const auto pixels = many_pixels(engine);
  for (const double confidence : {0.5, 0.9, 0.99}) {
    const auto error = picture_error(pixels, confidence);
    REQUIRE(error);
    CHECK(share_within(pixels, error->error, engine) == Approx(confidence).margin(0.006));
    CHECK(error->noise < error->error);
    CHECK(error->bias < error->error);
  }
}

TEST_CASE("noise alone and bias alone are what they would be without the other") {
  std::vector<PixelError> pixels(1000, {2, 0.1f, 0, 0});
  auto error = picture_error(pixels, 0.9);
  CHECK(error->error == Approx(0.05 * 1.6449).epsilon(6e-3));
  CHECK(error->noise == error->error);
  CHECK(error->bias == 0);
  for (auto& pixel : pixels) pixel = {2, 0, 0, 0.1f};
  error = picture_error(pixels, 0.9);
  CHECK(error->error == Approx(0.05).epsilon(6e-3));
  CHECK(error->noise == 0);
}

TEST_CASE("a black picture has no known error, and one without noise has none") {
  CHECK(!picture_error(std::vector<PixelError>(10), 0.9));
  CHECK(!picture_error({}, 0.9));
  CHECK(picture_error(std::vector<PixelError>(10, {1, 0, 0, 0}), 0.9)->error == 0);
}

TEST_CASE("dark pixels are judged against a tenth of the mean") {
  std::vector<PixelError> pixels(1000, {1, 0, 0, 0});
  for (std::size_t i = 0; i < 500; ++i) pixels[i] = {1e-6f, 0, 0, 0.01f};
  // 0.01 against a tenth of the mean of 0.5.
  CHECK(picture_error(pixels, 0.9)->error == Approx(0.2).epsilon(6e-3));
}

TEST_CASE("a trend follows the rate that is measured, and starts from the one that is expected") {
  const auto noisy = [](double noise) {
    return std::vector<PixelError>(100, {1, static_cast<float>(noise), 0, 0});
  };
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
  CHECK(trend.rates().noise == Approx(0.35).margin(0.015));
  CHECK(trend.passes_until(trend.last()->error / 2) == Approx(128 * std::pow(2, 1 / 0.35)).epsilon(0.08));
}

TEST_CASE("bias goes down at its own rate, and what does not go down never ends") {
  const std::vector<PixelError> biased(100, {1, 0, 0, 0.1f});
  ErrorTrend trend({0.35, 0.2}, 0.9);
  trend.add(10, biased);
  CHECK(trend.passes_until(0.05) == Approx(10 * std::pow(2, 1 / 0.2)).epsilon(0.02));
  ErrorTrend constant({0.35, 0}, 0.9);
  constant.add(10, biased);
  CHECK(constant.passes_until(0.05) == INFINITY);
  // An error that went down and does so no more.
  ErrorTrend halted({0.35, 0.2}, 0.9);
  for (const std::uint64_t passes : {16, 20, 24, 32, 40, 48, 64}) halted.add(passes, biased);
  CHECK(halted.passes_until(0.05) == INFINITY);
  // Between the two: noise falls away, and the bias is left.
  ErrorTrend both({0.5, 0.2}, 0.9);
  both.add(10, std::vector<PixelError>(100, {1, 0.1f, 0, 0.1f}));
  const double half = both.passes_until(both.last()->error / 2);
  CHECK((half > 10 * std::pow(2, 1 / 0.5) && half < 10 * std::pow(2, 1 / 0.2)));
}
