// Hard case 19: the photon grid against brute force.
#include "selftest/photon_grid.hpp"

#include <optional>

#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

/// A visible point, and the photon map that it is tried on: of one of the layouts, from a seed of its own.
struct Trial {
  std::uint32_t layout, seed;
  GatherPoint point;
};

/// Where photons lie, and how the grid cuts that space.
struct Layout {
  double radius, cell;
  uint nx, ny, nz;
  Vec3 grid_origin, center;
  double extent;
  std::size_t photons = 768;
};

/// The corners of the case: tables of 1 to 64 buckets along an axis, unlike ones too; windows as wide as the
/// table and wider; cubes that are all negative, past any integer, or one for the world; radii down to the
/// extent / 10^9; all photons in one cube; none at all.
const std::vector<Layout>& layouts() {
  static const std::vector<Layout> all{
      {0.2, 0.4, 1, 1, 1, {}, {}, 1},
      {0.2, 0.4, 8, 8, 8, {}, {}, 1},
      {0.2, 0.4, 8, 1, 1, {}, {}, 1},
      {0.2, 0.1, 16, 16, 16, {}, {}, 1},
      {0.2, 0.4, 32, 32, 32, {}, {}, 1},
      {0.2, 0.4, 2, 64, 4, {0.1, -7, 100}, {}, 1},
      {0.4, 0.06, 4, 4, 2, {}, {}, 1},
      {5, 0.1, 16, 16, 16, {}, {}, 1},
      {0.2, 0.02, 64, 64, 64, {-50, 20, 0.5}, {}, 1},
      {1e-9, 2e-9, 64, 64, 64, {}, {}, 1},
      {1e-9, 1e-15, 16, 16, 16, {}, {}, 1},
      {0.1, 1e30, 8, 8, 8, {}, {}, 1},
      {1.5, 1.1, 16, 16, 16, {}, {-40, -70, -90}, 9},
      {20, 40, 32, 32, 32, {1e6, -3e5, 2e6}, {1e6, -3e5, 2e6}, 100},
      {0.01, 1, 16, 16, 16, {}, {0.5, 0.5, 0.5}, 0.02},
      {0.2, 0.4, 8, 8, 8, {}, {}, 1, 0},
  };
  return all;
}

struct Map {
  Layout layout;
  std::vector<Photon> photons;
  Grid grid;
  float radius2;
};

Vec3 position(InputRandom& random, const Layout& layout) {
  const auto reach = [&] { return random.uniform(-layout.extent, layout.extent); };
  const double x = reach(), y = reach(), z = reach();
  return layout.center + Vec3{x, y, z};
}

uint random_normal(InputRandom& random) {
  if (random.below(2)) return pack_normal(random.direction());
  Vec3 n;
  n[static_cast<int>(random.below(3))] = random.below(2) ? -1 : 1;
  return pack_normal(n);
}

Map make_map(std::uint32_t number, std::uint32_t seed) {
  Map map{layouts()[number % layouts().size()], {}, {}, 0};
  const Layout& layout = map.layout;
  InputRandom random(seed, number);
  for (std::size_t i = 0; i < layout.photons; ++i) {
    Vec3 p = position(random, layout);
    uint normal = random_normal(random);
    if (i % 4 == 3) {
      // Beside another photon: on a face of a cube, or a radius away, where rounding decides.
      const Photon& other = map.photons[random.below(static_cast<std::uint32_t>(i))];
      p = {other.position[0], other.position[1], other.position[2]};
      const int axis = static_cast<int>(random.below(3));
      if (i % 8 == 3)
        p[axis] = std::round((p[axis] - layout.grid_origin[axis]) / layout.cell) * layout.cell +
                  layout.grid_origin[axis];
      else
        p[axis] += random.below(2) ? layout.radius : -layout.radius;
      normal = other.normal;
    }
    map.photons.push_back({{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)},
                           normal,
                           static_cast<uint>(random.bits()),
                           static_cast<uint>(random.bits()) & 0xffffu});
  }
  map.grid = make_grid(layout.grid_origin, layout.cell, layout.nx, layout.ny, layout.nz);
  map.radius2 = static_cast<float>(layout.radius * layout.radius);
  return map;
}

/// The map of a trial. Trials that follow each other share one.
const Map& map_of(std::uint32_t layout, std::uint32_t seed) {
  thread_local std::optional<Map> last;
  thread_local std::uint64_t key = 0;
  const std::uint64_t wanted = static_cast<std::uint64_t>(layout) << 32 | seed;
  if (!last || key != wanted) last = make_map(layout, seed);
  key = wanted;
  return *last;
}

constexpr std::uint64_t trials_a_map = 1024;

Trial make_trial(InputRandom& random, std::uint64_t index, std::uint32_t seed) {
  const std::uint64_t number = index / trials_a_map;
  Trial trial{static_cast<std::uint32_t>(number % layouts().size()),
              static_cast<std::uint32_t>(InputRandom(seed, ~number).bits()),
              {}};
  const Map& map = map_of(trial.layout, trial.seed);
  Vec3 p = position(random, map.layout);
  uint normal = random_normal(random);
  // Most near photons, so that the smallest radii find some too.
  if (index % 4 && !map.photons.empty()) {
    const Photon& photon = map.photons[random.below(static_cast<std::uint32_t>(map.photons.size()))];
    p = {photon.position[0], photon.position[1], photon.position[2]};
    if (index % 4 > 1) p = p + random.direction() * (map.layout.radius * random.uniform());
    normal = photon.normal;
  }
  trial.point = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), normal};
  return trial;
}

/// Sums and counts are integers, so that they must be the same to the bit.
CheckResult brute_force(CheckContext& context) {
  const auto program = context.program(gather_source, 0);
  const auto evaluate = [&](const std::vector<Trial>& trials) {
    std::vector<GatherSums> sums;
    std::vector<GatherPoint> points;
    for (std::size_t first = 0; first < trials.size(); first += points.size()) {
      const auto [layout, seed, point] = trials[first];
      points.clear();
      while (first + points.size() < trials.size() && trials[first + points.size()].layout == layout &&
             trials[first + points.size()].seed == seed)
        points.push_back(trials[first + points.size()].point);
      const Map& map = map_of(layout, seed);
      const auto part = gather_photons(context.device, program, points, map.photons, map.grid, map.radius2);
      sums.insert(sums.end(), part.begin(), part.end());
    }
    return sums;
  };
  return run_random_check(
      context, 0, "",
      [&](InputRandom& random, std::uint64_t index) { return make_trial(random, index, context.seed); },
      evaluate,
      [](const Trial& trial, const GatherSums& sums) {
        const Map& map = map_of(trial.layout, trial.seed);
        return sums == gather_brute_force(trial.point, map.photons, map.radius2) ? 0.0 : 1.0;
      });
}

}  // namespace

std::vector<Check> photon_grid_checks() {
  return {{19, "gathered photons equal those of brute force", 4, brute_force}};
}

}  // namespace causticl
