// How well a picture's estimate of its own error holds against a reference.
#pragma once

#include <optional>
#include <vector>

#include "image/image.hpp"
#include "shared/types.h"

namespace causticl {

/// What a picture's channels tell of the error of each pixel; empty where it has not all of them.
std::vector<PixelError> errors_of(const Picture& picture);

struct Calibration {
  double estimated = 0;  // the picture's error by its channels, at `confidence`
  // The fraction of pixels that are off by less than their own bound at `confidence`, of those that are off
  // or might be: a black background is no merit.
  double covered = 0;
};

/// None for a picture without those channels. Where the reference has them as well, its errors widen the
/// bounds: what differs is the error of both.
std::optional<Calibration> calibration_of(const Picture& picture, const Picture& reference,
                                          double confidence);

}  // namespace causticl
