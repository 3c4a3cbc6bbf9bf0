#include "device_scene/walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "device_scene/wall_primitives.hpp"

namespace causticl {
namespace {

/// Cells along the longest axis at most: smaller ones would take more memory than they spare walls.
constexpr double most_cells = 128;

/// Of the radius: how far from a visible point a path to a photon may run (WALL_OVER_HEIGHT of
/// cl/photons/walls.cl), and some.
constexpr double reach_ratio = 1.4;

/// Cells near more primitives than this are judged by normals: all alike are one surface, else all are walls.
constexpr std::size_t most_pairs = 32;

constexpr double one_surface_cosine = 0.866;  // of 30 degrees from the first normal, 60 between any two

constexpr double kept_apart_cosine = 0.45;  // below GATHER_NORMAL_COSINE, for what packed normals lose

/// What lies near a cell.
struct Cell {
  std::uint32_t count = 0;
  bool receives = false;  // a surface that may hold visible points passes through it
  bool one_surface = true;
  Vec3 normal;  // of the first primitive
};

class WallGridBuilder {
 public:
  WallGridBuilder(std::vector<WallPrimitive> primitives, double radius)
      : primitives_(std::move(primitives)), reach_(reach_ratio * radius) {
    place_grid(radius);
  }

  std::vector<std::byte> build() {
    std::vector<Cell> cells(cell_count());
    for (const auto& primitive : primitives_)
      visit(primitive, [&](std::size_t index, const WallBox& box) { add(primitive, box, cells[index]); });
    std::vector<std::vector<std::uint32_t>> near(cell_count() + 1);
    for (std::uint32_t i = 0; i < primitives_.size(); ++i)
      visit(primitives_[i], [&](std::size_t index, const WallBox&) {
        const Cell& cell = cells[index];
        if (cell.receives && cell.count > 1 && !(cell.count > most_pairs && cell.one_surface))
          near[index + 1].push_back(i);
      });
    for (std::uint32_t i = 0; i < primitives_.size(); ++i)
      if (primitives_[i].wall.origin.w == WALL_PLANE)
        near[0].push_back(i);  // beyond the grid there is nothing else
    for (std::size_t index = 0; index <= cell_count(); ++index)
      if (!near[index].empty()) near[index] = walls_of(near[index], index);
    return packed(near);
  }

 private:
  const std::vector<WallPrimitive> primitives_;
  const double reach_;
  Vec3 low_, high_;
  double cell_ = 1;
  int cells_[3] = {0, 0, 0};
  double tolerance_ = 0;

  std::size_t cell_count() const {
    return static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
           static_cast<std::size_t>(cells_[2]);
  }

  /// Around all that is bounded, so far that what lies beyond is near nothing bounded.
  void place_grid(double radius) {
    low_ = Vec3{INFINITY, INFINITY, INFINITY};
    high_ = -low_;
    for (const auto& primitive : primitives_)
      for (int axis = 0; axis < 3; ++axis)
        if (std::isfinite(primitive.low.x)) {
          low_[axis] = std::min(low_[axis], primitive.low[axis]);
          high_[axis] = std::max(high_[axis], primitive.high[axis]);
        }
    if (!(low_.x <= high_.x)) low_ = high_ = {0, 0, 0};
    const double largest =
        std::max(max_component({std::fabs(low_.x), std::fabs(low_.y), std::fabs(low_.z)}),
                 max_component({std::fabs(high_.x), std::fabs(high_.y), std::fabs(high_.z)}));
    tolerance_ = 1e-3 * reach_ + 4e-6 * largest;
    const Vec3 margin = Vec3{1, 1, 1} * (1.01 * reach_ + 1e-5 * largest);
    low_ = low_ - margin;
    high_ = high_ + margin;
    // As the kernel's floats have it.
    for (int axis = 0; axis < 3; ++axis) low_[axis] = static_cast<float>(low_[axis]);
    cell_ = 1 / static_cast<double>(
                    static_cast<float>(1 / std::max(radius, max_component(high_ - low_) / most_cells)));
    for (int axis = 0; axis < 3; ++axis)
      cells_[axis] = static_cast<int>(std::ceil((high_[axis] - low_[axis]) / cell_)) + 1;
  }

  WallBox box_of(int i, int j, int k) const {
    const Vec3 centre = low_ + cell_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
    return {centre, Vec3{1, 1, 1} * (0.5 * cell_ + tolerance_)};
  }

  /// Calls `found` for each cell that the primitive may be within reach of.
  template <typename Found>
  void visit(const WallPrimitive& primitive, const Found& found) const {
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto cell_at = [&](double x) {
        return static_cast<int>(std::clamp(std::floor((x - low_[axis]) / cell_), 0.0, cells_[axis] - 1.0));
      };
      first[axis] = cell_at(primitive.low[axis] - reach_ - tolerance_);
      last[axis] = cell_at(primitive.high[axis] + reach_ + tolerance_);
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const WallBox box = box_of(i, j, k);
          if (may_reach(primitive, box, reach_))
            found((static_cast<std::size_t>(k) * static_cast<std::size_t>(cells_[1]) +
                   static_cast<std::size_t>(j)) *
                          static_cast<std::size_t>(cells_[0]) +
                      static_cast<std::size_t>(i),
                  box);
        }
  }

