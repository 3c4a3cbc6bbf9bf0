// Hard case 8: rays that leave a surface do not meet it again, nor pass through it.
//
// A thousand shapes of each type, the same for every seed, so that an input can be tried again: sizes from
// 1e-8 to 1e8, a quarter of them at the origin, the others up to 10^4 of their sizes away from it.
#include <atomic>

#include "scene/curve.hpp"
#include "selftest/octahedron.hpp"
#include "selftest/random_check.hpp"
#include "selftest/spawned_ray.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "shapes/triangle.cl"
typedef struct {
  uint shape;
  float origin[3], direction[3], way[3], sine;
} OutgoingRay;

OUTLINE void shape_spawn_one(global const OutgoingRay *in, global SpawnedRay *out, global const Shape *shapes,
                             global const float *curves) {
  Ray ray = {load3(in->origin), load3(in->direction)};
  *out = spawn_from_shape(shapes + in->shape, curves, ray, load3(in->way), in->sine);
}
kernel void shape_spawn(global const OutgoingRay *in, global SpawnedRay *out, uint count, global const Shape *shapes,
                        global const float *curves) {
  uint i = get_global_id(0);
  if (i < count) shape_spawn_one(in + i, out + i, shapes, curves);
}
// One block of eight triangles is a closed mesh.
OUTLINE void mesh_spawn_one(global const OutgoingRay *in, global SpawnedRay *out, global const TriangleBlock *blocks,
                            global const TriangleAttributes *attributes) {
  Ray ray = {load3(in->origin), load3(in->direction)};
  SpawnedRay spawned = spawned_none();
  Hit hit = {INFINITY, HIT_NONE, 0, 0, 0}, again = hit;
  if (block_closest(blocks, in->shape, triangle_ray(ray), &hit)) {
    Surface surface;
    triangle_surface(blocks, attributes, hit, &surface);
    Ray next = spawn(surface, hit.t, load3(in->way), in->sine, &spawned);
    if (block_closest(blocks, in->shape, triangle_ray(next), &again)) spawned.again = again.t;
    spawned.same_face = again.primitive == hit.primitive;
  }
  *out = spawned;
}
kernel void mesh_spawn(global const OutgoingRay *in, global SpawnedRay *out, uint count,
                       global const TriangleBlock *blocks, global const TriangleAttributes *attributes) {
  uint i = get_global_id(0);
  if (i < count) mesh_spawn_one(in + i, out + i, blocks, attributes);
}
)";

struct OutgoingRay {
  std::uint32_t shape;
  float origin[3], direction[3];
  float way[3], sine;  // see spawned_ray.hpp
};

constexpr std::uint32_t shape_count = 1000;

/// Where a shape is, and how large.
struct Placement {
  Transform to_world;
  double size;
};

/// `uniform`: scaled alike along all axes. Others are stretched up to tenfold, and turned.
Placement placement(std::uint32_t index, bool uniform, double farthest) {
  InputRandom random(8, index);
  const double size = random.scale(-8, 8);
  const auto stretch = [&] { return uniform ? size : size * random.uniform(0.3, 3); };
  const Vec3 scale{stretch(), stretch(), stretch()};
  const Vec3 offset = index % 4 ? random.direction() * (size * random.scale(-1, farthest)) : Vec3{};
  return {Transform::scale(scale)
              .followed_by(Transform::rotate(0, random.uniform(0, 6.28)))
              .followed_by(Transform::rotate(2, random.uniform(0, 6.28)))
              .followed_by(Transform::shift(offset)),
          size};
}

std::vector<Placement> placements(bool uniform, double farthest) {
  std::vector<Placement> all;
  for (std::uint32_t i = 0; i < shape_count; ++i) all.push_back(placement(i, uniform, farthest));
  return all;
}

/// A ray towards the local point `target` of a shape, from up to three sizes away, and the way onward: half
/// of all graze the surface at 1e-7 to 0.1, some go along an axis.
OutgoingRay outgoing_ray(InputRandom& random, std::uint32_t shape, const Transform& to_world, Vec3 target) {
  OutgoingRay in{};
  in.shape = shape;
  const Vec3 to = to_world.point(target);
  const Vec3 from = to_world.point(target + random.direction() * (3 * random.uniform()));
  const Vec3 direction = normalize(to - from);
  Vec3 way = random.direction();
  if (random.below(8) == 0) {
    way = {};
    way[static_cast<int>(random.below(3))] = random.below(2) ? 1 : -1;
  }
  for (int i = 0; i < 3; ++i) {
    in.origin[i] = static_cast<float>(from[i]);
    in.direction[i] = static_cast<float>(direction[i]);
    in.way[i] = static_cast<float>(way[i]);
  }
  if (random.below(2))
    in.sine = static_cast<float>(std::copysign(random.scale(-7, -1), random.uniform(-1, 1)));
  return in;
}

