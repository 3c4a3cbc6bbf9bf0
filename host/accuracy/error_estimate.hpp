// How wrong a picture still is, and how long it takes to make it better.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "shared/types.h"

namespace causticl {

/// The relative error that a fraction `confidence` of the pixels stays below, against
///   max(luminance, a tenth of the picture's mean luminance),
/// since no eye sees a relative error in the dark.
struct PictureError {
  double error = 0;  // of noise and bias together
  double noise = 0;  // as if there were no bias
  double bias = 0;   // as if there were no noise
  // Pixels whose error cannot be told (PixelError::bias is infinite), as a fraction of all: they count as
  // wrong.
  double unknown = 0;
};

/// The parts of a pixel's error, and the channels of EXR files that hold them.
struct PixelErrorKind {
  const char* channel;
  float PixelError::*value;
};
constexpr PixelErrorKind pixel_error_kinds[] = {{"error.noise", &PixelError::noise},
                                                {"error.pooled_noise", &PixelError::pooled_noise},
                                                {"error.bias", &PixelError::bias},
                                                {"error.drawn", &PixelError::half_difference}};

/// What a pixel's error is below with probability `confidence`, in luminance, if its pooled noise is
/// distributed normally about its bias.
double error_bound(const PixelError& pixel, double confidence);

/// The error of the picture from those of its pixels, or of a sample of them: each is off by its bias and by
/// noise. Of the noise each has drawn one sample (PixelError::drawn), and over many pixels these are spread
/// as the errors are: with all their tails, for which a normal distribution of each pixel's deviation has too
/// many errors of moderate size. None for a black picture.
std::optional<PictureError> picture_error(const std::vector<PixelError>& pixels, double confidence);

/// How a part of the error goes down: it ~ passes^-rate.
struct ErrorRates {
  double noise = 0.5, bias = 0;
};

/// Those that are expected of SPPM (Knaus & Zwicker 2011, section 4): the radius takes from the photons what
/// more passes bring, R^2 ~ passes^(alpha - 1), and their noise ~ passes^-(alpha / 2). That of camera paths
/// and shadow rays ~ passes^-(1 / 2): between the two lies the picture's. Bias goes with R^2 where
/// illumination is smooth, and along edges with R. Of the rates between, this is among those that come
/// closest in the scenes of scripts/calibration.sh.
constexpr ErrorRates sppm_rates(double alpha) { return {(alpha + 1) / 4, 0.85 * (1 - alpha)}; }
constexpr ErrorRates path_tracing_rates{};

/// How the error of a picture has gone down so far, and where that leads.
class ErrorTrend {
 public:
  ErrorTrend(ErrorRates expected, double confidence) : expected_(expected), confidence_(confidence) {}

  /// The errors of pixels, or of a sample of them, after `passes` passes.
  void add(std::uint64_t passes, const std::vector<PixelError>& pixels);

  /// The error of the picture when last added; none of a black picture.
  const std::optional<PictureError>& last() const { return last_; }

  /// The rate of the noise as measured over the last two octaves of passes, from the fourth pass on: of fewer
  /// the spread tells too little. The expected one counts as well. That of the bias is what is expected: what
  /// a few octaves show of it is mostly noise.
  ErrorRates rates() const;

  /// Passes after which the error will be `wanted`, counted from the first, if every pixel's noise and bias
  /// go on at their rates: noise falls away, and bias is left. Infinite where there is no end in sight. Needs
  /// last().
  double passes_until(double wanted) const;

 private:
  /// The logarithms of passes and of the noise at a look.
  struct Look {
    double passes, noise;
  };

  ErrorRates expected_;
  double confidence_;
  std::optional<PictureError> last_;
  std::uint64_t passes_ = 0;
  std::vector<PixelError> pixels_;  // the last ones
  std::vector<Look> looks_;
};

}  // namespace causticl