  static void add(const WallPrimitive& primitive, const WallBox& box, Cell& cell) {
    const Vec3 n{primitive.wall.normal.x, primitive.wall.normal.y, primitive.wall.normal.z};
    if (cell.count++ == 0) cell.normal = n;
    if (primitive.wall.origin.w == WALL_SPHERE || dot(n, cell.normal) < one_surface_cosine)
      cell.one_surface = false;
    cell.receives = cell.receives || (primitive.receives && may_reach(primitive, box, 0));
  }

  /// Which of the primitives near a cell are walls there. Cell 0 is what lies beyond the grid.
  std::vector<std::uint32_t> walls_of(const std::vector<std::uint32_t>& near, std::size_t index) const {
    std::vector<std::uint32_t> walls;
    WallBox box{{0, 0, 0}, {INFINITY, INFINITY, INFINITY}};
    if (index > 0) {
      const auto at = static_cast<int>(index - 1);
      box = box_of(at % cells_[0], at / cells_[0] % cells_[1], at / cells_[0] / cells_[1]);
      box.half = box.half + Vec3{1, 1, 1} * reach_;
    }
    const auto some_part = [&](std::uint32_t i) {
      return primitives_[i].blocks && parts(primitives_[i], near, box);
    };
    if (near.size() <= most_pairs && std::none_of(near.begin(), near.end(), some_part)) return walls;
    // A path over one wall may be barred by another that parts nothing by itself, as a low ceiling.
    for (const std::uint32_t i : near)
      if (primitives_[i].blocks) walls.push_back(i);
    return walls;
  }

  /// Whether surfaces that may hold photons lie on both sides of the wall, and those of some pair of them may
  /// be found from one another.
  bool parts(const WallPrimitive& wall, const std::vector<std::uint32_t>& near, const WallBox& box) const {
    std::vector<const WallPrimitive*> front, back;
    for (const std::uint32_t i : near) {
      const WallPrimitive& other = primitives_[i];
      if (!other.receives || &other == &wall) continue;
      const WallSides sides = sides_of(wall, other, box, tolerance_);
      if (sides.front) front.push_back(&other);
      if (sides.back) back.push_back(&other);
    }
    for (const auto* a : front)
      for (const auto* b : back)
        if (normals_may_agree(*a, *b)) return true;
    return false;
  }

  static bool normals_may_agree(const WallPrimitive& a, const WallPrimitive& b) {
    if (a.wall.origin.w == WALL_SPHERE || b.wall.origin.w == WALL_SPHERE) return true;
    const float4 m = a.wall.normal, n = b.wall.normal;
    return std::fabs(m.x * n.x + m.y * n.y + m.z * n.z) > kept_apart_cosine;
  }

  std::vector<std::byte> packed(const std::vector<std::vector<std::uint32_t>>& lists) const {
    std::vector<std::uint32_t> words, entries, number(primitives_.size(), ~0u);
    std::vector<Wall> walls;
    for (const auto& list : lists) {
      words.push_back(static_cast<std::uint32_t>(entries.size()));
      for (const std::uint32_t i : list) {
        if (number[i] == ~0u) {
          number[i] = static_cast<std::uint32_t>(walls.size());
          walls.push_back(primitives_[i].wall);
        }
        entries.push_back(number[i]);
      }
    }
    if (walls.empty()) return no_walls();
    words.push_back(static_cast<std::uint32_t>(entries.size()));
    words.insert(words.end(), entries.begin(), entries.end());
    while (words.size() % 4) words.push_back(0);
    WallGrid grid{};
    grid.origin = {static_cast<float>(low_.x), static_cast<float>(low_.y), static_cast<float>(low_.z),
                   static_cast<float>(1 / cell_)};
    grid.nx = static_cast<uint>(cells_[0]);
    grid.ny = static_cast<uint>(cells_[1]);
    grid.nz = static_cast<uint>(cells_[2]);
    grid.first_wall = static_cast<uint>((sizeof grid + 4 * words.size()) / 16);
    std::vector<std::byte> bytes(sizeof grid + 4 * words.size() + sizeof(Wall) * walls.size());
    std::memcpy(bytes.data(), &grid, sizeof grid);
    std::memcpy(bytes.data() + sizeof grid, words.data(), 4 * words.size());
    std::memcpy(bytes.data() + std::size_t{16} * grid.first_wall, walls.data(), sizeof(Wall) * walls.size());
    return bytes;
  }
};

}  // namespace

std::vector<std::byte> no_walls() { return std::vector<std::byte>(sizeof(WallGrid)); }

std::vector<std::byte> wall_grid(const Scene& scene, const FlatScene& world, double time, double radius) {
  return WallGridBuilder(wall_primitives(scene, world, time), radius).build();
}

}  // namespace causticl
