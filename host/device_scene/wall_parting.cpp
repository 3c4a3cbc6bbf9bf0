#include "device_scene/wall_parting.hpp"

#include <algorithm>
#include <cmath>

#include "device_scene/wall_facing.hpp"

namespace causticl {
namespace {

constexpr double kept_apart_cosine = 0.45;  // below GATHER_NORMAL_COSINE, for what packed normals lose

constexpr int across = 8;  // bins along the edge of a face

/// A corner of the bin, or its middle at (0.5, 0.5).
Vec3 direction(int bin, double u, double v) {
  const int face = bin / (across * across), axis = face / 2;
  Vec3 n;
  n[axis] = face % 2 ? -1 : 1;
  n[(axis + 1) % 3] = 2 * (bin / across % across + u) / across - 1;
  n[(axis + 2) % 3] = 2 * (bin % across + v) / across - 1;
  return normalize(n);
}

/// The angle from the middle of the bin to its farthest corner.
double radius_of(int bin) {
  double cosine = 1;
  for (int corner = 0; corner < 4; ++corner)
    cosine = std::min(cosine, dot(direction(bin, 0.5, 0.5), direction(bin, corner & 1, corner >> 1)));
  return std::acos(cosine);
}

/// A side of a surface that may be lit.
struct LitSide {
  bool curved = false;  // has all normals
  Vec3 normal;
  bool faces_wall = false;

  NormalBins::Set bins() const { return curved ? NormalBins::Set{}.set() : NormalBins::of(normal); }
};

bool normals_may_agree(const LitSide& a, const LitSide& b) {
  return a.curved || b.curved || dot(a.normal, b.normal) > kept_apart_cosine;
}

/// Lit sides on one side of a wall.
class SidesBeside {
 public:
  void add(const LitSide& side) {
    normals_ |= side.bins();
    sides_.push_back(side);
  }

  /// Whether one of them and that one, which is on the other side of the wall, may be parted by it.
  bool may_be_parted_from(const NormalBins& bins, const LitSide& other) const {
    return bins.may_agree(other.bins(), normals_) &&
           std::any_of(sides_.begin(), sides_.end(), [&](const LitSide& side) {
             return (side.faces_wall || other.faces_wall) && normals_may_agree(side, other);
           });
  }

  bool empty() const { return sides_.empty(); }

 private:
  NormalBins::Set normals_;
  std::vector<LitSide> sides_;
};

/// The bounds of what of the primitive lies in the box, and what is within `reach` of them.
WallBox grown_bounds(const WallPrimitive& primitive, const WallBox& box, double reach) {
  const Vec3 everywhere{INFINITY, INFINITY, INFINITY};
  Vec3 low = primitive.low, high = primitive.high;
  if (!primitive.corners.empty()) {
    low = everywhere;
    high = -everywhere;
    for (const Vec3 corner : clipped(primitive.corners, box))
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], corner[axis]);
        high[axis] = std::max(high[axis], corner[axis]);
      }
  }
  constexpr double endless = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::max({low[axis], box.centre[axis] - box.half[axis], -endless}) - reach;
    high[axis] = std::min({high[axis], box.centre[axis] + box.half[axis], endless}) + reach;
  }
  return {0.5 * (low + high), 0.5 * (high - low)};
}

/// Whether the bounds of the primitive miss the box, and whether they lie in it.
bool is_apart(const WallPrimitive& primitive, const WallBox& box) {
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
    apart = apart || primitive.low[axis] > box.centre[axis] + box.half[axis] ||
            primitive.high[axis] < box.centre[axis] - box.half[axis];
  return apart;
}
bool is_within(const WallPrimitive& primitive, const WallBox& box) {
  bool within = true;
  for (int axis = 0; axis < 3; ++axis)
    within = within && primitive.low[axis] >= box.centre[axis] - box.half[axis] &&
             primitive.high[axis] <= box.centre[axis] + box.half[axis];
  return within;
}

}  // namespace

