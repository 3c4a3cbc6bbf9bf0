// How far a picture is from a reference, in numbers and as a map.
#pragma once

#include <string>
#include <vector>

#include "accuracy/calibration.hpp"
#include "image/image.hpp"

namespace causticl {

struct Comparison {
  double mean = 0, reference_mean = 0;  // over all pixels and channels
  double mse = 0, rmse = 0;             // of the linear values
  double relative_mse = 0;              // mse over the square of the reference's mean
  double relative_rmse = 0;
  double error_90 = 0;                     // relative_error_quantile at 0.9
  std::optional<Calibration> calibration;  // at 0.9
  std::optional<double> noise_mse;         // of the reference's own noise, where it was taken off
  double measured_mse = 0;                 // before that
  double measured_error_90 = 0;
  double flip = 0;                 // mean FLIP
  std::vector<float> flip_pixels;  // of each pixel
};

/// mean((a - b)^2) over all channels, over the square of b's mean.
double relative_mse(const Picture& a, const Picture& b);

/// The relative error that the fraction `q` of the pixels stays under: the quantile over pixels of
/// |a - b| / max(b, 0.1 mean(b)), all of luminance. The floor keeps black pixels from counting as infinitely
/// wrong. Pixels that are not finite count as such.
double relative_error_quantile(const Picture& a, const Picture& b, double q);

/// Compares two pictures of one size. Pixels that are not finite in either count as infinitely wrong.
Comparison compare_pictures(const Picture& picture, const Picture& reference);

/// What a picture tells of its own noise by the channels error.* of its EXR file.
struct PictureNoise {
  double mse = 0;       // over pixels and channels
  double error_90 = 0;  // as relative_error_quantile at 0.9
};
/// None for a picture without those channels.
std::optional<PictureNoise> noise_of(const Picture& picture);

/// Takes the reference's own noise off of all errors but FLIP, if it is known: the squares of independent
/// errors add up. An error that is no larger than that noise becomes 0.
void take_off_noise(Comparison& comparison, const Picture& reference);

/// Reads any picture that `render` writes: .pfm, .exr, and .png through the inverse of its tone curve. Throws
/// UserError.
Picture read_rendered(const std::string& file, const ImageLimits& limits = {});

/// The table of `causticl compare`.
std::string comparison_table(const Comparison& comparison);
std::string comparison_json(const Comparison& comparison);

/// FLIP as colours (magma: black is alike, light yellow far off), as linear RGB for write_picture.
Picture error_map(const Comparison& comparison, int width, int height);

}  // namespace causticl
