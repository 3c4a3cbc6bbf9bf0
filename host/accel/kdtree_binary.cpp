#include "accel/kdtree_binary.hpp"

#include "accel/kdtree_split.hpp"
#include "base/task_pool.hpp"

namespace causticl::kd {
namespace {

using References = std::vector<Reference>;

constexpr std::size_t leaf_size = 8;
constexpr std::size_t task_size = 4096;  // smaller subtrees are built in one piece
constexpr unsigned stall_limit = 3;      // cuts in a row without gain

class Builder {
 public:
  Builder(const TreeInput& input, std::deque<Arena>& arenas, TaskPool& pool)
      : input_(input), arenas_(arenas), pool_(pool) {}

  // Collapse costs of a node are known only when both halves are: they are computed afterwards.
  void build(BinaryNode* node, References references, unsigned depth, unsigned stalled, unsigned thread) {
    for (const auto& reference : references) node->box.extend(reference.box);
    node->count = static_cast<uint>(references.size());
    Split split;
    if (references.size() > leaf_size && depth < binary_depth_limit) {
      split = find_split(references, node->box);
      const float area = node->box.area();
      const bool gain = split.cost + binary_cost * area < block_cost * blocks_of(references.size()) * area;
      stalled = gain ? 0 : stalled + 1;
      if (!gain && (references.size() <= leaf_limit || stalled > stall_limit)) split.axis = -1;
    }
    if (split.axis < 0) return make_leaf(node, references, thread);

    References halves[2];
    partition(references, split, halves);
    const std::size_t whole = references.size();
    if (halves[0].empty() || halves[1].empty() || (halves[0].size() >= whole && halves[1].size() >= whole))
      return make_leaf(node, references, thread);
    References().swap(references);

    BinaryNode* children[2] = {arenas_[thread].node(), arenas_[thread].node()};
    node->child[0] = children[0];
    node->child[1] = children[1];
    for (int side : {1, 0}) {
      if (halves[side].size() >= task_size)
        pool_.add([this, child = children[side], half = std::move(halves[side]), depth,
                   stalled](unsigned worker) mutable {
          build(child, std::move(half), depth + 1, stalled, worker);
        });
      else
        build(children[side], std::move(halves[side]), depth + 1, stalled, thread);
    }
  }

 private:
  const TreeInput& input_;
  std::deque<Arena>& arenas_;
  TaskPool& pool_;

  void make_leaf(BinaryNode* node, const References& references, unsigned thread) {
    uint* primitives = arenas_[thread].primitives(references.size());
    node->primitives = primitives;
    for (const auto& reference : references) *primitives++ = reference.primitive();
  }

  void partition(const References& references, const Split& split, References (&halves)[2]) const {
    halves[0].reserve(references.size() / 2 + 8);
    halves[1].reserve(references.size() / 2 + 8);
    for (const auto& reference : references) {
      const bool in_left = split.in_left(reference.box), in_right = split.in_right(reference.box);
      if (!in_left || !in_right) {
        halves[in_right ? 1 : 0].push_back(reference);
        continue;
      }
      Box left, right;
      split_reference(input_, reference, split.axis, split.position, left, right);
      if (left.empty() && right.empty()) left = reference.box;  // cannot be: kept rather than lost
      if (!left.empty()) halves[0].push_back(Reference::make(left, reference.primitive()));
      if (!right.empty()) halves[1].push_back(Reference::make(right, reference.primitive()));
    }
  }
};

// Whether six products of two floats each, which a double holds exactly, do not sum to zero: an exact sum by
// growing an expansion (Shewchuk, "Adaptive Precision Floating-Point Arithmetic", 1997).
bool sum_is_nonzero(const double (&terms)[6]) {
  double expansion[6] = {};
  for (int size = 0; size < 6; ++size) {
    double carry = terms[size];
    for (int i = 0; i < size; ++i) {
      const double sum = carry + expansion[i], part = sum - carry;
      expansion[i] = (carry - (sum - part)) + (expansion[i] - part);
      carry = sum;
    }
    expansion[size] = carry;
  }
  return std::any_of(expansion, expansion + 6, [](double part) { return part != 0; });
}

// Whether the triangle has area, exactly: in one of its projections along the axes.
bool has_area(const TreeTriangle& triangle) {
  const auto& [a, b, c] = triangle.position;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto product = [](float x, float y) { return static_cast<double>(x) * y; };
    const double left = (static_cast<double>(b[i]) - a[i]) * (static_cast<double>(c[j]) - a[j]);
    const double right = (static_cast<double>(b[j]) - a[j]) * (static_cast<double>(c[i]) - a[i]);
    if (std::fabs(left - right) > 1e-15 * (std::fabs(left) + std::fabs(right))) return true;
    if (sum_is_nonzero({product(a[i], b[j]), -product(a[j], b[i]), product(b[i], c[j]), -product(b[j], c[i]),
                        product(c[i], a[j]), -product(c[j], a[i])}))
      return true;
  }
  return false;
}

// The bounds of a triangle; empty for one without area, or with a vertex that is not finite.
Box triangle_box(const TreeTriangle& triangle) {
  Box box;
  for (int k = 0; k < 3; ++k)
    for (int v = 0; v < 3; ++v) {
      const float x = triangle.position[v][k];
      if (!std::isfinite(x)) return {};
      box.low[k] = std::min(box.low[k], x);
      box.high[k] = std::max(box.high[k], x);
    }
  return has_area(triangle) ? box : Box{};
}

}  // namespace

uint* Arena::primitives(std::size_t count) {
  if (used_ + count > capacity_ || chunks_.empty()) {
    capacity_ = std::max<std::size_t>(count, 1 << 16);
    chunks_.emplace_back(new uint[capacity_]);
    used_ = 0;
  }
  uint* result = chunks_.back().get() + used_;
  used_ += count;
  return result;
}

BinaryTree build_binary(const TreeInput& input, unsigned threads) {
  BinaryTree tree;
  References references;
  references.reserve(input.triangles.size() + input.shapes.size());
  for (std::size_t i = 0; i < input.triangles.size(); ++i) {
    const Box box = triangle_box(input.triangles[i]);
    if (box.empty())
      ++tree.skipped;
    else
      references.push_back(Reference::make(box, static_cast<uint>(i)));
  }
  for (std::size_t i = 0; i < input.shapes.size(); ++i) {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.low[k] = input.shapes[i].bounds.low[k];
      box.high[k] = input.shapes[i].bounds.high[k];
    }
    references.push_back(Reference::make(box, static_cast<uint>(input.triangles.size() + i)));
  }
  if (references.empty()) return tree;

  TaskPool pool(threads);
  tree.arenas.resize(pool.threads());
  tree.root = tree.arenas[0].node();
  Builder builder(input, tree.arenas, pool);
  pool.add([&](unsigned worker) { builder.build(tree.root, std::move(references), 0, 0, worker); });
  pool.run();
  return tree;
}

}  // namespace causticl::kd
