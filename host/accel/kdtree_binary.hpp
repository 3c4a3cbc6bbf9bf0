// The binary KD-tree from which the wide one is collapsed.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <vector>

#include "accel/kdtree_bounds.hpp"

namespace causticl::kd {

// A wide node takes three binary levels, so this depth always fits into KD_LEVELS wide ones.
constexpr unsigned binary_depth_limit = 3 * KD_LEVELS - 2;

struct BinaryNode {
  Box box;
  const BinaryNode* child[2] = {nullptr, nullptr};  // none: a leaf
  const uint* primitives = nullptr;                 // of a leaf
  uint count = 0;                                   // of primitives below, each once
  // The collapse to wide nodes: cost[i - 1] of covering the node by at most i children of one wide node, and
  // how many of them the left half gets (0: as with i - 1).
  std::array<float, 8> cost;
  std::array<std::uint8_t, 8> left_children{};
  bool as_leaf = true;  // whether one child that covers the node is a leaf

  bool leaf() const { return child[0] == nullptr; }
};

/// Owns the nodes and the leaves' lists; one a thread.
class Arena {
 public:
  BinaryNode* node() { return &nodes_.emplace_back(); }
  uint* primitives(std::size_t count);

 private:
  std::deque<BinaryNode> nodes_;
  std::vector<std::unique_ptr<uint[]>> chunks_;
  std::size_t used_ = 0, capacity_ = 0;
};

struct BinaryTree {
  std::deque<Arena> arenas;
  BinaryNode* root = nullptr;  // null where there is nothing
  std::uint64_t skipped = 0;
};

BinaryTree build_binary(const TreeInput& input, unsigned threads);

}  // namespace causticl::kd
