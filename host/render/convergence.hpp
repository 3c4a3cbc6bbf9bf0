// The error of a picture as it goes down, while passes go on.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "accuracy/error_estimate.hpp"
#include "film/film.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// Passes after which the trend of the error can be told: it needs two octaves, of which the first begins at
/// the fourth pass (see ErrorTrend::rates).
constexpr std::uint64_t trend_known_from = 16;

class ConvergenceCheck {
 public:
  /// `wanted` is the error that passes_to_wanted() is asked for; none: it is not.
  ConvergenceCheck(Film& film, const RendererSpec& renderer, double confidence, std::optional<double> wanted);

  /// To be told of every pass. Looks at the film four times from one power of two to the next: often enough
  /// to see when the error is small enough, seldom enough to cost next to nothing, and by the number of
  /// passes alone, so that the same render stops at the same pass.
  void update(std::uint64_t passes);

  /// `passes` passes have been rendered elsewhere, and looked at as here.
  void skip(std::uint64_t passes);

  /// The error of the picture at the last look; none before the second pass, and none of a black picture.
  const std::optional<PictureError>& last() const { return trend_.last(); }

  /// Further passes after `passes` until the error is half that of the last look; none while the trend is not
  /// known, nor for an error of nothing, or one that is unknown.
  std::optional<double> passes_to_half(std::uint64_t passes) const {
    if (!last() || !(last()->error > 0) || !std::isfinite(last()->error) || passes < trend_known_from)
      return {};
    return further(until_half_, passes);
  }

  /// The same until it is the wanted one, as a guess at first; needs last().
  double passes_to_wanted(std::uint64_t passes) const { return further(until_wanted_, passes); }

  /// The error now.
  std::optional<PictureError> measure(std::uint64_t passes) const;

 private:
  Film& film_;
  double confidence_;
  ErrorTrend trend_;
  std::optional<double> wanted_;
  std::uint64_t next_ = 2;
  double until_half_ = 0, until_wanted_ = 0;  // passes from the first, as the last look has it

  static double further(double until, std::uint64_t passes) {
    return std::max(0.0, until - static_cast<double>(passes));
  }
};

}  // namespace causticl
