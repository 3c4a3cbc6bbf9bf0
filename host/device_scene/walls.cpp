#include "device_scene/walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "device_scene/parting_walls.hpp"
#include "device_scene/wall_cells.hpp"
#include "device_scene/wall_primitives.hpp"

namespace causticl {
namespace {

/// Of the radius: how far from a visible point a path to a photon may run (WALL_OVER_HEIGHT of
/// cl/photons/walls.cl), and some.
constexpr double reach_ratio = 1.4;

/// Of more parting walls groups have boxes around them.
constexpr std::size_t most_ungrouped = 2 * WALL_GROUP;

/// What lies near a cell.
struct Cell {
  std::uint32_t count = 0;
  bool receives = false;      // a surface that may hold visible points passes through it
  bool is_dense_part = true;  // all near it are of one part of a mesh, and small beside the radius
  std::int32_t part = -1;     // of the first

  bool may_have_walls() const { return receives && count > 1 && !is_dense_part; }
};

/// The walls of a cell by numbers of primitives.
struct CellWalls {
  std::vector<std::uint32_t> parting, large, others;
};

class WallGridBuilder {
 public:
  WallGridBuilder(std::vector<WallPrimitive> primitives, double radius)
      : primitives_(std::move(primitives)),
        reach_(reach_ratio * radius),
        dense_(PartingWalls::dense_ratio * radius),
        cells_(primitives_, radius, reach_),
        parting_(primitives_, cells_, radius) {}

  std::vector<std::byte> build() {
    look_around();
    lists_.resize(cells_.count() + 1);
    for (std::uint32_t i = 0; i < primitives_.size(); ++i)
      if (primitives_[i].blocks) list_if_parting(i);
    for (std::size_t index = 0; index < lists_.size(); ++index) try_large(index);
    for (std::uint32_t i = 0; i < primitives_.size(); ++i)
      if (primitives_[i].blocks) list_beside_parting(i);
    return packed();
  }

 private:
  const std::vector<WallPrimitive> primitives_;
  const double reach_, dense_;
  const WallCells cells_;
  PartingWalls parting_;
  std::vector<Cell> near_;
  std::vector<CellWalls> lists_;  // first of what lies beyond the grid, then of each cell

  void look_around() {
    near_.resize(cells_.count());
    for (const auto& primitive : primitives_) {
      const bool dense = primitive.part >= 0 && size_of(primitive) <= dense_;
      // The inside of a sphere and the outside may be all there is.
      const bool has_two_sides = primitive.wall.origin.w == WALL_SPHERE && primitive.lit_side == 0;
      cells_.visit(
          primitive, reach_, [](std::size_t) { return true; },
          [&](std::size_t index) {
            Cell& cell = near_[index];
            if (cell.count == 0) cell.part = primitive.part;
            cell.count += has_two_sides ? 2 : 1;
            cell.is_dense_part = cell.is_dense_part && dense && primitive.part == cell.part;
          });
      if (primitive.receives)
        cells_.visit(
            primitive, 0, [&](std::size_t index) { return !near_[index].receives; },
            [&](std::size_t index) { near_[index].receives = true; });
    }
  }

  /// The box about what photons may be gathered from, from a visible point in the box.
  WallBox within_reach(WallBox box) const {
    box.half = box.half + Vec3{1, 1, 1} * reach_;
    return box;
  }

  void list_if_parting(std::uint32_t i) {
    const bool small = parting_.is_small(i);
    cells_.visit(
        primitives_[i], reach_, [&](std::size_t index) { return near_[index].may_have_walls(); },
        [&](std::size_t index) {
          CellWalls& list = lists_[index + 1];
          if (!small)
            list.large.push_back(i);
          else if (parting_.parts(i))
            list.parting.push_back(i);
        });
    // Beyond the grid there is nothing else.
    if (primitives_[i].wall.origin.w == WALL_PLANE) lists_[0].large.push_back(i);
  }

  void try_large(std::size_t index) {
    CellWalls& list = lists_[index];
    if (list.large.empty()) return;
    const WallBox everywhere{{0, 0, 0}, {INFINITY, INFINITY, INFINITY}};
    const WallBox box = index > 0 ? within_reach(cells_.box_of(index - 1)) : everywhere;
    const auto others = index > 0 ? parting_.others_in(box) : pointers(list.large);
    for (const std::uint32_t i : list.large)
      if (parting_.parts(i, others, box)) list.parting.push_back(i);
    std::sort(list.parting.begin(), list.parting.end());
  }

  /// A path over one wall may be barred by another that parts nothing by itself, as a low ceiling.
  void list_beside_parting(std::uint32_t i) {
    const auto is_wanted = [&](std::size_t index) {
      const CellWalls& list = lists_[index];
      return !list.parting.empty() && !std::binary_search(list.parting.begin(), list.parting.end(), i);
    };
    cells_.visit(
        primitives_[i], reach_, [&](std::size_t index) { return is_wanted(index + 1); },
        [&](std::size_t index) { lists_[index + 1].others.push_back(i); });
    if (primitives_[i].wall.origin.w == WALL_PLANE && is_wanted(0)) lists_[0].others.push_back(i);
  }

