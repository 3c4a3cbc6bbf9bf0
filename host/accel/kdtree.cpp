#include "accel/kdtree.hpp"

#include <chrono>

#include "accel/kdtree_binary.hpp"
#include "accel/kdtree_split.hpp"
#include "base/error.hpp"
#include "base/task_pool.hpp"

namespace causticl {
namespace {

using namespace kd;

constexpr unsigned width = 8;

// Which binary nodes become children of one wide node, by dynamic programming over the cost of the surface
// area heuristic (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide
// BVHs", 2017, section 4.1). The halves' costs must be known.
void choose_collapse(BinaryNode& node) {
  const float area = node.box.area();
  const float leaf = area * block_cost * blocks_of(node.count);
  node.as_leaf = true;
  node.cost.fill(leaf);
  if (node.leaf()) return;
  const auto& left = *node.child[0];
  const auto& right = *node.child[1];
  const auto distribute = [&](unsigned children) {
    float best = std::numeric_limits<float>::max();
    for (unsigned on_left = 1; on_left < children; ++on_left) {
      const float cost = left.cost[on_left - 1] + right.cost[children - on_left - 1];
      if (cost < best) best = cost, node.left_children[children - 1] = static_cast<std::uint8_t>(on_left);
    }
    return best;
  };
  const float inner = area + distribute(width);
  node.as_leaf = node.count <= leaf_limit && leaf <= inner;
  node.cost[0] = node.as_leaf ? leaf : inner;
  for (unsigned children = 2; children < width; ++children) {
    node.cost[children - 1] = distribute(children);
    if (node.cost[children - 1] >= node.cost[children - 2]) {
      node.cost[children - 1] = node.cost[children - 2];
      node.left_children[children - 1] = 0;
    }
  }
}

void choose_collapse_below(BinaryNode* node) {
  if (!node->leaf())
    for (const auto* child : node->child) choose_collapse_below(const_cast<BinaryNode*>(child));
  choose_collapse(*node);
}

class WideBuilder {
 public:
  WideBuilder(const TreeInput& input, KdTree& tree) : input_(input), tree_(tree) {}

  // `by_level`: every wide node takes three binary levels, which bounds the depth, in place of the cheapest
  // choice.
  void build(const BinaryNode* root, bool by_level) {
    by_level_ = by_level;
    tree_.nodes.assign(1, KdNode{});
    leaves_.clear();
    blocks_ = 0;
    tree_.depth = 0;
    const Float4 extent = root->box.high - root->box.low;
    tree_.nodes[0].extent = std::max({extent[0], extent[1], extent[2]});
    for (int k = 0; k < 3; ++k) {
      tree_.bounds.low[k] = root->box.low[k];
      tree_.bounds.high[k] = root->box.high[k];
    }
    emit(root, 0, 1);
  }

  void fill_blocks(unsigned threads) {
    tree_.blocks.resize(blocks_);
    std::vector<std::uint64_t> references(leaves_.size());
    parallel_chunks(leaves_.size(), 4096, threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) references[i] = fill_leaf(leaves_[i]);
    });
    for (const auto count : references) tree_.references += count;
  }

 private:
  struct Leaf {
    const BinaryNode* node;
    std::size_t first_block, block_count;
  };
  const TreeInput& input_;
  KdTree& tree_;
  bool by_level_ = false;
  std::vector<Leaf> leaves_;
  std::size_t blocks_ = 0;

  bool is_leaf(const BinaryNode* node) const { return by_level_ ? node->leaf() : node->as_leaf; }

  // The binary nodes, at most `count`, that become children of the wide node made of `node`.
  void children_of(const BinaryNode* node, unsigned count, std::vector<const BinaryNode*>& out) const {
    if (by_level_) {
      if (count == 1 || node->leaf()) return out.push_back(node);
      for (const auto* child : node->child) children_of(child, count / 2, out);
      return;
    }
    while (count > 1 && node->left_children[count - 1] == 0) --count;
    if (count == 1) return out.push_back(node);
    const unsigned left = node->left_children[count - 1];
    children_of(node->child[0], left, out);
    children_of(node->child[1], count - left, out);
  }

  void emit(const BinaryNode* node, uint index, unsigned level) {
    tree_.depth = std::max(tree_.depth, level);
    std::vector<const BinaryNode*> children;
    if (is_leaf(node))
      children.push_back(node);
    else
      children_of(node, width, children);
    constexpr float huge = std::numeric_limits<float>::max();
    std::vector<std::pair<const BinaryNode*, uint>> inner;
    for (unsigned slot = 0; slot < width; ++slot) {
      KdNode& wide = tree_.nodes[index];
      const BinaryNode* child = slot < children.size() ? children[slot] : nullptr;
      for (int k = 0; k < 3; ++k) {
        wide.bounds[k][slot] = child ? child->box.low[k] : huge;
        wide.bounds[3 + k][slot] = child ? child->box.high[k] : -huge;
      }
      if (!child) continue;
      if (is_leaf(child)) {
        emit_leaf(child, wide, slot);
      } else {
        const uint below = static_cast<uint>(tree_.nodes.size());
        wide.child[slot] = below;
        tree_.nodes.emplace_back();
        tree_.nodes.back().parent = index;
        tree_.nodes.back().slot = slot;
        inner.emplace_back(child, below);
      }
    }
    for (const auto& [child, below] : inner) emit(child, below, level + 1);
  }

