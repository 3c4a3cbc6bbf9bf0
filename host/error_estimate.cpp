#include "error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace causticl {
namespace {

constexpr double dark = 0.1;  // pixels below this share of the mean luminance are judged against it

struct RelativeError {
  double noise, bias;
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
    errors.push_back({pixels[i].noise / scale, pixels[i].bias / scale});
  }
  return errors;
}

/// The probability that a number, normally distributed, is x standard deviations above its mean or more. In
/// single precision, which is a third of the time: shares are asked for to a thousandth.
double above(double x) { return 0.5 * std::erfc(static_cast<float>(x / std::numbers::sqrt2)); }

/// The probability of being off by less than `bound`.
double probability_below(const RelativeError& error, double bound) {
  const auto [noise, bias] = error;
  if (!(noise > 0)) return bias <= bound ? 1 : 0;
  if (bias == 0) return 1 - 2 * above(bound / noise);
  return 1 - above((bound - bias) / noise) - above((bound + bias) / noise);
}

/// The expected share of pixels that are off by less than `bound`.
double share_below(const std::vector<RelativeError>& errors, double bound) {
  double share = 0;
  for (const auto& error : errors) share += probability_below(error, bound);
  return share / static_cast<double>(errors.size());
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

double bound_of(const std::vector<RelativeError>& errors, double confidence) {
  return inverse([&](double bound) { return share_below(errors, bound); }, confidence);
}

}  // namespace

double error_bound(const PixelError& pixel, double confidence) {
  const double size = std::max<double>(pixel.pooled_noise, pixel.bias);
  if (!(size > 0)) return 0;
  const RelativeError error{pixel.pooled_noise / size, pixel.bias / size};
  return size * inverse([&](double bound) { return probability_below(error, bound); }, confidence);
}

std::optional<PictureError> picture_error(const std::vector<PixelError>& pixels, double confidence) {
  const auto errors = relative_errors(pixels);
  if (errors.empty()) return {};
  auto noises = errors, biases = errors;
  for (auto& error : noises) error.bias = 0;
  for (auto& error : biases) error.noise = 0;
  return PictureError{bound_of(errors, confidence), bound_of(noises, confidence),
                      bound_of(biases, confidence)};
}

void ErrorTrend::add(std::uint64_t passes, const std::vector<PixelError>& pixels) {
  pixels_ = pixels;
  last_ = picture_error(pixels, confidence_);
  if (last_)
    looks_.push_back({std::log(static_cast<double>(passes)), std::log(last_->error), std::log(last_->noise),
                      std::log(last_->bias)});
  passes_ = passes;
}

/// `weight`: of the expected rate, beside that of one look an octave before the last.
double ErrorTrend::rate_of(double Look::*part, double expected, double weight) const {
  if (looks_.empty() || !std::isfinite(looks_.back().*part)) return expected;
  // A line through the latest look, by least squares.
  const Look& now = looks_.back();
  constexpr double octave = std::numbers::ln2;
  double sum = weight * octave * octave, weighted = sum * expected;
  for (const Look& then : looks_) {
    const double distance = now.passes - then.passes;
    if (distance > 2.01 * octave || then.passes < 1.99 * octave || !std::isfinite(then.*part)) continue;
    sum += distance * distance;
    weighted += distance * (then.*part - now.*part);
  }
  return weighted / sum;
}

ErrorRates ErrorTrend::rates() const {
  return {std::max(rate_of(&Look::noise, expected_.noise, 0.5), 0.0),
          std::max(rate_of(&Look::bias, expected_.bias, 2), expected_.bias / 2)};
}

double ErrorTrend::passes_until(double wanted) const {
  if (last_->error <= wanted) return static_cast<double>(passes_);
  // What becomes of the error is asked for at every look, and a guess: half the pixels will do.
  const auto errors = relative_errors(pixels_, 2);
  const double error = bound_of(errors, confidence_);
  wanted *= error / last_->error;
  const ErrorRates now = rates();
  const auto after = [&](double times) {
    const double noise = std::pow(times, -now.noise), bias = std::pow(times, -now.bias);
    auto then = errors;
    for (auto& pixel : then) pixel = {pixel.noise * noise, pixel.bias * bias};
    return then;
  };
  const auto reached = [&](double times) { return share_below(after(times), wanted) >= confidence_; };
  double low = 1, high = 1;
  for (; !reached(high); low = high, high *= 8)
    if (high > 1e12) return std::numeric_limits<double>::infinity();
  while (high > low * 1.005) {
    const double middle = std::sqrt(low * high);
    (reached(middle) ? high : low) = middle;
  }
  constexpr double octaves = 4;
  const double expected = std::log2(error / bound_of(after(std::exp2(octaves)), confidence_)) / octaves;
  const double rate = rate_of(&Look::error, expected, 0.5);
  constexpr double slowest = 0.05;  // half the error would take a million times as long
  if (rate < slowest) return std::numeric_limits<double>::infinity();
  return std::sqrt(high * std::pow(error / wanted, 1 / rate)) * static_cast<double>(passes_);
}

}  // namespace causticl
