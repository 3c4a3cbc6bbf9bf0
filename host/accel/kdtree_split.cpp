#include "accel/kdtree_split.hpp"

#include <array>

namespace causticl::kd {
namespace {

constexpr int bins = 32;
constexpr std::size_t exact_limit = 24;  // up to here every bound of a reference is a candidate

// The expected tests of n primitives: whole blocks where they may become one leaf.
float tests(std::uint64_t n) {
  return block_cost * (n <= leaf_limit ? blocks_of(n) : static_cast<float>(n) / block_lanes);
}

// Takes the candidate if it is cheaper: `left` and `right` hold all boxes that reach over to their side.
void consider(Split& best, int axis, float position, bool planar_left, Box left, Box right,
              std::uint64_t left_count, std::uint64_t right_count) {
  left.high[axis] = std::min(left.high[axis], position);
  right.low[axis] = std::max(right.low[axis], position);
  float cost = 0;
  if (left_count) cost += left.area() * tests(left_count);
  if (right_count) cost += right.area() * tests(right_count);
  if (cost < best.cost) best = {axis, position, planar_left, cost};
}

void consider_plane(Split& best, std::span<const Reference> references, int axis, float position,
                    bool planar_left) {
  const Split plane{axis, position, planar_left, 0};
  Box left, right;
  std::uint64_t left_count = 0, right_count = 0;
  for (const auto& reference : references) {
    if (plane.in_left(reference.box)) left.extend(reference.box), ++left_count;
    if (plane.in_right(reference.box)) right.extend(reference.box), ++right_count;
  }
  if (left_count < references.size() && right_count < references.size())
    consider(best, axis, position, planar_left, left, right, left_count, right_count);
}

// Every bound of a reference, by two sweeps over sorted bounds.
void exact_splits(Split& best, std::span<const Reference> references, const Box& bounds) {
  const int n = static_cast<int>(references.size());
  std::array<int, exact_limit> by_low, by_high;
  std::array<Box, exact_limit + 1> below,
      above;  // below[i]: the first i by low; above[i]: the last i by high
  for (int axis = 0; axis < 3; ++axis) {
    if (!(bounds.low[axis] < bounds.high[axis])) continue;
    const auto low = [&](int i) { return references[i].box.low[axis]; };
    const auto high = [&](int i) { return references[i].box.high[axis]; };
    for (int i = 0; i < n; ++i) by_low[i] = by_high[i] = i;
    // Planar references come first at their plane by low, and last by high.
    std::sort(by_low.begin(), by_low.begin() + n, [&](int a, int b) {
      return low(a) != low(b) ? low(a) < low(b) : high(a) != high(b) ? high(a) < high(b) : a < b;
    });
    std::sort(by_high.begin(), by_high.begin() + n, [&](int a, int b) {
      return high(a) != high(b) ? high(a) > high(b) : low(a) != low(b) ? low(a) > low(b) : a < b;
    });
    below[0] = above[0] = Box{};
    for (int i = 0; i < n; ++i) {
      below[i + 1] = below[i];
      below[i + 1].extend(references[by_low[i]].box);
      above[i + 1] = above[i];
      above[i + 1].extend(references[by_high[i]].box);
    }
    // Positions in ascending order: lows and highs merged.
    int next_low = 0, next_high = n - 1, lefts = 0, rights = n;
    while (next_low < n || next_high >= 0) {
      const float position = std::min(next_low < n ? low(by_low[next_low]) : bounds.high[axis],
                                      next_high >= 0 ? high(by_high[next_high]) : bounds.high[axis]);
      // Below the plane lie those with low < position; above it those with high > position.
      while (lefts < n && low(by_low[lefts]) < position) ++lefts;
      int planar = 0;
      while (lefts + planar < n && low(by_low[lefts + planar]) == position &&
             high(by_low[lefts + planar]) == position)
        ++planar;
      while (rights > 0 && high(by_high[rights - 1]) <= position) --rights;
      if (lefts + planar < n && rights < n)
        consider(best, axis, position, true, below[lefts + planar], above[rights], lefts + planar, rights);
      if (planar && lefts < n && rights + planar < n)
        consider(best, axis, position, false, below[lefts], above[rights + planar], lefts, rights + planar);
      while (next_low < n && low(by_low[next_low]) <= position) ++next_low;
      while (next_high >= 0 && high(by_high[next_high]) <= position) --next_high;
    }
  }
}

struct Bin {
  Box entering, leaving;  // of the references whose low, or high, bound lies in the bin
  std::uint32_t enter = 0, leave = 0;
};

void binned_splits(Split& best, std::span<const Reference> references, const Box& bounds) {
  static thread_local std::array<std::array<Bin, bins>, 3> table;
  for (auto& axis : table) axis.fill(Bin{});
  const Float4 extent = bounds.high - bounds.low;
  Float4 scale{};
  for (int k = 0; k < 3; ++k)
    scale[k] = extent[k] > 0 && std::isfinite(bins / extent[k]) ? bins / extent[k] : 0.f;
  const auto bin_of = [](float x) { return std::clamp(static_cast<int>(x), 0, bins - 1); };
  for (const auto& reference : references) {
    const Float4 low = (reference.box.low - bounds.low) * scale,
                 high = (reference.box.high - bounds.low) * scale;
    for (int k = 0; k < 3; ++k) {
      Bin& first = table[k][bin_of(low[k])];
      first.entering.extend(reference.box);
      ++first.enter;
      Bin& last = table[k][bin_of(high[k])];
      last.leaving.extend(reference.box);
      ++last.leave;
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (scale[k] == 0) continue;
    std::array<Box, bins> right;
    std::array<std::uint64_t, bins> right_count;
    Box sum;
    std::uint64_t count = 0;
    for (int b = bins - 1; b > 0; --b) {
      sum.extend(table[k][b].leaving);
      count += table[k][b].leave;
      right[b] = sum;
      right_count[b] = count;
    }
    sum = Box{};
    count = 0;
    for (int b = 1; b < bins; ++b) {
      sum.extend(table[k][b - 1].entering);
      count += table[k][b - 1].enter;
      if (count == references.size() || right_count[b] == references.size()) continue;
      consider(best, k, bounds.low[k] + static_cast<float>(b) / scale[k], true, sum, right[b], count,
               right_count[b]);
    }
  }
}

// Where a few big primitives inflate the bounds (walls round a statue), the bounds of the small ones.
void peeling_splits(Split& best, std::span<const Reference> references, const Box& bounds) {
  const Float4 half = (bounds.high - bounds.low) * 0.5f;
  Box small;
  std::size_t big = 0;
  for (const auto& reference : references) {
    const Float4 extent = reference.box.high - reference.box.low;
    if (extent[0] > half[0] || extent[1] > half[1] || extent[2] > half[2])
      ++big;
    else
      small.extend(reference.box);
  }
  if (big == 0 || big == references.size() || small.area() > 0.8f * bounds.area()) return;
  for (int k = 0; k < 3; ++k) {
    if (small.low[k] > bounds.low[k]) consider_plane(best, references, k, small.low[k], true);
    if (small.high[k] < bounds.high[k]) consider_plane(best, references, k, small.high[k], false);
  }
}

}  // namespace

Split find_split(std::span<const Reference> references, const Box& bounds) {
  Split best;
  if (references.size() <= exact_limit) {
    exact_splits(best, references, bounds);
  } else {
    binned_splits(best, references, bounds);
    peeling_splits(best, references, bounds);
  }
  return best;
}

}  // namespace causticl::kd