  void emit_leaf(const BinaryNode* node, KdNode& wide, unsigned slot) {
    const std::size_t count = (node->count + block_lanes - 1) / block_lanes;
    if (count > 0xffff)
      throw UserError(
          "the scene has " + std::to_string(node->count) +
          " primitives in one place that cannot be separated; expected at most 524280: remove duplicates");
    if (blocks_ + count > KD_INDEX)
      throw UserError("the scene has more primitives than one tree can index; expected fewer triangles");
    wide.child[slot] = KD_LEAF | (has_shapes(node) ? KD_SHAPES : 0u) | static_cast<uint>(blocks_);
    wide.block_count[slot] = static_cast<ushort>(count);
    leaves_.push_back({node, blocks_, count});
    blocks_ += count;
  }

  bool has_shapes(const BinaryNode* node) const {
    if (input_.shapes.empty()) return false;
    if (!node->leaf()) return has_shapes(node->child[0]) || has_shapes(node->child[1]);
    return std::any_of(node->primitives, node->primitives + node->count,
                       [&](uint primitive) { return primitive >= input_.triangles.size(); });
  }

  static void collect(const BinaryNode* node, std::vector<uint>& out) {
    if (node->leaf()) {
      out.insert(out.end(), node->primitives, node->primitives + node->count);
      return;
    }
    for (const auto* child : node->child) collect(child, out);
  }

  std::uint64_t fill_leaf(const Leaf& leaf) {
    std::vector<uint> primitives;
    collect(leaf.node, primitives);
    std::sort(primitives.begin(), primitives.end());
    primitives.erase(std::unique(primitives.begin(), primitives.end()), primitives.end());
    for (std::size_t lane = 0; lane < leaf.block_count * block_lanes; ++lane)
      fill_lane(tree_.blocks[leaf.first_block + lane / block_lanes], lane % block_lanes,
                lane < primitives.size() ? primitives[lane] : BLOCK_EMPTY);
    return primitives.size();
  }

  void fill_lane(TriangleBlock& block, std::size_t lane, uint primitive) const {
    for (auto& vertex : block.position)
      for (auto& axis : vertex) axis[lane] = std::numeric_limits<float>::quiet_NaN();
    block.primitive[lane] = primitive;
    if (primitive < input_.triangles.size()) {
      for (int v = 0; v < 3; ++v)
        for (int k = 0; k < 3; ++k) block.position[v][k][lane] = input_.triangles[primitive].position[v][k];
    } else if (primitive != BLOCK_EMPTY) {
      const auto& shape = input_.shapes[primitive - input_.triangles.size()];
      block.primitive[lane] = BLOCK_SHAPE | shape.shape;
      for (int k = 0; k < 3; ++k) {
        block.position[0][k][lane] = shape.bounds.low[k];
        block.position[1][k][lane] = shape.bounds.high[k];
      }
    }
  }
};

// Octahedral coordinates of a unit vector, 16 bits each (Cigolle et al., JCGT 2014).
uint octahedral(const float (&n)[3]) {
  const double sum = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  if (!(sum > 0)) return octahedral({0, 0, 1});
  double x = n[0] / sum, y = n[1] / sum;
  if (n[2] < 0) {
    const double folded = (1 - std::fabs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::fabs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const auto bits = [](double v) { return static_cast<uint>(std::lround((v + 1) * 0.5 * 65535)); };
  return bits(x) | bits(y) << 16;
}

}  // namespace

KdTree build_kdtree(const TreeInput& input, unsigned threads) {
  const auto start = std::chrono::steady_clock::now();
  if (input.triangles.size() + input.shapes.size() > KD_INDEX)
    throw UserError("the scene has " + std::to_string(input.triangles.size()) +
                    " triangles; expected at most " + std::to_string(KD_INDEX));
  KdTree tree;
  auto binary = build_binary(input, threads);
  tree.skipped = binary.skipped;
  if (binary.root) {
    choose_collapse_below(binary.root);
    WideBuilder wide(input, tree);
    wide.build(binary.root, false);
    if (tree.depth > KD_LEVELS) wide.build(binary.root, true);
    wide.fill_blocks(threads);
  } else {
    tree.nodes.assign(1, KdNode{});
  }
  tree.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return tree;
}

TriangleAttributes triangle_attributes(uint material, const float (*normals)[3], const float (*uvs)[2]) {
  TriangleAttributes result{};
  result.material = material | (normals ? TRIANGLE_SMOOTH : 0u);
  for (int corner = 0; corner < 3; ++corner) {
    if (normals) result.normal[corner] = octahedral(normals[corner]);
    if (uvs) result.uv[corner] = {uvs[corner][0], uvs[corner][1]};
  }
  return result;
}

}  // namespace causticl
