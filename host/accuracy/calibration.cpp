#include "accuracy/calibration.hpp"

#include <algorithm>
#include <cmath>

#include "accuracy/error_estimate.hpp"
#include "image/luminance.hpp"

namespace causticl {
namespace {

constexpr double rounding_of_means = 1e-6;  // relative: a few roundings of a float

const std::vector<float>* find(const Picture& picture, const std::string& name) {
  const auto found = std::find_if(picture.channels.begin(), picture.channels.end(),
                                  [&](const Channel& channel) { return channel.name == name; });
  return found == picture.channels.end() ? nullptr : &found->values;
}

}  // namespace

std::vector<PixelError> errors_of(const Picture& picture) {
  std::vector<PixelError> errors(picture.rgb.size() / 3);
  for (const auto& kind : pixel_error_kinds) {
    const auto* values = find(picture, kind.channel);
    if (!values) return {};
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i].*kind.value = (*values)[i];
  }
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i].luminance = static_cast<float>(luminance(&picture.rgb[3 * i]));
  return errors;
}

std::optional<Calibration> calibration_of(const Picture& picture, const Picture& reference,
                                          double confidence) {
  auto errors = errors_of(picture);
  const auto estimate = picture_error(errors, confidence);
  if (!estimate) return {};
  const auto reference_errors = errors_of(reference);
  double covered = 0, uncertain = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    PixelError error = errors[i];
    if (!reference_errors.empty()) {
      error.pooled_noise = std::hypot(error.pooled_noise, reference_errors[i].pooled_noise);
      // Both are blurred to the same side: the reference less.
      error.bias = std::fabs(error.bias - reference_errors[i].bias);
    }
    const double difference =
        std::fabs(static_cast<double>(error.luminance) - luminance(&reference.rgb[3 * i]));
    const double bound = error_bound(error, confidence);
    // A sky that is seen directly is known, but for what the sums of different numbers of passes round.
    const double rounding = rounding_of_means * error.luminance;
    if (!(bound > 0 || difference > rounding)) continue;
    ++uncertain;
    covered += difference <= bound + rounding;
  }
  return Calibration{estimate->error, uncertain > 0 ? covered / uncertain : 1};
}

}  // namespace causticl
