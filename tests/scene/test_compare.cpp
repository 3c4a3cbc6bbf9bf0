// The numbers of `causticl compare`.
#include "accuracy/compare.hpp"

#include <cmath>
#include <random>

#include "catch2.hpp"
#include "image/flip.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

namespace {

template <typename Color>
Picture picture_of(int width, int height, const Color& color) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) picture.rgb.push_back(static_cast<float>(color(x, y, c)));
  return picture;
}

Picture uniform(double red, double green, double blue) {
  return picture_of(40, 30, [=](int, int, int c) { return c == 0 ? red : c == 1 ? green : blue; });
}

double waves(int x, int y, int c) {
  return c == 0   ? 0.45 + 0.45 * std::sin(x / 7.0)
         : c == 1 ? 0.45 + 0.45 * std::cos(y / 5.0)
                  : (x / 8 + y / 8) % 2 * 0.72;
}

double disturbed_waves(int x, int y, int c) {
  return waves(x, y, c) * 0.9 + 0.04 + 0.04 * std::sin(12.9898 * x + 78.233 * y) +
         (std::hypot(x - 32, y - 24) < 6 ? 0.3 : 0);
}

}  // namespace

TEST_CASE("FLIP is that of its authors' program") {
  const Picture reference = picture_of(64, 48, waves), test = picture_of(64, 48, disturbed_waves);
  const Comparison comparison = compare_pictures(test, reference);
  // Values of flip-evaluator 1.7 for the same pictures, encoded with power 1/2.2.
  CHECK(comparison.flip == Approx(0.232934).epsilon(1e-4));
  const auto at = [&](int row, int column) {
    return comparison.flip_pixels[static_cast<std::size_t>(row * 64 + column)];
  };
  CHECK(at(24, 32) == Approx(0.677621).epsilon(1e-3));
  CHECK(at(0, 0) == Approx(0.378600).epsilon(1e-3));
  CHECK(at(10, 50) == Approx(0.170761).epsilon(1e-3));
  CHECK(at(40, 20) == Approx(0.104937).epsilon(1e-3));
}

TEST_CASE("FLIP is 0 for a picture and itself, 1 for green and blue") {
  const Picture picture = picture_of(30, 20, waves);
  for (const float value : flip_map(picture, picture)) CHECK(value == 0);
  for (const float value : flip_map(uniform(0, 1, 0), uniform(0, 0, 1)))
    CHECK(value == Approx(1).margin(1e-3));
}

TEST_CASE("means and squares are those of the linear values") {
  const Comparison comparison = compare_pictures(uniform(0.5, 0.5, 0.8), uniform(0.5, 0.5, 0.5));
  CHECK(comparison.mean == Approx(0.6));
  CHECK(comparison.reference_mean == Approx(0.5));
  CHECK(comparison.mse == Approx(0.03));
  CHECK(comparison.rmse == Approx(std::sqrt(0.03)));
  CHECK(comparison.relative_mse == Approx(0.12));
  CHECK(comparison.relative_rmse == Approx(std::sqrt(0.12)));
}

TEST_CASE("a PNG is compared by the values that it was made of") {
  const TemporaryFolder folder;
  const Picture picture = picture_of(16, 8, waves);
  write_picture(folder.path("a.png"), picture, {});
  const Picture back = read_rendered(folder.path("a.png"));
  REQUIRE(back.rgb.size() == picture.rgb.size());
  double worst = 0;
  for (std::size_t i = 0; i < back.rgb.size(); ++i)
    worst = std::max(worst, std::fabs(static_cast<double>(back.rgb[i]) - picture.rgb[i]));
  CHECK(worst < 0.006);  // half of one of 255 steps, 2.2 times as steep where it is bright
}

TEST_CASE("the map shows what is alike as black and what differs as bright") {
  const Picture reference = uniform(0.2, 0.2, 0.2);
  const Picture same = error_map(compare_pictures(reference, reference), 40, 30);
  const Picture far = error_map(compare_pictures(uniform(0, 1, 0), uniform(0, 0, 1)), 40, 30);
  CHECK(same.rgb[0] + same.rgb[1] + same.rgb[2] < 0.01f);
  CHECK(far.rgb[0] + far.rgb[1] + far.rgb[2] > 2);
}

