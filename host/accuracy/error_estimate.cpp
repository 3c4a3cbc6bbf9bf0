#include "accuracy/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace causticl {
namespace {

constexpr double dark = 0.1;  // pixels below this fraction of the mean luminance are judged against it

struct RelativeError {
  double half_difference, noise, bias;
};

/// Of every `stride`-th pixel.
std::vector<RelativeError> relative_errors(const std::vector<PixelError>& pixels, std::size_t stride = 1) {
  double mean = 0;
  for (const auto& pixel : pixels) mean += pixel.luminance;
  mean /= static_cast<double>(std::max<std::size_t>(pixels.size(), 1));
  std::vector<RelativeError> errors;
  if (!(mean > 0)) return errors;
  errors.reserve(pixels.size() / stride + 1);
  for (std::size_t i = 0; i < pixels.size(); i += stride) {
    const double scale = std::max<double>(pixels[i].luminance, dark * mean);
    errors.push_back({pixels[i].half_difference / scale, pixels[i].noise / scale, pixels[i].bias / scale});
  }
  return errors;
}

/// What a fraction of the pixels is off by at most, where the noise that was drawn, times `noise`, adds to
/// their bias, times `bias`. Which of the two has which sign is not known: both cases count.
double drawn_bound(const std::vector<RelativeError>& errors, double fraction, double noise, double bias) {
  std::vector<double> sizes;
  sizes.reserve(2 * errors.size());
  for (const auto& error : errors)
    for (const double sign : {-1, 1})
      sizes.push_back(std::isfinite(error.bias)
                          ? std::fabs(noise * error.half_difference + sign * bias * error.bias)
                          : INFINITY);
  const auto rank =
      std::min(static_cast<std::size_t>(fraction * static_cast<double>(sizes.size())), sizes.size() - 1);
  const auto bound = sizes.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sizes.begin(), bound, sizes.end());
  return *bound;
}

/// The probability that a number, normally distributed, is x standard deviations above its mean or more. In
/// single precision, which is a third of the time: fractions are asked for to a thousandth.
double above(double x) { return 0.5 * std::erfc(static_cast<float>(x / std::numbers::sqrt2)); }

/// The probability that a normally distributed number is off by less than `bound` from what is off by `bias`.
double probability_below(double noise, double bias, double bound) {
  if (!(noise > 0)) return bias <= bound ? 1 : 0;
  if (bias == 0) return 1 - 2 * above(bound / noise);
  return 1 - above((bound - bias) / noise) - above((bound + bias) / noise);
}

/// Where a function that grows from 0 to 1 reaches `wanted`, to 0.5%; 0 where it starts above.
template <typename Function>
double inverse(const Function& function, double wanted) {
  constexpr double smallest = 1e-12, largest = 1e12;
  if (function(smallest) >= wanted) return 0;
  // Most errors lie about here: few steps find the bracket.
  double low = 0.02, high = 0.04;
  while (low > smallest && function(low) >= wanted) high = std::exchange(low, low / 4);
  while (high < largest && function(high) < wanted) low = std::exchange(high, high * 4);
  while (high > low * 1.005) {
    const double middle = std::sqrt(low * high);
    (function(middle) < wanted ? low : high) = middle;
  }
  return high;
}

/// As drawn_bound() of noise alone, were it normally distributed: less exact, but smoother from look to look.
double normal_bound(const std::vector<RelativeError>& errors, double fraction) {
  const auto fraction_below = [&](double bound) {
    double sum = 0;
    for (const auto& error : errors) sum += probability_below(error.noise, 0, bound);
    return sum / static_cast<double>(errors.size());
  };
  return inverse(fraction_below, fraction);
}

}  // namespace

double error_bound(const PixelError& pixel, double confidence) {
  const double size = std::max<double>(pixel.pooled_noise, pixel.bias);
  if (!(size > 0)) return 0;
  if (!std::isfinite(size)) return size;
  const double noise = pixel.pooled_noise / size, bias = pixel.bias / size;
  return size * inverse([&](double bound) { return probability_below(noise, bias, bound); }, confidence);
}

std::optional<PictureError> picture_error(const std::vector<PixelError>& pixels, double confidence) {
  const auto errors = relative_errors(pixels);
  if (errors.empty()) return {};
  const auto unknown = std::count_if(errors.begin(), errors.end(),
                                     [](const RelativeError& error) { return !std::isfinite(error.bias); });
  return PictureError{drawn_bound(errors, confidence, 1, 1), drawn_bound(errors, confidence, 1, 0),
                      drawn_bound(errors, confidence, 0, 1),
                      static_cast<double>(unknown) / static_cast<double>(errors.size())};
}

void ErrorTrend::add(std::uint64_t passes, const std::vector<PixelError>& pixels) {
  pixels_ = pixels;
  last_ = picture_error(pixels, confidence_);
  if (last_)
    looks_.push_back({std::log(static_cast<double>(passes)),
                      std::log(normal_bound(relative_errors(pixels), confidence_))});
  passes_ = passes;
}

ErrorRates ErrorTrend::rates() const {
  if (looks_.empty() || !std::isfinite(looks_.back().noise)) return expected_;
  // A line through the latest look, by least squares. The expected rate weighs as much as three looks an
  // octave before the last do: from there on to twelve, predictions in the scenes of scripts/calibration.sh
  // are as good.
  const Look& now = looks_.back();
  constexpr double octave = std::numbers::ln2, weight = 3;
  double sum = weight * octave * octave, weighted = sum * expected_.noise;
  for (const Look& then : looks_) {
    const double distance = now.passes - then.passes;
    if (distance > 2.01 * octave || then.passes < 1.99 * octave || !std::isfinite(then.noise)) continue;
    sum += distance * distance;
    weighted += distance * (then.noise - now.noise);
  }
  return {std::max(weighted / sum, 0.0), expected_.bias};
}

double ErrorTrend::passes_until(double wanted) const {
  if (last_->error <= wanted) return static_cast<double>(passes_);
  const auto errors = relative_errors(pixels_);
  const ErrorRates now = rates();
  const auto reached = [&](double times) {
    return drawn_bound(errors, confidence_, std::pow(times, -now.noise), std::pow(times, -now.bias)) <=
           wanted;
  };
  double low = 1, high = 1;
  for (; !reached(high); low = high, high *= 8)
    if (high > 1e12) return std::numeric_limits<double>::infinity();
  while (high > low * 1.005) {
    const double middle = std::sqrt(low * high);
    (reached(middle) ? high : low) = middle;
  }
  return high * static_cast<double>(passes_);
}

}  // namespace causticl
