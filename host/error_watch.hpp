// The error of a picture as it goes down, while passes go on.
#pragma once

#include <optional>

#include "error_estimate.hpp"
#include "film.hpp"
#include "scene.hpp"

namespace causticl {

class ErrorWatch {
 public:
  ErrorWatch(Film& film, const RendererSpec& renderer, double confidence);

  /// To be told of every pass. Looks at the film four times from one power of two to the next: often enough
  /// to see when the error is small enough, seldom enough to cost next to nothing, and by the number of
  /// passes alone, so that the same render stops at the same pass.
  void update(std::uint64_t passes);

  /// The error of the picture at the last look; none before the second pass, and none of a black picture.
  const std::optional<PictureError>& last() const { return trend_.last(); }

  /// Further passes until the error is this; needs last().
  double passes_until(double wanted, std::uint64_t passes) const;

  /// The error now.
  std::optional<PictureError> measure(std::uint64_t passes) const;

 private:
  Film& film_;
  double confidence_;
  ErrorTrend trend_;
  std::uint64_t next_ = 2;
};

}  // namespace causticl