  std::vector<const WallPrimitive*> pointers(const std::vector<std::uint32_t>& numbers) const {
    std::vector<const WallPrimitive*> result;
    result.reserve(numbers.size());
    for (const std::uint32_t i : numbers) result.push_back(&primitives_[i]);
    return result;
  }

  std::vector<std::byte> packed() {
    std::vector<std::uint32_t> words, entries, number(primitives_.size(), ~0u);
    std::vector<Wall> walls;
    std::vector<float4> boxes;
    std::vector<std::size_t> boxed;  // the entries that say where boxes are
    for (CellWalls& list : lists_) {
      words.push_back(static_cast<std::uint32_t>(entries.size()));
      if (list.parting.empty()) continue;
      entries.push_back(static_cast<std::uint32_t>(list.parting.size()));
      entries.push_back(static_cast<std::uint32_t>(boxes.size()));
      if (list.parting.size() > most_ungrouped) {
        boxed.push_back(entries.size() - 1);
        add_boxes(list.parting, boxes);
      } else {
        entries.back() = 0;
      }
      for (const auto* part : {&list.parting, &list.others})
        for (const std::uint32_t i : *part) {
          if (number[i] == ~0u) {
            number[i] = static_cast<std::uint32_t>(walls.size());
            walls.push_back(primitives_[i].wall);
          }
          entries.push_back(number[i]);
        }
    }
    if (walls.empty()) return no_walls();
    words.push_back(static_cast<std::uint32_t>(entries.size()));
    const std::size_t header = (sizeof(WallGrid) + 4 * (words.size() + entries.size()) + 15) / 16;
    for (const std::size_t i : boxed) entries[i] += static_cast<std::uint32_t>(header + 5 * walls.size());
    words.insert(words.end(), entries.begin(), entries.end());
    words.resize(4 * header - sizeof(WallGrid) / 4);
    const WallGrid grid = header_of(static_cast<uint>(header));
    std::vector<std::byte> bytes(16 * header + sizeof(Wall) * walls.size() + sizeof(float4) * boxes.size());
    std::memcpy(bytes.data(), &grid, sizeof grid);
    std::memcpy(bytes.data() + sizeof grid, words.data(), 4 * words.size());
    std::memcpy(bytes.data() + 16 * header, walls.data(), sizeof(Wall) * walls.size());
    if (!boxes.empty())
      std::memcpy(bytes.data() + 16 * header + sizeof(Wall) * walls.size(), boxes.data(),
                  sizeof(float4) * boxes.size());
    return bytes;
  }

  WallGrid header_of(uint first_wall) const {
    WallGrid grid{};
    const Vec3 low = cells_.low();
    grid.origin = {static_cast<float>(low.x), static_cast<float>(low.y), static_cast<float>(low.z),
                   static_cast<float>(1 / cells_.edge())};
    grid.nx = static_cast<uint>(cells_.along()[0]);
    grid.ny = static_cast<uint>(cells_.along()[1]);
    grid.nz = static_cast<uint>(cells_.along()[2]);
    grid.first_wall = first_wall;
    return grid;
  }

  /// Sorts the primitives so that near ones follow each other, and appends the boxes around their groups.
  void add_boxes(std::vector<std::uint32_t>& numbers, std::vector<float4>& boxes) const {
    const auto key = [&](std::uint32_t i) {
      const Vec3 place = (primitives_[i].low - cells_.low()) / (0.25 * cells_.edge());
      std::uint64_t code = 0;  // Morton's: bits of the three coordinates by turns
      for (int bit = 20; bit >= 0; --bit)
        for (int axis = 0; axis < 3; ++axis)
          code = code << 1 | (static_cast<std::uint64_t>(std::clamp(place[axis], 0.0, 2e6)) >> bit & 1);
      return code;
    };
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (const std::uint32_t i : numbers) order.emplace_back(key(i), i);
    std::sort(order.begin(), order.end());
    for (std::size_t begin = 0; begin < order.size(); begin += WALL_GROUP) {
      Vec3 low{INFINITY, INFINITY, INFINITY}, high = -low;
      for (std::size_t i = begin; i < std::min(begin + WALL_GROUP, order.size()); ++i) {
        numbers[i] = order[i].second;
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], primitives_[numbers[i]].low[axis]);
          high[axis] = std::max(high[axis], primitives_[numbers[i]].high[axis]);
        }
      }
      for (const Vec3 corner : {low, high})
        boxes.push_back(
            {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(corner.z), 0});
    }
  }
};

}  // namespace

std::vector<std::byte> no_walls() { return std::vector<std::byte>(sizeof(WallGrid)); }

std::vector<std::byte> wall_grid(const Scene& scene, const FlatScene& world, const LitSides& sides,
                                 double time, double radius) {
  return WallGridBuilder(wall_primitives(scene, world, sides, time), radius).build();
}

}  // namespace causticl
