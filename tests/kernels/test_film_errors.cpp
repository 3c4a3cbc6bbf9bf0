// The film's estimate of its own error against the same sums in double precision, and against pixels whose
// error is known.
#include <bit>
#include <cmath>

#include "film.hpp"
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

std::vector<PixelError> device_errors(const std::vector<FilmPixel>& film, uint width, uint passes,
                                      uint stride) {
  auto program = build_test_program("#include \"pass_film.cl\"\n");
  auto pixels = test_device().upload(film, "film");
  const uint count = (static_cast<uint>(film.size()) + stride - 1) / stride;
  auto errors = test_device().buffer(count * sizeof(PixelError), "errors");
  run_kernel(program, "pixel_errors", count, pixels, errors, width, static_cast<uint>(film.size()) / width,
             passes, stride, count);
  return test_device().download<PixelError>(errors, count);
}

/// The same as the kernel's comment says, by the definition.
struct Oracle {
  double noise, pooled_noise, bias, drawn;
};
Oracle oracle(const std::vector<FilmPixel>& film, int width, int x, int y, uint passes) {
  const int height = static_cast<int>(film.size()) / width;
  const auto over_window = [&](int x_of, int y_of, auto add) {
    int count = 0;
    for (int j = std::max(0, y_of - 1); j <= std::min(height - 1, y_of + 1); ++j)
      for (int i = std::max(0, x_of - 1); i <= std::min(width - 1, x_of + 1); ++i, ++count)
        add(film[static_cast<std::size_t>(j) * width + i]);
    return static_cast<double>(count);
  };
  const auto variance_of = [&](const FilmPixel& p) {
    const double n = passes - p.left_out;
    return n > 1 ? p.spread / (n * (n - 1)) : p.spread;
  };
  double variance = 0;
  const double pixels = over_window(x, y, [&](const FilmPixel& p) { variance += variance_of(p); });
  double noise = 0, square = 0;
  int windows = 0;
  for (int j = y - 3; j <= y + 3; j += 3)
    for (int i = x - 3; i <= x + 3; i += 3) {
      double even = 0, odd = 0;
      const double count = over_window(i, j, [&](const FilmPixel& p) {
        even += p.blur[0] / ((passes + 1) / 2);
        odd += p.blur[1] / std::max(passes / 2, 1u);
      });
      if (count == 0) continue;
      ++windows;
      noise += std::pow((even - odd) / (2 * count), 2);
      if (i == x && j == y) square = std::pow((even + odd) / (2 * count), 2);
    }
  const FilmPixel& own = film[static_cast<std::size_t>(y) * width + x];
  const double n = std::max(1.0, static_cast<double>(passes) - own.left_out);
  // By the number of estimates: one more with plus than with minus, or one less, or none.
  int plus = 0;
  for (uint k = 0; k < passes - own.left_out; ++k) plus += std::popcount(k) % 2 ? -1 : 1;
  const double luminance = (0.2126 * own.sum[0] + 0.7152 * own.sum[1] + 0.0722 * own.sum[2]) / n;
  return {std::sqrt(0.98 * variance_of(own) + 0.02 * variance / pixels), std::sqrt(variance / pixels),
          2 * std::sqrt(std::max(0.0, square - 2 * noise / windows)),
          (own.alternating - plus * luminance) / n};
}

double normal(RandomInputs& random) { return std::normal_distribution<double>()(random.engine); }

}  // namespace

