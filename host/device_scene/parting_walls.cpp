#include "device_scene/parting_walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace causticl {
namespace {

/// Of the radius: the length of the straight path (WALL_STRAIGHT_HEIGHT of cl/photons/walls.cl) at most.
/// Where that is free, no wall matters.
constexpr double straight_ratio = 1.05;

/// Of the radius: the edge of the cubes in which one primitive stands for others, and how large those are at
/// most.
constexpr double cube_ratio = 0.25;

/// How often one primitive is looked at as what another may part, in all: about a second. What remains is
/// taken for walls.
constexpr std::size_t most_looks = 5'000'000;

}  // namespace

PartingWalls::PartingWalls(const std::vector<WallPrimitive>& primitives, const WallCells& cells,
                           double radius)
    : primitives_(primitives),
      cells_(cells),
      radius_(radius),
      answers_(primitives.size(), Answer::unknown),
      occupants_(cells.count()),
      looks_left_(most_looks) {
  choose_representatives();
  for (std::uint32_t i = 0; i < primitives.size(); ++i) {
    if (representative_[i] != i) continue;
    if (std::isfinite(primitives[i].low.x))
      cells.visit(
          primitives[i], 0, [](std::size_t) { return true; },
          [&](std::size_t index) { occupants_[index].push_back(i); });
    else
      planes_.push_back(i);
  }
}

WallReach PartingWalls::reach() const {
  return {(straight_ratio + std::sqrt(3.0) * cube_ratio) * radius_, cube_ratio * radius_,
          dense_ratio * radius_, cells_.tolerance()};
}

void PartingWalls::choose_representatives() {
  constexpr double most_cubes = 1 << 16;  // along each axis
  representative_.resize(primitives_.size());
  // By the part of a mesh: what parts two sheets must not stand for both.
  std::map<std::pair<std::int32_t, std::uint64_t>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < primitives_.size(); ++i) {
    representative_[i] = i;
    const WallPrimitive& primitive = primitives_[i];
    if (primitive.corners.empty() || !(size_of(primitive) <= cube_ratio * radius_)) continue;
    const Vec3 place = (primitive.low - cells_.low()) / (cube_ratio * radius_);
    if (!(max_component(place) < most_cubes)) continue;
    std::uint64_t key = static_cast<std::uint64_t>(NormalBins::number(normal_of(primitive)));
    for (int axis = 0; axis < 3; ++axis) key = key << 16 | static_cast<std::uint64_t>(place[axis]);
    const int likeness =
        (primitive.blocks ? 1 : 0) + (primitive.receives ? 2 : 0) + 4 * (primitive.lit_side + 1);
    representative_[i] =
        first.try_emplace({primitive.part, key << 4 | static_cast<std::uint64_t>(likeness)}, i).first->second;
  }
}

bool PartingWalls::is_small(std::uint32_t i) const { return size_of(primitives_[i]) < 2 * cells_.edge(); }

bool PartingWalls::parts(std::uint32_t i) {
  i = representative_[i];
  if (answers_[i] == Answer::unknown) {
    const WallPrimitive& wall = primitives_[i];
    const Vec3 half = 0.5 * (wall.high - wall.low) + Vec3{1, 1, 1} * cells_.tolerance();
    const WallBox box{0.5 * (wall.low + wall.high), half};
    const bool parting = parts(i, others_in({box.centre, half + Vec3{1, 1, 1} * reach().path}), box);
    answers_[i] = parting ? Answer::yes : Answer::no;
  }
  return answers_[i] == Answer::yes;
}

bool PartingWalls::parts(std::uint32_t i, const Primitives& others, const WallBox& box) {
  if (others.size() >= looks_left_) {
    looks_left_ = 0;
    return true;
  }
  looks_left_ -= others.size();
  return parts_others(bins_, primitives_[i], others, box, reach());
}

PartingWalls::Primitives PartingWalls::others_in(const WallBox& box) {
  if (looks_left_ == 0) return {};
  std::vector<std::uint32_t> found = planes_;
  cells_.visit(box.centre - box.half, box.centre + box.half, 0, [&](std::size_t index) {
    found.insert(found.end(), occupants_[index].begin(), occupants_[index].end());
  });
  looks_left_ -= std::min(looks_left_, found.size() / 4);  // which takes time as well
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  Primitives result;
  for (const std::uint32_t i : found)
    if (may_reach(primitives_[i], box, 0)) result.push_back(&primitives_[i]);
  return result;
}

}  // namespace causticl
