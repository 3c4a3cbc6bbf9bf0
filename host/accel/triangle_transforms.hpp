// The maps of triangles to the unit triangle that cl/shapes/triangle_precomputed.cl wants.
#pragma once

#include "accel/kdtree.hpp"

namespace causticl {

/// How rays meet triangles: `watertight` (Woop, Benthin and Wald 2013), or `precomputed` transforms (Baldwin
/// and Weber 2016), which take twice the memory and let some rays pass at edges.
enum class TriangleTest { watertight, precomputed };

/// Puts the TriangleTransforms of each block behind it, and leads the leaves to where their blocks are then.
/// Throws UserError if that makes more blocks than a tree can index.
void add_triangle_transforms(KdTree& tree, unsigned threads);

/// The maps of one block's triangles.
TriangleTransforms triangle_transforms(const TriangleBlock& block);

}  // namespace causticl
