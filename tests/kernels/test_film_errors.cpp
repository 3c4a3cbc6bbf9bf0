// The film's estimate of its own error against the same sums in double precision, and against pixels whose
// error is known.
#include <bit>
#include <cmath>
#include <tuple>

#include "accuracy/error_estimate.hpp"
#include "kernels/film_samples.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

std::vector<PixelError> device_errors(const std::vector<PixelStatistics>& film, uint width, uint stride,
                                      bool low_discrepancy = false, uint found = 1) {
  auto program = build_test_program("#include \"passes/pass_film.cl\"\n");
  auto pixels = test_device().upload(film, "film");
  const uint count = (static_cast<uint>(film.size()) + stride - 1) / stride;
  const uint height = static_cast<uint>(film.size()) / width;
  auto errors = test_device().buffer(count * sizeof(PixelError), "errors");
  run_kernel(program, "pixel_errors", count, pixels, errors,
             test_device().upload(std::vector<uint>{found}, "found"), cl_uint2{{width, height}},
             cl_uint4{{0, 0, width, height}}, stride, count, uint(low_discrepancy));
  return test_device().download<PixelError>(errors, count);
}

/// The same as the kernel's comment says, by the definition.
struct Oracle {
  double noise, pooled_noise, bias, half_difference;
};
Oracle oracle(const std::vector<PixelStatistics>& film, int width, int x, int y, bool even_estimates) {
  const int height = static_cast<int>(film.size()) / width;
  int reach = 1;
  const auto over_window = [&](int x_of, int y_of, auto add) {
    int count = 0;
    for (int j = std::max(0, y_of - reach); j <= std::min(height - 1, y_of + reach); ++j)
      for (int i = std::max(0, x_of - reach); i <= std::min(width - 1, x_of + reach); ++i, ++count)
        add(film[static_cast<std::size_t>(j) * width + i]);
    return static_cast<double>(count);
  };
  const auto variance_of = [&](const PixelStatistics& p) {
    return std::pow(p.deviation, 2) / std::max(p.estimates - 1.0, 1.0);
  };
  double variance = 0;
  const double pixels = over_window(x, y, [&](const PixelStatistics& p) { variance += variance_of(p); });
  double wide = 0;
  reach = 2;
  const double wide_pixels = over_window(x, y, [&](const PixelStatistics& p) { wide += variance_of(p); });
  reach = 1;
  double noise = 0, square = 0;
  int windows = 0;
  for (int j = y - 3; j <= y + 3; j += 3)
    for (int i = x - 3; i <= x + 3; i += 3) {
      double first = 0, second = 0;
      const double count = over_window(i, j, [&](const PixelStatistics& p) {
        first += p.kernel_bias[0];
        second += p.kernel_bias[1];
      });
      if (count == 0) continue;
      ++windows;
      noise += std::pow((first - second) / (2 * count), 2);
      if (i == x && j == y) square = std::pow((first + second) / (2 * count), 2);
    }
  const PixelStatistics& own = film[static_cast<std::size_t>(y) * width + x];
  double ratio = 1;
  if (even_estimates) {
    double squares = 0, variances = 0;
    reach = 3;
    over_window(x, y, [&](const PixelStatistics& p) {
      squares += std::pow(p.half_difference, 2);
      variances += variance_of(p);
    });
    ratio = squares / variances;
  }
  return {std::sqrt(ratio * (0.98 * variance_of(own) + 0.02 * variance / pixels)),
          std::sqrt(ratio * std::max(variance / pixels, 12.0 / (12 + own.estimates) * wide / wide_pixels)),
          2 * std::sqrt(std::max(0.0, square - 2 * noise / windows)), own.half_difference};
}

/// The film of pixels that have each had `passes` estimates of luminance (x), with what their kernel blurs of
/// it (y).
std::vector<FilmPixel> film_of(const std::vector<float2>& samples, uint passes) {
  std::vector<float4> estimates;
  for (const float2& sample : samples) estimates.push_back({sample.x, sample.x, sample.x, sample.y});
  Counters counters{};
  return add_samples(estimates, static_cast<uint>(samples.size()) / passes, counters);
}

double normal(RandomInputs& random) { return std::normal_distribution<double>()(random.engine); }

}  // namespace

