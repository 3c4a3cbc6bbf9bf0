#include "accuracy/compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "accuracy/error_estimate.hpp"
#include "image/flip.hpp"
#include "image/luminance.hpp"

namespace causticl {
namespace {

double mean_of(const Picture& picture) {
  double sum = 0;
  for (const float value : picture.rgb) sum += value;
  return sum / static_cast<double>(picture.rgb.size());
}

double mse_of(const Picture& a, const Picture& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const double difference = static_cast<double>(a.rgb[i]) - b.rgb[i];
    squares += difference * difference;
  }
  return squares / static_cast<double>(a.rgb.size());
}

/// The colour map magma of matplotlib, by a polynomial fit of sixth degree for each channel.
double magma(int channel, double x) {
  static constexpr double coefficients[3][7] = {
      {-0.002136485053939582, 0.2516605407371642, 8.353717279216625, -27.66873308576866, 52.17613981234068,
       -50.76852536473588, 18.65570506591883},
      {-0.000749655052795221, 0.6775232436837668, -3.577719514958484, 14.26473078096533, -27.94360607168351,
       29.04658282127291, -11.48977351997711},
      {-0.005386127855323933, 2.494026599312351, 0.3144679030132573, -13.64921318813922, 12.94416944238394,
       4.23415299384598, -5.601961508734096}};
  double value = 0;
  for (int k = 6; k >= 0; --k) value = value * x + coefficients[channel][k];
  return std::clamp(value, 0.0, 1.0);
}

}  // namespace

double relative_mse(const Picture& a, const Picture& b) {
  const double mean = mean_of(b);
  return mse_of(a, b) / (mean * mean);
}

double relative_error_quantile(const Picture& a, const Picture& b, double q) {
  const std::size_t pixels = b.rgb.size() / 3;
  double mean = 0;
  for (std::size_t i = 0; i < pixels; ++i) mean += luminance(&b.rgb[3 * i]) / static_cast<double>(pixels);
  std::vector<double> errors(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double expected = luminance(&b.rgb[3 * i]);
    const double error = std::fabs(luminance(&a.rgb[3 * i]) - expected) / std::max(expected, 0.1 * mean);
    errors[i] = error >= 0 ? error : std::numeric_limits<double>::infinity();
  }
  const auto rank = std::min(static_cast<std::size_t>(q * static_cast<double>(pixels)), pixels - 1);
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
  return errors[rank];
}

std::optional<PictureNoise> noise_of(const Picture& picture) {
  const auto errors = errors_of(picture);
  const auto estimate = picture_error(errors, 0.9);
  if (!estimate) return {};
  double squares = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    // Light that is missing or too much has the colour of the pixel.
    const float* rgb = &picture.rgb[3 * i];
    const double grey = errors[i].luminance;
    for (int c = 0; c < 3; ++c) {
      const double noise = errors[i].noise * (grey > 0 ? static_cast<double>(rgb[c]) / grey : 1);
      squares += noise * noise;
    }
  }
  return PictureNoise{squares / static_cast<double>(picture.rgb.size()), estimate->noise};
}

void take_off_noise(Comparison& comparison, const Picture& reference) {
  const auto noise = noise_of(reference);
  if (!noise || !std::isfinite(noise->mse) || !std::isfinite(noise->error_90)) return;
  comparison.noise_mse = noise->mse;
  comparison.mse = std::max(0.0, comparison.measured_mse - noise->mse);
  comparison.rmse = std::sqrt(comparison.mse);
  comparison.relative_mse = comparison.mse / (comparison.reference_mean * comparison.reference_mean);
  comparison.relative_rmse = std::sqrt(comparison.relative_mse);
  const double measured = comparison.measured_error_90;
  comparison.error_90 = std::sqrt(std::max(0.0, measured * measured - noise->error_90 * noise->error_90));
}