NormalBins::NormalBins() {
  std::array<Vec3, count> middle;
  std::array<double, count> radius;
  for (int i = 0; i < count; ++i) {
    middle[static_cast<std::size_t>(i)] = direction(i, 0.5, 0.5);
    radius[static_cast<std::size_t>(i)] = radius_of(i);
  }
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const double angle = std::acos(std::clamp(dot(middle[i], middle[j]), -1.0, 1.0));
      if (angle - radius[i] - radius[j] < std::acos(kept_apart_cosine)) agreeing_[i].set(j);
    }
}

int NormalBins::number(Vec3 n) {
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
  const auto place = [&](int k) {
    return std::clamp(static_cast<int>((n[k] / std::fabs(n[axis]) + 1) * 0.5 * across), 0, across - 1);
  };
  const int face = 2 * axis + (n[axis] < 0 ? 1 : 0);
  return (face * across + place((axis + 1) % 3)) * across + place((axis + 2) % 3);
}

bool NormalBins::may_agree(const Set& a, const Set& b) const {
  for (std::size_t i = 0; i < count; ++i)
    if (a[i] && (agreeing_[i] & b).any()) return true;
  return false;
}

bool parts_others(const NormalBins& bins, const WallPrimitive& wall,
                  const std::vector<const WallPrimitive*>& others, const WallBox& box,
                  const WallReach& reach) {
  if (!wall.blocks) return false;
  const WallBox region = grown_bounds(wall, box, reach.path);
  const std::vector<Vec3> wall_polygon = clipped(wall.corners, box);
  const bool dense = wall.part >= 0 && size_of(wall) <= reach.dense;
  SidesBeside front, back;
  // First the others that are not of the same dense part: of any pair one is.
  for (const bool own : {false, true}) {
    if (own && (!dense || (front.empty() && back.empty()))) return false;
    for (const WallPrimitive* other : others) {
      const bool is_own = dense && other->part == wall.part && size_of(*other) <= reach.dense;
      if (is_own != own || !other->receives || is_apart(*other, region)) continue;
      const auto polygon = is_within(*other, region) ? other->corners : clipped(other->corners, region);
      if (!other->corners.empty() && polygon.empty()) continue;
      const bool itself = other == &wall;
      // The inside of a sphere has the normals of the outside across it.
      if (itself && wall.wall.origin.w == WALL_SPHERE && wall.lit_side == 0 &&
          2 * wall.wall.normal.w <= reach.path)
        return true;
      // What stands for others tells no more than that these are near it.
      const bool stands_for_others = other->part >= 0 && !own && size_of(*other) <= reach.tiny;
      const double tolerance = stands_for_others ? -std::sqrt(3.0) * reach.tiny : reach.tolerance;
      const WallSides where = itself ? WallSides{} : sides_of(wall, *other, polygon, tolerance);
      const WallSides faced = itself ? WallSides{} : faced_by(*other, wall, wall_polygon, reach);
      for (const int side : {1, -1}) {
        if (side == -other->lit_side) continue;
        const LitSide lit{other->wall.origin.w == WALL_SPHERE, side * normal_of(*other),
                          side > 0 ? faced.front : faced.back};
        // What lies in the plane of the wall is on the side that it faces.
        const bool in_plane = !where.front && !where.back;
        const bool ahead = itself ? side > 0 : dot(lit.normal, normal_of(wall)) > 0;
        const bool in_front = where.front || (in_plane && ahead), behind = where.back || (in_plane && !ahead);
        // What goes through the wall may be parted from itself.
        if (in_front && behind && lit.faces_wall && !own) return true;
        if ((in_front && back.may_be_parted_from(bins, lit)) ||
            (behind && front.may_be_parted_from(bins, lit)))
          return true;
        if (in_front && !own) front.add(lit);
        if (behind && !own) back.add(lit);
      }
    }
  }
  return false;
}

}  // namespace causticl