TEST_CASE("errors of pixels equal those in double precision, at borders too") {
  RandomInputs random(61);
  constexpr uint width = 37, height = 23;
  std::vector<PixelStatistics> film(width * height);
  for (auto& pixel : film) {
    pixel.luminance = static_cast<float>(random.uniform(0, 2));
    pixel.estimates = static_cast<float>(random.uniform() < 0.1 ? std::floor(random.uniform(1, 20)) : 20);
    pixel.deviation = static_cast<float>(random.uniform(0, 3));
    // The halves of the passes agree to the noise of what is beside, or do not.
    const double kernel_bias = random.uniform(0, 4);
    for (float& sum : pixel.kernel_bias) sum = static_cast<float>(kernel_bias + random.uniform(-1, 1));
    pixel.half_difference = static_cast<float>(random.uniform(-0.5, 0.5));
    pixel.unknown = random.uniform() < 0.05;
  }
  uint biased = 0;
  for (const auto& [stride, low_discrepancy] : {std::pair{1u, false}, {5u, false}, {1u, true}}) {
    const auto errors = device_errors(film, width, stride, low_discrepancy);
    REQUIRE(errors.size() == (film.size() + stride - 1) / stride);
    for (uint k = 0; k < errors.size(); ++k) {
      const uint i = k * stride;
      const Oracle expected = oracle(film, width, i % width, i / width, low_discrepancy);
      CAPTURE(i, low_discrepancy, random.seed);
      CHECK(errors[k].noise == Approx(expected.noise).epsilon(1e-5));
      CHECK(errors[k].pooled_noise == Approx(expected.pooled_noise).epsilon(1e-5));
      // A mean next to zero cancels.
      if (film[i].unknown)
        CHECK(std::isinf(errors[k].bias));
      else
        CHECK(errors[k].bias == Approx(expected.bias).epsilon(1e-3).margin(1e-4));
      biased += expected.bias > 0;
      CHECK(errors[k].half_difference == film[i].half_difference);
      CHECK(errors[k].luminance == film[i].luminance);
    }
  }
  CHECK(biased > film.size() / 2);
}

TEST_CASE("the error of all pixels is unknown where photons are stored and none has been found") {
  RandomInputs random(65);
  std::vector<PixelStatistics> film(50, {4, 1, 0.1f, {0, 0}, 0, 0});
  for (const uint found : {0u, 1u})
    for (const auto& error : device_errors(film, 10, 1, false, found))
      CHECK(std::isinf(error.bias) == (found == 0));

  // A single pixel that has found some tells.
  std::vector<FilmPixel> pixels(300);
  for (const bool any : {false, true}) {
    if (any) pixels[random.engine() % pixels.size()].missed = -1;
    uint found = 0;
    statistics_of(pixels, 4, &found);
    CHECK(found == (any ? 1u : 0u));
  }
}

TEST_CASE("noise and bias of pixels are found where they are known") {
  // Every pass of every pixel is off by a known bias and by normally distributed noise, of which the
  // difference between the two kernels has some as well. The mean's noise is sigma / sqrt(passes).
  RandomInputs random(62);
  constexpr uint width = 64, height = 64, passes = 16;
  constexpr double sigma = 0.4, bias = 0.3;
  for (const bool biased : {false, true}) {
    std::vector<float2> samples(width * height * passes);
    for (auto& sample : samples) {
      sample.x = static_cast<float>(1 + (biased ? bias : 0) + sigma * normal(random));
      sample.y = static_cast<float>((biased ? bias / 2 : 0) + sigma * normal(random));
    }
    const auto errors = device_errors(statistics_of(film_of(samples, passes), passes), width, 1);
    double noise2 = 0, pooled2 = 0, drawn2 = 0, mean_bias = 0;
    for (const auto& error : errors) {
      noise2 += error.noise * error.noise / errors.size();
      pooled2 += error.pooled_noise * error.pooled_noise / errors.size();
      drawn2 += error.half_difference * error.half_difference / errors.size();
      mean_bias += error.bias / errors.size();
    }
    CAPTURE(biased, random.seed);
    CHECK(std::sqrt(noise2) == Approx(sigma / std::sqrt(passes)).epsilon(0.02));
    CHECK(std::sqrt(pooled2) == Approx(sigma / std::sqrt(passes)).epsilon(0.02));
    CHECK(std::sqrt(drawn2) == Approx(sigma / std::sqrt(passes)).epsilon(0.05));
    // Noise of the difference alone must not pass for a bias of more than a small part of the noise.
    // What noise might have made of it is taken off.
    if (biased)
      CHECK(mean_bias == Approx(bias).epsilon(0.05));
    else
      CHECK(mean_bias < 0.3 * sigma / std::sqrt(passes));
  }
}

