#include "accel/triangle_transforms.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/task_pool.hpp"
#include "base/vec.hpp"

namespace causticl {

TriangleTransforms triangle_transforms(const TriangleBlock& block) {
  TriangleTransforms map{};
  for (int lane = 0; lane < 8; ++lane) {
    if (block.primitive[lane] & BLOCK_SHAPE) {
      for (auto& row : map.row)
        for (auto& factor : row) factor[lane] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    Vec3 corner[3];
    for (int v = 0; v < 3; ++v)
      for (int k = 0; k < 3; ++k) corner[v][k] = static_cast<double>(block.position[v][k][lane]);
    const Vec3 a = corner[0], e = corner[1] - a, f = corner[2] - a, n = cross(e, f);
    int z = 0;
    for (int k : {1, 2})
      if (std::fabs(n[k]) > std::fabs(n[z])) z = k;
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    // Rounded to single precision once, at the end.
    const double rows[3][3] = {{f[y] / n[z], -f[x] / n[z], (f[x] * a[y] - f[y] * a[x]) / n[z]},
                               {-e[y] / n[z], e[x] / n[z], (e[y] * a[x] - e[x] * a[y]) / n[z]},
                               {n[x] / n[z], n[y] / n[z], -dot(n, a) / n[z]}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) map.row[i][j][lane] = static_cast<float>(rows[i][j]);
    map.axis[lane] = static_cast<float>(z);
  }
  return map;
}

void add_triangle_transforms(KdTree& tree, unsigned threads) {
  if (tree.blocks.size() * 2 > KD_INDEX)
    throw UserError("the scene has more triangles than --triangle-test precomputed can index");
  static_assert(sizeof(TriangleTransforms) == sizeof(TriangleBlock));
  std::vector<TriangleBlock> blocks(tree.blocks.size() * 2);
  parallel_chunks(tree.blocks.size(), 4096, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      blocks[2 * i] = tree.blocks[i];
      blocks[2 * i + 1] = std::bit_cast<TriangleBlock>(triangle_transforms(tree.blocks[i]));
    }
  });
  tree.blocks = std::move(blocks);
  for (auto& node : tree.nodes)
    for (auto& child : node.child)
      if (child & KD_LEAF) child += child & KD_INDEX;
}

}  // namespace causticl