Comparison compare_pictures(const Picture& picture, const Picture& reference) {
  Comparison result;
  result.mean = mean_of(picture);
  result.reference_mean = mean_of(reference);
  result.mse = result.measured_mse = mse_of(picture, reference);
  result.rmse = std::sqrt(result.mse);
  result.relative_mse = result.mse / (result.reference_mean * result.reference_mean);
  result.relative_rmse = std::sqrt(result.relative_mse);
  result.error_90 = result.measured_error_90 = relative_error_quantile(picture, reference, 0.9);
  result.calibration = calibration_of(picture, reference, 0.9);
  result.flip_pixels = flip_map(picture, reference);
  for (const float value : result.flip_pixels) result.flip += value;
  result.flip /= static_cast<double>(result.flip_pixels.size());
  return result;
}

Picture read_rendered(const std::string& file, const ImageLimits& limits) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".png") return read_picture(file, limits);
  const Image image = read_image(file, false, limits);
  Picture picture{image.width, image.height, {}};
  for (int y = image.height - 1; y >= 0; --y)  // images have their bottom row first
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.rgb.push_back(
            std::pow(image.rgba[4 * (static_cast<std::size_t>(y) * image.width + x) + c], 2.2f));
  return picture;
}

std::string comparison_table(const Comparison& c) {
  char text[1024];
  std::snprintf(
      text, sizeof text,
      "  %-20s %.6g\n  %-20s %.6g (%+.3f%%)\n  %-20s %.4g\n  %-20s %.4g\n  %-20s %.4g\n  %-20s %.4g\n"
      "  %-20s %.4g\n  %-20s %.4f\n",
      "reference mean", c.reference_mean, "mean", c.mean, 100 * (c.mean / c.reference_mean - 1), "MSE", c.mse,
      "RMSE", c.rmse, "relative MSE", c.relative_mse, "relative RMSE", c.relative_rmse,
      "90% of pixels within", c.error_90, "mean FLIP", c.flip);
  std::string table = text;
  if (c.calibration) {
    std::snprintf(text, sizeof text,
                  "  %-20s %.4g by its own estimate; %.1f%% of the pixels are within their 90%% bounds\n", "",
                  c.calibration->estimated, 100 * c.calibration->covered);
    table += text;
  }
  if (c.noise_mse) {
    std::snprintf(text, sizeof text,
                  "The reference's own noise, an RMSE of %.4g by its channels error.*, is taken off of MSE, "
                  "RMSE and the\n"
                  "error of 90%% of the pixels (measured: RMSE %.4g, 90%% within %.4g), not of FLIP.%s\n",
                  std::sqrt(*c.noise_mse), std::sqrt(c.measured_mse), c.measured_error_90,
                  c.mse > 0 ? "" : " The pictures\ndiffer by no more than that noise.");
    table += text;
  }
  return table;
}

std::string comparison_json(const Comparison& c) {
  nlohmann::ordered_json object = {{"mean", c.mean},
                                   {"reference_mean", c.reference_mean},
                                   {"mse", c.mse},
                                   {"rmse", c.rmse},
                                   {"relative_mse", c.relative_mse},
                                   {"relative_rmse", c.relative_rmse},
                                   {"error_90", c.error_90},
                                   {"flip", c.flip}};
  if (c.calibration) {
    object["estimated_error_90"] = c.calibration->estimated;
    object["covered_90"] = c.calibration->covered;
  }
  if (c.noise_mse) {
    object["reference_noise_mse"] = *c.noise_mse;
    object["measured_mse"] = c.measured_mse;
    object["measured_error_90"] = c.measured_error_90;
  }
  return object.dump(2) + "\n";
}

Picture error_map(const Comparison& comparison, int width, int height) {
  Picture map{width, height, {}};
  for (const float value : comparison.flip_pixels)
    for (int channel = 0; channel < 3; ++channel)
      // write_picture encodes with power 1/2.2 what this decodes.
      map.rgb.push_back(static_cast<float>(std::pow(magma(channel, value), 2.2)));
  return map;
}

}  // namespace causticl
