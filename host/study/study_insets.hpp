// Cut-outs of what the settings of a study rendered in the same time, for people to look at.
#pragma once

#include <string>
#include <vector>

#include "image/image.hpp"
#include "study/study_store.hpp"

namespace causticl {

struct Inset {
  int x = 0, y = 0, size = 0;  // pixels from the top left; square
};

/// Up to `count` squares that do not overlap, where pictures differ the most from `reference` to the eye.
std::vector<Inset> choose_insets(const Picture& reference, const std::vector<Picture>& pictures,
                                 std::size_t count);

/// One JSON object: the reference as a whole and its insets, and those of every setting whose picture is in
/// `folder`, as data URIs of PNG files.
std::string study_insets(const std::string& folder, const Study& study);

}  // namespace causticl
