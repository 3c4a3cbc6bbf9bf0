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

std::vector<RelativeError> relative_errors(const std::vector<PixelError>& pixels) {
  double mean = 0;
  for (const auto& pixel : pixels) mean += pixel.luminance;
  mean /= static_cast<double>(std::max<std::size_t>(pixels.size(), 1));
  std::vector<RelativeError> errors;
  if (!(mean > 0)) return errors;
  errors.reserve(pixels.size());
  for (const auto& pixel : pixels) {
    const double scale = std::max<double>(pixel.luminance, dark * mean);
    errors.push_back({pixel.noise / scale, pixel.bias / scale});
  }
  return errors;
}

double normal_distribution(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// The probability of being off by less than `bound`.
double probability_below(const RelativeError& error, double bound) {
  const auto [noise, bias] = error;
  if (!(noise > 0)) return bias <= bound ? 1 : 0;
  return normal_distribution((bound - bias) / noise) - normal_distribution((-bound - bias) / noise);
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
  const double size = std::max<double>(pixel.noise, pixel.bias);
  if (!(size > 0)) return 0;
  const RelativeError error{pixel.noise / size, pixel.bias / size};
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
  if (last_ && last_->noise > 0)
    noises_.emplace_back(std::log(static_cast<double>(passes)), std::log(last_->noise));
  passes_ = passes;
}

double ErrorTrend::noise_rate() const {
  if (noises_.empty()) return expected_.noise;
  // A line through the latest noise, by least squares; the expected rate is one more point, an octave off.
  const auto [now, noise] = noises_.back();
  constexpr double octave = std::numbers::ln2;
  double sum = octave * octave, weighted = sum * expected_.noise;
  for (const auto& [passes, then] : noises_) {
    const double distance = now - passes;
    if (distance > 3.01 * octave) continue;
    sum += distance * distance;
    weighted += distance * (then - noise);
  }
  return weighted / sum;
}

double ErrorTrend::passes_until(double wanted) const {
  const auto errors = relative_errors(pixels_);
  const double rate = noise_rate();
  const auto reached = [&](double times) {
    const double noise = std::pow(times, -rate), bias = std::pow(times, -expected_.bias);
    auto then = errors;
    for (auto& error : then) error = {error.noise * noise, error.bias * bias};
    return share_below(then, wanted) >= confidence_;
  };
  double low = 1, high = 1;
  if (reached(low)) return static_cast<double>(passes_);
  for (; !reached(high); low = high, high *= 8)
    if (high > 1e12) return std::numeric_limits<double>::infinity();
  while (high > low * 1.005) {
    const double middle = std::sqrt(low * high);
    (reached(middle) ? high : low) = middle;
  }
  return high * static_cast<double>(passes_);
}

}  // namespace causticl
