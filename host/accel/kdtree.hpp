// The wide KD-tree over triangles and bounded shapes that cl/traversal/kdtree.cl traverses.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/types.h"

namespace causticl {

struct TreeTriangle {
  float position[3][3];  // [vertex][axis]
};

struct Bounds {
  float low[3], high[3];
};

/// A sphere, disk or other shape with finite bounds.
struct TreeShape {
  Bounds bounds;  // in world space
  uint shape;     // index into the scene's shapes
};

struct TreeInput {
  std::vector<TreeTriangle> triangles;  // a triangle's index here is its index into TriangleAttributes
  std::vector<TreeShape> shapes;
};

struct KdTree {
  std::vector<KdNode> nodes;  // at least one: an empty tree is a root without children
  std::vector<TriangleBlock> blocks;
  Bounds bounds{};  // of everything in the tree; zero if it is empty

  double build_seconds = 0;
  unsigned depth = 0;            // wide levels, at most KD_LEVELS
  std::uint64_t references = 0;  // lanes in use: primitives with their repetitions
  std::uint64_t skipped = 0;     // triangles of zero area, and such with NaN or infinite vertices
  std::uint64_t bytes() const {
    return nodes.size() * sizeof(KdNode) + blocks.size() * sizeof(TriangleBlock);
  }
};

/// Builds the tree by the surface area heuristic on `threads` threads (0: all of the machine). The tree
/// depends on the input alone, not on the number of threads. Throws UserError for more primitives than a tree
/// can index, or for more coincident ones than a leaf can hold (524,280).
KdTree build_kdtree(const TreeInput& input, unsigned threads);

/// A triangle's attributes as kernels read them. `normals` (unit, one a corner) may be null: a flat triangle.
TriangleAttributes triangle_attributes(uint material, const float (*normals)[3], const float (*uvs)[2]);

}  // namespace causticl
