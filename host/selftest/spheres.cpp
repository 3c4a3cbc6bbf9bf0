// Hard cases 1 and 2: spheres far away or small, and rays that start in, on or tangent to one.
#include <atomic>

#include "selftest/random_check.hpp"
#include "selftest/spawned_ray.hpp"
#include "selftest/sphere_oracle.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
typedef struct {
  float centre[3], radius, origin[3], direction[3], way[3], sine;
} SphereRay;

INLINE Ray load_sphere(global const SphereRay *in, global Shape *shape) {
  shape->sphere = (float4)(in->centre[0], in->centre[1], in->centre[2], in->radius);
  shape->to_local[0] = (float4)(1, 0, 0, 0);
  shape->to_local[1] = (float4)(0, 1, 0, 0);
  shape->to_local[2] = (float4)(0, 0, 1, 0);
  shape->type = SHAPE_SPHERE;
  shape->material = 0;
  Ray ray = {load3(in->origin), load3(in->direction)};
  return ray;
}
kernel void sphere_hit(global const SphereRay *in, global float4 *out, uint count, global Shape *shapes) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Ray ray = load_sphere(in + i, shapes + i);
  Hit hit = {INFINITY, HIT_NONE, 0, 0, 0};
  out[i] = (float4)(0, 0, 0, INFINITY);
  if (!shape_closest(shapes + i, 0, 0, ray, &hit)) return;
  Surface surface;
  shape_surface(shapes + i, 0, ray, hit, &surface);
  out[i] = (float4)(surface.position.x, surface.position.y, surface.position.z, hit.t);
}
kernel void sphere_spawn(global const SphereRay *in, global SpawnedRay *out, uint count, global Shape *shapes) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Ray ray = load_sphere(in + i, shapes + i);
  out[i] = spawn_from_shape(shapes + i, 0, ray, load3(in[i].way), in[i].sine);
}
)";

struct SphereRay {
  float centre[3], radius, origin[3], direction[3];
  float way[3], sine;  // of the spawned ray: see spawned_ray.hpp
};

Vec3 load(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
void store(float (&out)[3], Vec3 v) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}
SphereRoots exact_roots(const SphereRay& in) {
  return sphere_roots(load(in.centre), in.radius, load(in.origin), load(in.direction));
}

/// A direction, every fourth along an axis.
Vec3 any_direction(InputRandom& random) {
  if (random.below(4)) return random.direction();
  Vec3 axis;
  axis[static_cast<int>(random.below(3))] = random.below(2) ? 1 : -1;
  return axis;
}
Vec3 perpendicular(InputRandom& random, Vec3 v) { return normalize(cross(v, random.direction())); }

cl::Program sphere_program(const CheckContext& context) {
  return context.program(std::string(spawned_ray_source) + source, EFFECT_SPHERES);
}
cl::Buffer scratch_shapes(const CheckContext& context) {
  return context.device.buffer(check_batch * sizeof(Shape), "shapes of a check");
}

/// A sphere 10 to 10^6 radii away, and a ray that passes its centre at up to 1.3 radii; powers of ten, rays
/// along an axis, through the centre and at 0.95 radii among them. Centre, origin or neither is at (0, 0, 0).
SphereRay far_sphere(InputRandom& random, std::uint64_t index) {
  SphereRay in{};
  const double ratio = index % 8 ? random.scale(1, 6) : std::pow(10.0, 1 + random.below(6));
  in.radius = static_cast<float>(random.scale(-8, 8));
  const Vec3 away = any_direction(random) * (in.radius * ratio);
  store(in.centre, index % 3 == 0   ? Vec3{}
                   : index % 3 == 1 ? -away
                                    : random.direction() * (length(away) * random.uniform()));
  store(in.origin, index % 3 == 1 ? Vec3{} : load(in.centre) + away);
  const std::uint32_t corner = random.below(16);
  const double aside = corner == 0 ? 0 : corner == 1 ? 0.95 : random.uniform(0, 1.3);
  const Vec3 target = load(in.centre) + perpendicular(random, away) * (aside * in.radius);
  store(in.direction, normalize(target - load(in.origin)));
  return in;
}

/// No ray that passes within 0.95 radii misses, to 10^5 radii away, none beyond 1.05 radii hits, and hits are
/// where they should be. Rounding of the ray's way to the sphere alone is half an ulp of its distance in each
/// coordinate; a closest approach of 0.95 radii magnifies it threefold along the ray.
CheckResult far_or_small(CheckContext& context) {
  CheckKernel kernel(context, sphere_program(context), "sphere_hit");
  const cl::Buffer shapes = scratch_shapes(context);
  kernel.with(shapes);
  std::atomic<std::uint64_t> beyond = 0, missed = 0;
  CheckResult result = run_random_check(
      context, 4, "ulp of the distance", far_sphere,
      [&](const auto& inputs) { return kernel.run<float4>(inputs); },
      [&](const SphereRay& in, float4 out) -> double {
        const SphereRoots roots = exact_roots(in);
        const long double ratio = roots.distance / in.radius, aside = roots.approach / in.radius;
        const bool hit = std::isfinite(out.w), too_far = ratio > 1.000001e5;
        if (aside > 0.95L) return hit && aside >= 1.05L && !too_far ? INFINITY : 0;
        if (too_far) {
          ++beyond;
          missed += !hit;
        }
        if (!hit) return too_far ? 0 : INFINITY;
        const Vec3 direction = load(in.direction);
        const double t = static_cast<double>(roots.near), off_t = std::fabs(out.w - t) * length(direction);
        const double off = length(to_vec3(out) - (load(in.origin) + direction * t));
        const double ulp = std::ldexp(1.0, std::ilogb(static_cast<double>(roots.distance)) - 23);
        return std::fmax(off, off_t) / ulp;
      });
  result.note = "beyond 1e5 radii " + std::to_string(missed) + " of " + std::to_string(beyond) + " missed";
  return result;
}

