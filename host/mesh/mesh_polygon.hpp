// Cutting polygons into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace causticl {

/// Triangles of the simple polygon whose corners are `corners`, in order: n - 2 triples of indices into
/// `corners`, with the polygon's winding. Concave polygons are cut by ear clipping (Meisters 1975) in the
/// plane of the polygon's Newell normal; where no ear is left (self-intersecting or flat to a line) the rest
/// is cut as a fan. Needs at least 3 corners.
void triangulate_polygon(const std::vector<std::array<double, 3>>& corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace causticl
