// Hard case 27: what stands between a photon and a visible point.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"
#include "selftest/vectors.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "photons/walls.cl"
typedef struct {
  Wall wall;
  float4 point, point_normal, photon, photon_normal;
  uint4 number;  // of the wall
} Pair;
kernel void parted(global const Pair *in, global uint *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  NearWalls near;
  near.point = convert_real3(in[i].point.xyz);
  near.normal = convert_real3(in[i].point_normal.xyz);
  near.rounding = (real)WALL_ROUNDING * max_component(fabs(near.point));
  near.walls = &in[i].wall;
  near.listed = (global const uint *)&in[i].number;
  near.boxes = 0;
  near.parting = near.listed_count = near.count = 1;
  near.all = true;
  out[i] = walls_between(&near, convert_real3(in[i].photon.xyz), convert_real3(in[i].photon_normal.xyz));
}
)";

struct Pair {
  std::array<float, sizeof(Wall) / sizeof(float)> wall;
  std::array<float, 4> point, point_normal, photon, photon_normal;
  std::array<std::uint32_t, 4> number;
};

Vec3 vec(const float4& v) { return {v.x, v.y, v.z}; }
Vec3 vec(const std::array<float, 4>& v) { return {v[0], v[1], v[2]}; }
std::array<float, 4> words(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
float4 packed(Vec3 v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

/// Whether the way crosses the wall. With `margin` > 0 also where it passes it by, or ends before it, by that
/// much; with `margin` < 0 only where it crosses it by that much. What ends before a flat wall by less than
/// `touch` crosses it in either case.
bool crosses(const Wall& wall, Vec3 a, Vec3 b, double margin, double touch) {
  const Vec3 origin = vec(wall.origin), n = vec(wall.normal);
  if (static_cast<uint>(wall.origin.w) == WALL_SPHERE) {
    const double radius = wall.normal.w, da = length(a - origin) - radius, db = length(b - origin) - radius;
    const Vec3 way = b - a;
    const double nearest =
        std::fmin(std::fmax(dot(origin - a, way) / std::fmax(dot(way, way), 1e-300), 0), 1);
    if (std::fabs(da) < std::fabs(margin)) return margin > 0;  // on the sphere: either side may be meant
    if (da < 0) return db > -margin;
    return db < margin || length(a + nearest * way - origin) < radius + margin;
  }
  double da = dot(n, a - origin), db = dot(n, b - origin);
  if (da < 0) da = -da, db = -db;
  if (!(db < std::fmax(margin, touch))) return false;
  const auto inside = [&](Vec3 p) {
    if (static_cast<uint>(wall.origin.w) == WALL_PLANE) return true;
    if (static_cast<uint>(wall.origin.w) == WALL_DISK) return length(p - origin) < wall.normal.w + margin;
    if (static_cast<uint>(wall.origin.w) == WALL_PARALLELOGRAM)
      return std::all_of(wall.edge, wall.edge + 2, [&](const float4& edge) {
        return std::fabs(dot(vec(edge), p - origin)) < edge.w + margin;
      });
    return std::all_of(std::begin(wall.edge), std::end(wall.edge),
                       [&](const float4& edge) { return dot(vec(edge), p - origin) > edge.w - margin; });
  };
  // Along the wall it is crossed anywhere, if at all.
  if (da < 4 * std::fabs(margin)) return margin > 0 || (inside(a) && inside(b));
  return inside(a + std::fmin(da / (da - db), 1) * (b - a));
}

/// walls_between() by the same two paths, in double.
bool parted(const Pair& in, double margin, double touch) {
  const Vec3 x = vec(in.point), y = vec(in.photon), nx = vec(in.point_normal), ny = vec(in.photon_normal);
  const double distance = length(y - x);
  const double rounding = 1e-6 * max_component({std::fabs(x.x), std::fabs(x.y), std::fabs(x.z)});
  const double low = 0.01 * distance + 4 * rounding, high = 0.35 * distance + low;
  const Wall wall = std::bit_cast<Wall>(in.wall);
  const auto crossed = [&](Vec3 a, Vec3 b) { return crosses(wall, a, b, margin, touch); };
  if (!crossed(x + low * nx, y + low * ny)) return false;
  return crossed(x + high * nx, y + high * ny) || crossed(x + high * nx, x + low * nx) ||
         crossed(y + high * ny, y + low * ny);
}

/// A wall near the origin of a frame that lies anywhere.
Wall any_wall(InputRandom& random, Vec3 place, double size) {
  Wall wall{};
  const Vec3 n = random.direction();
  const auto type = random.below(5);
  wall.origin = packed(place, type);
  wall.normal = packed(n, size * random.uniform(0.5, 2));
  if (type != WALL_TRIANGLE && type != WALL_PARALLELOGRAM) return wall;
  const Vec3 u = normalize(cross(n, random.direction())), v = cross(n, u);
  if (type == WALL_PARALLELOGRAM) {
    wall.edge[0] = packed(u, size * random.uniform(0.5, 2));
    wall.edge[1] = packed(normalize(v + random.uniform(-1, 1) * u), size * random.uniform(0.5, 2));
    return wall;
  }
  const Vec3 corner[3] = {{0, 0, 0}, size * random.uniform(0.5, 2) * u, size * random.uniform(0.5, 2) * v};
  for (int i = 0; i < 3; ++i) {
    const Vec3 inward = normalize(cross(n, corner[(i + 1) % 3] - corner[i]));
    wall.edge[i] = packed(inward, dot(inward, corner[i]));
  }
  return wall;
}

/// Points about the wall: anywhere; on a floor that ends at it, the photon in the wall but for rounding; and
/// both on the outside of a sphere, where nothing is between them.
Pair any_pair(InputRandom& random, std::uint64_t index) {
  const double size = random.scale(-2, 2), far = index % 3 ? size : size * random.scale(0, 3);
  const Vec3 place = far * random.direction();
  const Wall wall = any_wall(random, place, size);
  const Vec3 n = vec(wall.normal), origin = vec(wall.origin);
  const double reach = size * random.scale(-2.5, 0);
  Vec3 x = place + size * random.uniform(0, 1.5) * random.direction(), y = x + reach * random.direction();
  Vec3 nx = random.direction(), ny = normalize(nx + 0.5 * random.direction());
  const bool sphere = static_cast<uint>(wall.origin.w) == WALL_SPHERE;
  if (sphere && index % 2) {
    nx = random.direction();
    ny = normalize(nx + random.uniform(0, 0.8) * random.direction());
    x = origin + wall.normal.w * nx;
    y = origin + wall.normal.w * ny;
  } else if (!sphere && index % 2) {
    nx = ny = normalize(cross(n, random.direction()));
    const Vec3 along = cross(n, nx);
    y = origin + size * random.uniform(-0.2, 1) * along + size * random.uniform(-0.2, 1) * nx;
    x = y + reach * n + reach * random.uniform(-1, 1) * along;
  }
  return {std::bit_cast<std::array<float, sizeof(Wall) / sizeof(float)>>(wall),
          words(x),
          words(nx),
          words(y),
          words(ny),
          {}};
}

/// The verdict of the oracle wherever the wall is crossed or passed by for certain; a photon that landed in
/// the wall, but for the rounding of its place, is always beyond it.
CheckResult against_double(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "parted");
  return run_random_check(
      context, 0, "", any_pair, [&](const auto& inputs) { return kernel.run<cl_uint>(inputs); },
      [](const Pair& in, cl_uint found) {
        const Vec3 x = vec(in.point);
        const double coordinates = max_component({std::fabs(x.x), std::fabs(x.y), std::fabs(x.z)});
        const double slack = 1e-4 * length(vec(in.photon) - x) + 1e-6 * coordinates;
        const bool surely = parted(in, -0.5 * slack, 0.4 * slack), maybe = parted(in, 2 * slack, 0);
        return (surely && !found) || (found && !maybe) ? INFINITY : 0.0;
      });
}

}  // namespace

std::vector<Check> wall_checks() {
  return {{27, "walls between photons and visible points", 1, against_double}};
}

}  // namespace causticl