/// A ray that starts inside, on the surface, next to it, at the centre, outside or behind, or that is tangent
/// to the sphere, at its origin or farther on; and a spawned ray, half of them grazing.
SphereRay close_ray(InputRandom& random, std::uint64_t index) {
  SphereRay in{};
  in.radius = static_cast<float>(random.scale(-8, 8));
  const double r = in.radius;
  if (random.below(3)) store(in.centre, random.direction() * (r * random.scale(-2, 3)));
  const Vec3 centre = load(in.centre), u = any_direction(random), tangent = perpendicular(random, u);
  const double tiny = std::copysign(random.scale(-9, -1), random.uniform(-1, 1));
  Vec3 origin = centre + u * r, direction = any_direction(random);
  switch (index % 8) {
    case 0:
      origin = centre + u * (r * random.uniform());
      break;
    case 1:  // on the surface, as near as the numbers allow
      break;
    case 2:
      origin = centre + u * (r * (1 + tiny));
      break;
    case 3:  // tangent farther on
      origin = centre + u * (r * (1 + tiny)) - tangent * (r * random.scale(-2, 2));
      direction = tangent;
      break;
    case 4:  // tangent at its origin
      direction = normalize(tangent + u * (random.below(2) ? tiny : 0));
      break;
    case 5:
      origin = centre;
      break;
    case 6:
      origin = centre + u * (r * random.scale(0, 2));
      break;
    case 7: {  // exactly tangent, or from the pole, along an axis
      const int axis = static_cast<int>(random.below(3));
      in.radius = std::exp2(static_cast<float>(random.below(40)) - 20);
      store(in.centre, {});
      origin = direction = {};
      direction[axis] = random.below(2) ? 1 : -1;
      origin[random.below(2) ? axis : (axis + 1) % 3] = random.below(2) ? in.radius : -in.radius;
    }
  }
  store(in.origin, origin);
  store(in.direction, direction);
  store(in.way, any_direction(random));
  if (random.below(2)) in.sine = static_cast<float>(tiny);
  return in;
}

/// A hit must lie on the sphere, in front, and be the first; a miss must be one but for what rounding hides.
/// The error is how far the sphere or the ray would have to be moved to make the answer exact, in roundings
/// of the distances that enter: those of the origin from the centre, of the closest approach (twice: b and
/// fma), of its square and of the radius', the root, the sum, and again of the hit point that the oracle
/// computes exactly.
CheckResult first_root(CheckContext& context) {
  CheckKernel kernel(context, sphere_program(context), "sphere_hit");
  const cl::Buffer shapes = scratch_shapes(context);
  kernel.with(shapes);
  constexpr double tolerance = 8;
  return run_random_check(
      context, tolerance, "roundings", close_ray,
      [&](const auto& inputs) { return kernel.run<float4>(inputs); },
      [](const SphereRay& in, float4 out) -> double {
        const SphereRoots roots = exact_roots(in);
        const double rounding = static_cast<double>(roots.distance + in.radius) * 0x1p-24;
        // How deep below the surface the ray gets in front of its origin.
        const long double least = roots.closest > 0 ? roots.approach : roots.distance;
        const double depth = static_cast<double>(in.radius - least) / rounding;
        if (!std::isfinite(out.w)) return std::fmax(depth, 0);
        if (!(out.w > 0)) return INFINITY;
        const bool outside = roots.distance - in.radius > tolerance * rounding;
        if (outside && depth > tolerance && out.w > roots.closest) return INFINITY;  // the far root
        const Vec3 centre = load(in.centre), origin = load(in.origin), direction = load(in.direction);
        const double reached = length((origin - centre) + direction * static_cast<double>(out.w));
        return std::fabs(reached - in.radius) / rounding;
      });
}

CheckResult no_second_hit(CheckContext& context) {
  CheckKernel kernel(context, sphere_program(context), "sphere_spawn");
  const cl::Buffer shapes = scratch_shapes(context);
  kernel.with(shapes);
  std::atomic<std::uint64_t> spawned = 0;
  CheckResult result = run_random_check(
      context, 0, "", close_ray, [&](const auto& inputs) { return kernel.run<SpawnedRay>(inputs); },
      [&](const SphereRay& in, const SpawnedRay& out) {
        if (!out.spawned()) return 0.0;
        spawned.fetch_add(1, std::memory_order_relaxed);
        return sphere_spawn_error(out, in.radius);
      });
  result.note = std::to_string(spawned) + " rays spawned";
  return result;
}

}  // namespace

std::vector<Check> sphere_checks() {
  return {{1, "far and small spheres: no miss, exact hit point", 1, far_or_small},
          {2, "origin in, on, tangent to a sphere: the first root", 1, first_root},
          {2, "origin in, on, tangent: spawned rays keep their side", 1, no_second_hit}};
}

}  // namespace causticl
