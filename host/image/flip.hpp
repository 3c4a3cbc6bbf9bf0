// FLIP: the difference between two pictures as a person sees it who flips between them.
#pragma once

#include <vector>

#include "image/image.hpp"

namespace causticl {

/// The LDR-FLIP of each pixel, 0 (alike) to 1, row by row from the top, for a viewer who sees 67 pixels a
/// degree (a 0.7 m wide display of 3840 pixels, 0.7 m away). Both pictures are linear, of one size, and are
/// seen as their PNG would show them. (Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild,
/// "FLIP: A Difference Evaluator for Alternating Images", HPG 2020.)
std::vector<float> flip_map(const Picture& test, const Picture& reference);

}  // namespace causticl