TEST_CASE("the noise of pixels whose estimates are even is that of their means") {
  // On the left of the picture a pixel's estimates have one number in every eighth of what they may be, in
  // each half of the passes and independently of the other half; on the right they are independent.
  RandomInputs random(64);
  constexpr uint width = 128, height = 96, passes = 16, border = 8;
  std::vector<float2> samples;
  double truth[2] = {0, 0};
  for (uint i = 0; i < width * height; ++i) {
    const bool right = i % width >= width / 2;
    std::array<uint, passes / 2> strata[2];
    for (auto& order : strata) {
      for (uint k = 0; k < order.size(); ++k) order[k] = k;
      std::shuffle(order.begin(), order.end(), random.engine);
    }
    double mean = 0;
    for (uint n = 0; n < passes; ++n) {
      const double u =
          right ? random.uniform() : (strata[std::popcount(n) % 2][n / 2] + random.uniform()) / 8;
      samples.push_back({static_cast<float>(1 + u), 0});
      mean += u / passes;
    }
    truth[right] += std::pow(mean - 0.5, 2) / (width * height / 2);
  }
  const auto film = statistics_of(film_of(samples, passes), passes);
  for (const bool low_discrepancy : {false, true}) {
    double noise[2] = {0, 0}, pooled[2] = {0, 0};
    const auto errors = device_errors(film, width, 1, low_discrepancy);
    for (uint i = 0; i < errors.size(); ++i) {
      const uint x = i % width;
      if (x + border >= width / 2 && x < width / 2 + border) continue;
      const double weight = 1.0 / (height * (width / 2 - border));
      noise[x >= width / 2] += weight * std::pow(errors[i].noise, 2);
      pooled[x >= width / 2] += weight * std::pow(errors[i].pooled_noise, 2);
    }
    CAPTURE(low_discrepancy, random.seed);
    CHECK(std::sqrt(noise[1] / truth[1]) == Approx(1).epsilon(0.05));
    CHECK(std::sqrt(pooled[1] / truth[1]) == Approx(1).epsilon(0.05));
    if (low_discrepancy) {
      CHECK(std::sqrt(noise[0] / truth[0]) == Approx(1).epsilon(0.05));
      CHECK(std::sqrt(pooled[0] / truth[0]) == Approx(1).epsilon(0.05));
    } else {
      CHECK(std::sqrt(pooled[0] / truth[0]) > 4);
    }
  }
}

TEST_CASE("errors drawn are spread as the errors of pixels whose light is rare") {
  // One estimate in forty has all the light: of sixteen, most pixels have met none.
  RandomInputs random(63);
  constexpr uint width = 128, height = 128, passes = 16;
  std::vector<FilmPixel> film(width * height);
  std::vector<double> errors;
  for (auto& pixel : film) {
    for (uint n = 0; n < passes; ++n) {
      const float value = random.uniform() < 0.025 ? 40.0f : 0.0f;
      for (ExactSum& sum : pixel.radiance) sum = exact_sum_add(sum, value);
      ExactSum& half = pixel.luminance[std::popcount(n) % 2];
      half = exact_sum_add(half, value);
    }
    errors.push_back(mean_of(pixel.radiance[0], passes) - 1);
  }
  double variance = 0, fourth = 0, drawn_variance = 0, drawn_fourth = 0;
  for (const double error : errors) {
    variance += std::pow(error, 2) / film.size();
    fourth += std::pow(error, 4) / film.size();
  }
  for (const auto& error : device_errors(statistics_of(film, passes), width, 1)) {
    drawn_variance += std::pow(error.half_difference, 2) / film.size();
    drawn_fourth += std::pow(error.half_difference, 4) / film.size();
  }
  CAPTURE(random.seed);
  const double kurtosis = fourth / (variance * variance);
  CHECK(kurtosis > 4);
  CHECK(drawn_variance == Approx(variance).epsilon(0.06));
  CHECK(drawn_fourth / (drawn_variance * drawn_variance) == Approx(kurtosis).epsilon(0.12));
}

TEST_CASE("the error of a picture is relative to its light however dim or bright that is") {
  RandomInputs random(64);
  constexpr uint width = 32, height = 24, passes = 16;
  std::vector<float2> samples(width * height * passes);
  for (auto& sample : samples) {
    sample.x = static_cast<float>(1 + normal(random) / 4);
    sample.y = static_cast<float>(0.1 + 0.01 * normal(random));
  }
  const auto plain = device_errors(statistics_of(film_of(samples, passes), passes), width, 1, true);
  const auto expected = picture_error(plain, 0.9);
  REQUIRE(expected);
  CHECK(expected->error > 0.05);
  for (const int power : {-110, -100, -60, 60, 100, 110}) {  // 10^-33 to 10^33
    auto scaled = samples;
    for (auto& sample : scaled) sample = {std::ldexp(sample.x, power), std::ldexp(sample.y, power)};
    const auto errors = device_errors(statistics_of(film_of(scaled, passes), passes), width, 1, true);
    const auto error = picture_error(errors, 0.9);
    CAPTURE(power, random.seed);
    REQUIRE(error);
    CHECK(error->error == Approx(expected->error).epsilon(1e-3));
    CHECK(error->noise == Approx(expected->noise).epsilon(1e-3));
    CHECK(error->bias == Approx(expected->bias).epsilon(1e-3));
    for (uint i = 0; i < errors.size(); i += 7)
      CHECK(std::ldexp(errors[i].pooled_noise, -power) == Approx(plain[i].pooled_noise).epsilon(1e-3));
  }
}