TEST_CASE("errors of pixels equal those in double precision, at borders too") {
  RandomInputs random(61);
  constexpr uint width = 37, height = 23, passes = 20;
  std::vector<FilmPixel> film(width * height);
  for (auto& pixel : film) {
    for (int c = 0; c < 3; ++c) pixel.sum[c] = static_cast<float>(random.uniform(0, 40));
    pixel.left_out = random.uniform() < 0.1 ? static_cast<uint>(random.uniform(1, 21)) : 0;
    pixel.spread = static_cast<float>(random.uniform(0, 3));
    // Passes of even and odd number agree to the noise of what is beside, or do not.
    const double blur = random.uniform(0, 4);
    for (float& sum : pixel.blur) sum = static_cast<float>(blur + random.uniform(-1, 1));
    pixel.alternating = static_cast<float>(random.uniform(-9, 9));
  }
  uint biased = 0;
  for (const uint stride : {1u, 5u}) {
    const auto errors = device_errors(film, width, passes, stride);
    REQUIRE(errors.size() == (film.size() + stride - 1) / stride);
    for (uint k = 0; k < errors.size(); ++k) {
      const uint i = k * stride;
      const Oracle expected = oracle(film, width, i % width, i / width, passes);
      CAPTURE(i, random.seed);
      CHECK(errors[k].noise == Approx(expected.noise).epsilon(1e-5));
      CHECK(errors[k].pooled_noise == Approx(expected.pooled_noise).epsilon(1e-5));
      // A mean next to zero cancels.
      CHECK(errors[k].bias == Approx(expected.bias).epsilon(1e-3).margin(1e-4));
      biased += expected.bias > 0;
      CHECK(errors[k].drawn == Approx(expected.drawn).epsilon(1e-5).margin(1e-5));
      const double n = std::max(1.0, static_cast<double>(passes) - film[i].left_out);
      CHECK(errors[k].luminance ==
            Approx((0.2126 * film[i].sum[0] + 0.7152 * film[i].sum[1] + 0.0722 * film[i].sum[2]) / n));
    }
  }
  CHECK(biased > film.size() / 2);
}

TEST_CASE("noise and bias of pixels are found where they are known") {
  // Every pass of every pixel is off by a known bias and by normally distributed noise, of which the
  // difference between the two kernels has some as well. The mean's noise is sigma / sqrt(passes).
  RandomInputs random(62);
  constexpr uint width = 64, height = 64, passes = 16;
  constexpr double sigma = 0.4, bias = 0.3;
  const auto program = build_test_program(R"(
#include "film.cl"
kernel void add_samples(global const float2 *samples, global FilmPixel *film, volatile global Counters *counters,
                        uint pixels, uint passes) {
  uint i = get_global_id(0);
  if (i >= pixels) return;
  for (uint n = 0; n < passes; ++n) film_add(film + i, (real3)samples[i * passes + n].x, samples[i * passes + n].y, n, counters);
}
)");
  for (const bool biased : {false, true}) {
    std::vector<float2> samples(width * height * passes);
    for (auto& sample : samples) {
      sample.x = static_cast<float>(1 + (biased ? bias : 0) + sigma * normal(random));
      sample.y = static_cast<float>((biased ? bias / 2 : 0) + sigma * normal(random));
    }
    auto in = test_device().upload(samples, "samples");
    auto film = test_device().upload(std::vector<FilmPixel>(width * height), "film");
    auto counters = test_device().upload(std::vector<Counters>(1), "counters");
    auto built = program;
    run_kernel(built, "add_samples", width * height, in, film, counters, width * height, passes);
    const auto errors =
        device_errors(test_device().download<FilmPixel>(film, width * height), width, passes, 1);
    double noise2 = 0, pooled2 = 0, drawn2 = 0, mean_bias = 0;
    for (const auto& error : errors) {
      noise2 += error.noise * error.noise / errors.size();
      pooled2 += error.pooled_noise * error.pooled_noise / errors.size();
      drawn2 += error.drawn * error.drawn / errors.size();
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

TEST_CASE("errors drawn are spread as the errors of pixels whose light is rare") {
  // One estimate in forty has all the light: of sixteen, most pixels have met none.
  RandomInputs random(63);
  constexpr uint width = 128, height = 128, passes = 16;
  std::vector<FilmPixel> film(width * height);
  std::vector<double> errors;
  for (auto& pixel : film) {
    for (uint n = 0; n < passes; ++n) {
      const float value = random.uniform() < 0.025 ? 40.0f : 0.0f;
      for (float& sum : pixel.sum) sum += value;
      pixel.alternating += std::popcount(n) % 2 ? -value : value;
    }
    errors.push_back(pixel.sum[0] / passes - 1);
  }
  double variance = 0, fourth = 0, drawn_variance = 0, drawn_fourth = 0;
  for (const double error : errors) {
    variance += std::pow(error, 2) / film.size();
    fourth += std::pow(error, 4) / film.size();
  }
  for (const auto& error : device_errors(film, width, passes, 1)) {
    drawn_variance += std::pow(error.drawn, 2) / film.size();
    drawn_fourth += std::pow(error.drawn, 4) / film.size();
  }
  CAPTURE(random.seed);
  const double kurtosis = fourth / (variance * variance);
  CHECK(kurtosis > 4);
  CHECK(drawn_variance == Approx(variance).epsilon(0.06));
  CHECK(drawn_fourth / (drawn_variance * drawn_variance) == Approx(kurtosis).epsilon(0.12));
}
