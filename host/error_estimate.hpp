// How wrong a picture still is, and how long it takes to make it better.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "types.h"

namespace causticl {

/// The relative error that a share `confidence` of the pixels stays below, against
///   max(luminance, a tenth of the picture's mean luminance),
/// since no eye sees a relative error in the dark.
struct PictureError {
  double error = 0;  // of noise and bias together
  double noise = 0;  // as if there were no bias
  double bias = 0;   // as if there were no noise
};

/// What a pixel's error is below with probability `confidence`, in luminance, if its noise is distributed
/// normally about its bias.
double error_bound(const PixelError& pixel, double confidence);

/// The error of the picture from those of its pixels, or of a sample of them: each is off by its bias and by
/// normally distributed noise. None for a black picture.
std::optional<PictureError> picture_error(const std::vector<PixelError>& pixels, double confidence);

/// The r of error ~ passes^-r that theory expects: for SPPM, whose radius takes from the photons what more
/// passes bring, that of Knaus & Zwicker 2011, section 4.
constexpr double sppm_rate(double alpha) { return alpha / 2; }
constexpr double path_tracing_rate = 0.5;

/// How the error has gone down so far, and where that leads.
class ErrorTrend {
 public:
  explicit ErrorTrend(double expected_rate) : expected_rate_(expected_rate) {}

  void add(std::uint64_t passes, double error);

  /// The rate as measured over the last three octaves of passes; the expected one weighs as much as one.
  double rate() const;

  /// Passes after which the error will be `wanted`, counted from the first. Infinite where there is no end in
  /// sight. Needs at least one error.
  double passes_until(double wanted) const;

 private:
  double expected_rate_;
  std::vector<std::pair<double, double>> history_;  // logarithms of passes and error
};

}  // namespace causticl