cl::Program spawn_program(const CheckContext& context) {
  return context.program(std::string(spawned_ray_source) + source, EFFECT_TRIANGLES | EFFECTS_OF_SHAPES);
}

/// Runs one check over the shapes of `first` and `second` (shapes and curves, or blocks and attributes).
/// `target(random)` is a local point of a shape that a first ray may aim at, `judge(input, output)` is 0
/// where the spawned ray does as it should.
template <typename Target, typename Judge>
CheckResult run_spawn_check(CheckContext& context, const char* kernel_name, const cl::Buffer& first,
                            const cl::Buffer& second, const std::vector<Placement>& places,
                            const Target& target, const Judge& judge) {
  CheckKernel kernel(context, spawn_program(context), kernel_name);
  kernel.with(first, second);
  std::atomic<std::uint64_t> spawned = 0;
  CheckResult result = run_random_check(
      context, 0, "",
      [&](InputRandom& random, std::uint64_t index) {
        const auto shape = static_cast<std::uint32_t>(index % shape_count);
        return outgoing_ray(random, shape, places[shape].to_world, target(random));
      },
      [&](const auto& inputs) { return kernel.run<SpawnedRay>(inputs); },
      [&](const OutgoingRay& in, const SpawnedRay& out) -> double {
        if (out.spawned()) spawned.fetch_add(1, std::memory_order_relaxed);
        return judge(in, out);
      });
  result.note = std::to_string(spawned) + " rays spawned";
  return result;
}

template <typename Target, typename Judge>
CheckResult run_shape_check(CheckContext& context, const std::vector<Shape>& shapes,
                            const std::vector<float>& curves, const std::vector<Placement>& places,
                            const Target& target, const Judge& judge) {
  return run_spawn_check(context, "shape_spawn", context.device.upload(shapes, "shapes"),
                         context.device.upload(curves, "curves"), places, target, judge);
}

/// The largest number that the position of a hit on a shape is made of.
double coordinates(const Placement& place, const SpawnedRay& ray) {
  const Vec3 p = to_vec3(ray.position);
  return std::fmax(length(p), length(place.to_world.translation)) + place.size;
}

CheckResult spheres(CheckContext& context) {
  const auto places = placements(true, 4);
  std::vector<Shape> shapes;
  for (const auto& place : places) shapes.push_back(make_shape(SHAPE_SPHERE, place.to_world));
  return run_shape_check(
      context, shapes, {0}, places,
      [](InputRandom& random) { return random.direction() * random.uniform(0, 0.9); },
      [&](const OutgoingRay& in, const SpawnedRay& out) -> double {
        return out.spawned() ? sphere_spawn_error(out, shapes[in.shape].sphere.w) : 1;
      });
}

/// A flat shape is met once by any ray that starts on it, to whichever side it leaves; and it starts as near
/// as rounding of the rows of to_local (8) and of the position allows.
CheckResult flat_shapes(CheckContext& context, uint type, double reach) {
  const auto places = placements(false, 4);
  std::vector<Shape> shapes;
  for (const auto& place : places) shapes.push_back(make_shape(type, place.to_world));
  return run_shape_check(
      context, shapes, {0}, places,
      [reach](InputRandom& random) {
        const Vec3 p = random.direction() * (reach * random.uniform());
        return Vec3{p.x, p.y, 0};
      },
      [&](const OutgoingRay& in, const SpawnedRay& out) -> double {
        if (!out.spawned()) return 0;
        if (!(out.displacement() <= 5e-6 * coordinates(places[in.shape], out))) return 1;
        return std::fabs(out.side()) < side_error || !std::isfinite(out.again) ? 0 : 1;
      });
}
CheckResult planes(CheckContext& context) { return flat_shapes(context, SHAPE_PLANE, 100); }
CheckResult disks(CheckContext& context) { return flat_shapes(context, SHAPE_DISK, 0.99); }

