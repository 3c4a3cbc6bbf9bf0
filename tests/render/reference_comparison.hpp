// Measuring a picture against the two references by other renderers (not shipped).
#pragma once

#include <string>

#include "image/image.hpp"

namespace causticl {

/// ../shared/references/ beside the source tree; empty where it is missing.
std::string reference_folder();

/// A picture of cornell_spheres.json against both references at once: their independent noise cancels in
/// mean((T - R1)(T - R2)).
struct ReferenceComparison {
  double relative_rmse, mean, reference_mean;
};
ReferenceComparison compare_with_references(const Picture& picture);

}  // namespace causticl
