#include "error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

/// The expected share of pixels that are off by less than `bound`.
double share_below(const std::vector<RelativeError>& errors, double bound) {
  double share = 0;
  for (const auto& [noise, bias] : errors)
    share += noise > 0
                 ? normal_distribution((bound - bias) / noise) - normal_distribution((-bound - bias) / noise)
                 : (bias <= bound ? 1 : 0);
  return share / static_cast<double>(errors.size());
}

/// The bound that `confidence` of the pixels stay below, to 0.1%.
double bound_of(const std::vector<RelativeError>& errors, double confidence) {
  constexpr double smallest = 1e-12, largest = 1e12;
  if (share_below(errors, smallest) >= confidence) return 0;
  // Most pictures' errors lie about here: two steps of doubling find the bracket.
  double low = 0.02, high = 0.04;
  while (low > smallest && share_below(errors, low) >= confidence) high = std::exchange(low, low / 4);
  while (high < largest && share_below(errors, high) < confidence) low = std::exchange(high, high * 4);
  while (high > low * 1.001) {
    const double middle = std::sqrt(low * high);
    (share_below(errors, middle) < confidence ? low : high) = middle;
  }
  return high;
}

}  // namespace

std::optional<PictureError> picture_error(const std::vector<PixelError>& pixels, double confidence) {
  const auto errors = relative_errors(pixels);
  if (errors.empty()) return {};
  auto noises = errors, biases = errors;
  for (auto& error : noises) error.bias = 0;
  for (auto& error : biases) error.noise = 0;
  return PictureError{bound_of(errors, confidence), bound_of(noises, confidence),
                      bound_of(biases, confidence)};
}

void ErrorTrend::add(std::uint64_t passes, double error) {
  if (error > 0 && std::isfinite(error))
    history_.emplace_back(std::log(static_cast<double>(passes)), std::log(error));
}

double ErrorTrend::rate() const {
  if (history_.empty()) return expected_rate_;
  // A line through the latest error, by least squares; the expected rate is one more point, an octave
  // off.
  const auto [now, error] = history_.back();
  constexpr double octave = std::numbers::ln2;
  double sum = octave * octave, weighted = sum * expected_rate_;
  for (const auto& [passes, then] : history_) {
    const double distance = now - passes;
    if (distance > 3.01 * octave) continue;
    sum += distance * distance;
    weighted += distance * (then - error);
  }
  return weighted / sum;
}

double ErrorTrend::passes_until(double wanted) const {
  const auto [now, error] = history_.back();
  if (std::log(wanted) >= error) return std::exp(now);
  const double r = rate();
  return r > 0 ? std::exp(now + (error - std::log(wanted)) / r) : std::numeric_limits<double>::infinity();
}

}  // namespace causticl