TEST_CASE("a picture that knows its error is held to it") {
  // Every pixel is off by noise as stated; the reference has noise of its own, which it states or not.
  std::mt19937 engine(7);
  std::normal_distribution<float> normal;
  const auto noisy = [&](float sigma) {
    Picture picture = picture_of(100, 80, waves);
    Channel noise{"error.noise", {}}, bias{"error.bias", {}}, half_difference{"error.drawn", {}};
    for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
      const float difference = sigma * normal(engine);
      for (int c = 0; c < 3; ++c) picture.rgb[3 * i + c] += difference;
      noise.values.push_back(sigma);
      bias.values.push_back(0);
      half_difference.values.push_back(sigma * normal(engine));
    }
    picture.channels = {noise, {"error.pooled_noise", noise.values}, bias, half_difference};
    return picture;
  };
  const Picture truth = picture_of(100, 80, waves), picture = noisy(0.05f);
  CHECK(!compare_pictures(truth, picture).calibration);
  Comparison comparison = compare_pictures(picture, truth);
  REQUIRE(comparison.calibration);
  CHECK(comparison.calibration->covered == Approx(0.9).margin(0.01));
  CHECK(comparison.calibration->estimated == Approx(comparison.error_90).epsilon(0.08));
  Picture reference = noisy(0.05f);
  CHECK(compare_pictures(picture, reference).calibration->covered == Approx(0.9).margin(0.01));
  reference.channels.clear();
  CHECK(compare_pictures(picture, reference).calibration->covered < 0.8);
  // Through a file and back.
  const TemporaryFolder folder;
  write_picture(folder.path("a.exr"), picture, {});
  comparison = compare_pictures(read_rendered(folder.path("a.exr")), truth);
  CHECK(comparison.calibration->covered == Approx(0.9).margin(0.01));
  CHECK_THAT(comparison_table(comparison), Catch::Contains("by its own estimate; "));
  CHECK_THAT(comparison_json(comparison), Catch::Contains("\"covered_90\": 0."));
}

TEST_CASE("the noise that a reference states is taken off, and that is said") {
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  const int width = 120, height = 100;
  const Picture truth = picture_of(width, height, waves);
  const auto noisy = [&](double sigma) {
    Picture picture = truth;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
      const double factor = 1 + sigma * normal(engine);
      for (std::size_t c = i; c < i + 3; ++c) picture.rgb[c] = static_cast<float>(picture.rgb[c] * factor);
    }
    return picture;
  };
  // Errors in proportion to the light, of every colour alike.
  const Picture picture = noisy(0.05);
  Picture reference = noisy(0.06);
  const Comparison expected = compare_pictures(picture, truth);
  Comparison comparison = compare_pictures(picture, reference);
  CHECK(comparison.rmse > 1.4 * expected.rmse);
  Comparison untold = comparison;
  take_off_noise(untold, reference);
  CHECK_FALSE(untold.noise_mse);
  CHECK(untold.mse == comparison.mse);
  CHECK_THAT(comparison_table(untold), !Catch::Contains("own noise"));

  Channel noise{"error.noise", {}}, bias{"error.bias", {}}, half_difference{"error.drawn", {}};
  for (std::size_t i = 0; i < truth.rgb.size(); i += 3) {
    const double grey = 0.2126 * truth.rgb[i] + 0.7152 * truth.rgb[i + 1] + 0.0722 * truth.rgb[i + 2];
    noise.values.push_back(static_cast<float>(0.06 * grey));
    half_difference.values.push_back(static_cast<float>(0.06 * grey * normal(engine)));
    bias.values.push_back(0);
  }
  reference.channels = {noise, {"error.pooled_noise", noise.values}, bias, half_difference};
  const TemporaryFolder folder;
  write_picture(folder.path("r.exr"), reference, {});
  const Picture read = read_rendered(folder.path("r.exr"));
  comparison = compare_pictures(picture, read);
  take_off_noise(comparison, read);
  REQUIRE(comparison.noise_mse);
  CHECK(comparison.rmse == Approx(expected.rmse).epsilon(0.05));
  CHECK(comparison.relative_rmse == Approx(expected.relative_rmse).epsilon(0.05));
  CHECK(comparison.error_90 == Approx(expected.error_90).epsilon(0.06));
  CHECK(comparison.measured_mse == Approx(comparison.mse + *comparison.noise_mse));
  CHECK_THAT(comparison_table(comparison), Catch::Contains("The reference's own noise, an RMSE of "));
  CHECK_THAT(comparison_json(comparison), Catch::Contains("\"reference_noise_mse\": "));

  // No further from the reference than this is from the truth: nothing can be told.
  Comparison same = compare_pictures(read, read);
  take_off_noise(same, read);
  CHECK(same.mse == 0);
  CHECK(same.error_90 == 0);
  CHECK_THAT(comparison_table(same), Catch::Contains("differ by no more than that noise"));
}

TEST_CASE("a bias that is stated widens the bound to its side") {
  Picture truth = uniform(1, 1, 1), picture = uniform(1.1, 1.1, 1.1);
  const std::size_t pixels = picture.rgb.size() / 3;
  picture.channels = {{"error.noise", std::vector<float>(pixels, 0)},
                      {"error.pooled_noise", std::vector<float>(pixels, 0)},
                      {"error.bias", std::vector<float>(pixels, 0.11f)},
                      {"error.drawn", std::vector<float>(pixels, 0)}};
  CHECK(compare_pictures(picture, truth).calibration->covered == 1);
  picture.channels[2].values.assign(pixels, 0.09f);
  CHECK(compare_pictures(picture, truth).calibration->covered == 0);
  // Half the pixels are known but for a rounding: only the others count.
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    if (i / 3 % 2) picture.rgb[i] = std::nextafter(truth.rgb[i], 2.0f);
  for (std::size_t i = 1; i < pixels; i += 2) picture.channels[2].values[i] = 0;
  CHECK(compare_pictures(picture, truth).calibration->covered == 0);
  for (std::size_t i = 0; i < pixels; i += 2) picture.channels[2].values[i] = 0.11f;
  CHECK(compare_pictures(picture, truth).calibration->covered == 1);
}