/// The profile of an egg: convex, closed about the axis and smooth at its poles, so that a ray that leaves it
/// never returns and one that stays meets it again. Its radii of curvature are above a hundredth of its size
/// under every placement, and so is a chord over its cosine.
CheckResult revolved_curves(CheckContext& context) {
  const auto places = placements(false, 4);
  std::vector<Shape> shapes;
  for (const auto& place : places) shapes.push_back(make_shape(SHAPE_BEZIER, place.to_world));
  return run_shape_check(
      context, shapes, curve_data({{0, -1}, {1.4, -1}, {1.4, 1}, {0, 1}}), places,
      [](InputRandom& random) { return random.direction() * random.uniform(0, 0.7); },
      [&](const OutgoingRay& in, const SpawnedRay& out) -> double {
        if (!out.spawned()) return 1;
        // BEZIER_ERROR in unit space, and the rounding of both maps.
        if (!(out.displacement() <= 5e-5 * coordinates(places[in.shape], out))) return 1;
        const double side = out.side();
        if (std::fabs(side) < side_error) return 0;
        if (side > 0) return std::isfinite(out.again) ? 1 : 0;
        return std::isfinite(out.again) && out.again >= -side * 0.01 * places[in.shape].size ? 0 : 1;
      });
}

/// How far the rim of a unit cylinder's image is from a point on it. Nearer than the point's own error, the
/// point may as well lie on the other face.
double distance_from_rim(const Transform& to_local, Vec3 position) {
  const Vec3 p = to_local.point(position);
  const double rho = std::hypot(p.x, p.z);
  const Vec3 across = (p.x / rho) * to_local.rows[0] + (p.z / rho) * to_local.rows[2];
  return std::fmax(std::fabs(rho - 1) / length(across),
                   std::fabs(std::fabs(p.y) - 1) / length(to_local.rows[1]));
}

CheckResult cylinders(CheckContext& context) {
  const auto places = placements(false, 4);
  std::vector<Shape> shapes;
  for (const auto& place : places) {
    shapes.push_back(make_shape(SHAPE_CYLINDER, place.to_world));
    shapes.back().own[0] = 1;  // capped: convex
  }
  return run_shape_check(
      context, shapes, {0}, places,
      [](InputRandom& random) { return random.direction() * random.uniform(0, 0.7); },
      [&](const OutgoingRay& in, const SpawnedRay& out) -> double {
        if (!out.spawned()) return 1;
        if (!(out.displacement() <= 1e-5 * coordinates(places[in.shape], out))) return 1;
        const double side = out.side();
        if (std::fabs(side) < side_error) return 0;
        if (side > 0) return std::isfinite(out.again) ? 1 : 0;
        if (std::isfinite(out.again)) return 0;
        const Transform to_local = places[in.shape].to_world.inverse();
        return distance_from_rim(to_local, to_vec3(out.position)) < 2 * out.displacement() ? 0 : 1;
      });
}

CheckResult closed_meshes(CheckContext& context) {
  const auto places = placements(false, 4);
  std::vector<TriangleBlock> blocks;
  for (const auto& place : places) blocks.push_back(octahedron(place.to_world));
  const cl::Buffer block_buffer = context.device.upload(blocks, "blocks");
  const cl::Buffer attributes = context.device.upload(std::vector<TriangleAttributes>(8), "attributes");
  return run_spawn_check(
      context, "mesh_spawn", block_buffer, attributes, places,
      [](InputRandom& random) { return random.direction() * random.uniform(0, 0.5); },
      [&](const OutgoingRay& in, const SpawnedRay& out) -> double {
        if (!out.spawned()) return 1;
        if (!(out.displacement() <= 2e-6 * coordinates(places[in.shape], out))) return 1;
        const double side = out.side();
        if (std::fabs(side) < side_error) return 0;
        if (side > 0) return std::isfinite(out.again) ? 1 : 0;
        if (std::isfinite(out.again) && out.same_face == 0) return 0;
        const double unclear = 2 * out.displacement();
        return second_nearest_face(blocks[in.shape], to_vec3(out.position)) < unclear ? 0 : 1;
      });
}

}  // namespace

std::vector<Check> spawned_ray_checks() {
  return {{8, "spawned rays: no re-hit of spheres, no leak", 1, spheres},
          {8, "spawned rays: no re-hit of planes", 1, planes},
          {8, "spawned rays: no re-hit of disks", 1, disks},
          {8, "spawned rays: no re-hit of closed meshes, no leak", 1, closed_meshes},
          {8, "spawned rays: no re-hit of revolved curves, no leak", 4, revolved_curves},
          {8, "spawned rays: no re-hit of cylinders, no leak", 1, cylinders}};
}

}  // namespace causticl
