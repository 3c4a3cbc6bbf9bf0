// Hard case 10: revolved Bezier curves. No ray may lose its primary hit, whatever it has to do with the
// curve.
#include <atomic>
#include <memory>

#include "selftest/curve_inputs.hpp"
#include "selftest/curve_oracle.hpp"
#include "selftest/random_check.hpp"
#include "selftest/shape_inputs.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "shapes/primitives/bezier.cl"
#include "sampling/rng.cl"
// A ray (number of the curve, origin, direction) and what it meets (t, u, error, position, normal).
OUTLINE void intersect_one(global const float *in, global float *out, global const Shape *shapes, global const float *curves,
                      uint first_curve) {
  global const Shape *shape = shapes + ((uint)in[0] - first_curve);
  Ray ray = {convert_real3(vload3(0, in + 1)), convert_real3(vload3(0, in + 4))};
  real2 parameters;
  real t = bezier_intersect(shape, curves, ray, INFINITY, &parameters);
  out[0] = t;
  if (!(t < INFINITY)) return;
  Hit hit = {t, HIT_SHAPE, parameters.x, parameters.y};
  Surface surface;
  bezier_surface(shape, curves, ray, hit, &surface);
  out[1] = parameters.x;
  out[2] = surface.error;
  vstore3(convert_float3(surface.position), 0, out + 3);
  vstore3(convert_float3(surface.geometric_normal), 0, out + 6);
}
kernel void meet(global const float *rays, global float *results, uint count, global const Shape *shapes,
                 global const float *curves, uint first_curve) {
  uint i = get_global_id(0);
  if (i < count) intersect_one(rays + 7 * i, results + 9 * i, shapes, curves, first_curve);
}
// Follows a photon (index of the shape, seed, path) that bounces inside a closed surface, every fourth time off
// to a grazing direction, and counts how often it meets nothing; then it starts anew.
OUTLINE uint enclosed_one(global const uint *photon, global const Shape *shapes, global const float *curves,
                          global const float4 *starts, uint rays) {
  uint index = photon[0], escaped = 0;
  RandomStream stream = {photon[1], 0, photon[2]};
  global const Shape *shape = shapes + index;
  Surface surface;
  bool bounced = false;
  for (uint k = 0; k < rays; ++k) {
    real4 random = random4(stream, k);
    real z = 2 * random.x - 1, c, s = sincos(2 * PI * random.y, &c), r = sqrt(1 - z * z);
    Ray ray = {convert_real3(starts[index].xyz), (real3)(r * c, r * s, z)};
    if (bounced) {
      real3 inward = -surface.geometric_normal;
      real cosine = dot(ray.direction, inward);
      real wanted = random.z < (real)0.25 ? exp2(-20 * random.w) : fabs(cosine);
      ray.direction = normalize(ray.direction + (wanted - cosine) * inward);
      ray.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, ray.direction);
    }
    real2 parameters;
    real t = bezier_intersect(shape, curves, ray, INFINITY, &parameters);
    bounced = t < INFINITY;
    escaped += bounced ? 0u : 1u;
    Hit hit = {t, HIT_SHAPE, parameters.x, parameters.y};
    if (bounced) bezier_surface(shape, curves, ray, hit, &surface);
  }
  return escaped;
}
kernel void enclosed(global const uint *photons, global uint *escapes, uint count, global const Shape *shapes,
                     global const float *curves, global const float4 *starts, uint rays) {
  uint i = get_global_id(0);
  if (i < count) escapes[i] = enclosed_one(photons + 3 * i, shapes, curves, starts, rays);
}
)";

// Curves [first, first + size) with their oracles; each seed has its own. The special ones come first.
struct CurveSet {
  static constexpr std::uint32_t size = 64;
  std::uint32_t first;
  std::vector<CurvePoints> curves;
  std::vector<std::unique_ptr<CurveOracle>> oracles;
  std::vector<Shape> shapes;
  std::vector<Transform> to_world, to_local;  // as single precision has them
  std::vector<float> data;

  explicit CurveSet(const CheckContext& context) : oracles(size) {
    const auto number = context.replay && !context.replay->empty()
                            ? static_cast<std::uint32_t>(std::bit_cast<float>(context.replay->front()))
                            : context.seed % 1024 * size;
    first = number / size * size;
    for (std::uint32_t i = 0; i < size; ++i) {
      const bool special = i < special_curves.size();
      curves.push_back(special ? special_curves[i] : random_curve(first + i));
      const bool placed = !special && i % 3 == 0;
      shapes.push_back(make_shape(SHAPE_BEZIER, placed ? random_placement(first + i) : Transform{},
                                  static_cast<uint>(data.size())));
      to_world.push_back(rows_transform(shapes[i].to_world));
      to_local.push_back(rows_transform(shapes[i].to_local));
      const auto floats = curve_data(curves[i]);
      data.insert(data.end(), floats.begin(), floats.end());
    }
    parallel_chunks(size, 1, context.threads, [&](std::size_t i, std::size_t) {
      oracles[i] = std::make_unique<CurveOracle>(curves[i]);
    });
  }
};

struct CurveRayInput {
  float curve;  // its number
  float origin[3], direction[3];
};

struct CurveHit {
  float t;  // infinite for none
  float u;  // negative for a hit that stands for unresolved arcs
  float error;
  float position[3], normal[3];
};

Vec3 to_vec3(const float* v) { return {v[0], v[1], v[2]}; }

// A ray as the curve sees it, and how far its rounding may move it.
struct OracleRay {
  const CurveOracle& oracle;
  Vec3 origin, direction;
  double tolerance;

  // In unit space arcs reach 1.9e-6 beyond their ends, the coordinates of profile and path round by 2.4e-7
  // each, and the map to local space by 8e-7: 3.2e-6 in all. The origin counts for a tenth, since the ray is
  // moved up to the curve first. The tip of a cusp reaches up to the overlap of short arcs farther.
  OracleRay(const CurveSet& set, const CurveRayInput& ray)
      : OracleRay(set, static_cast<std::uint32_t>(ray.curve) - set.first, to_vec3(ray.origin),
                  to_vec3(ray.direction)) {}
  OracleRay(const CurveSet& set, std::uint32_t i, Vec3 o, Vec3 d)
      : oracle(*set.oracles[i]),
        origin(set.to_local[i].point(o)),
        direction(set.to_local[i].vector(d)),
        tolerance((i < special_curves.size() ? 8e-6 : 3.2e-6) * (oracle.scale() + 0.1 * length(origin))) {}

  /// Whether a primary hit at t is right for the surface, or the ray, moved by no more than the tolerance.
  bool right_within_rounding(double t) const {
    if (oracle.right_within(origin, direction, t, tolerance)) return true;  // it grazes
    // Where an open surface ends, the ray may pass on either side.
    InputRandom random(0, std::bit_cast<std::uint64_t>(direction.x + origin.y));
    for (int i = 0; i < 32; ++i) {
      const Vec3 o = origin + random.direction() * tolerance;
      const Vec3 d = direction + random.direction() * (2e-7 * length(direction));
      if (oracle.right_within(o, d, t, tolerance)) return true;
    }
    return false;
  }
};

template <typename Judge>
CheckResult run_ray_check(CheckContext& context, std::initializer_list<CurveRay> kinds, double tolerance,
                          const char* unit, const Judge& judge) {
  const CurveSet set(context);
  auto& device = context.device;
  CheckKernel kernel(context, context.program(source, EFFECT_BEZIER), "meet");
  const auto shapes = device.upload(set.shapes, "shapes"), curves = device.upload(set.data, "curves");
  kernel.with(shapes, curves, cl_uint(set.first));
  return run_random_check(
      context, tolerance, unit,
      [&](InputRandom& random, std::uint64_t input) {
        const auto i = static_cast<std::uint32_t>(input % CurveSet::size);
        const CurveRay kind = kinds.begin()[random.below(static_cast<std::uint32_t>(kinds.size()))];
        const auto [local_origin, local_direction] = random_curve_ray(random, set.curves[i], kind);
        const Vec3 o = set.to_world[i].point(local_origin);
        const Vec3 d = normalize(set.to_world[i].vector(local_direction));
        const auto narrow = [](double x) { return static_cast<float>(x); };
        return CurveRayInput{narrow(set.first + i),
                             {narrow(o.x), narrow(o.y), narrow(o.z)},
                             {narrow(d.x), narrow(d.y), narrow(d.z)}};
      },
      [&](const auto& inputs) { return kernel.run<CurveHit>(inputs); },
      [&](const CurveRayInput& in, const CurveHit& out) { return judge(set, in, out); });
}

/// The relative error of t beyond what rounding moves the surface by; 1 for a hit that one of both does not
/// have. Where the ray grazes the surface or meets its edge, the double-precision answer is one of several
/// that are right in single precision: then the device's must be another of them.
CheckResult primary_hits(CheckContext& context, std::initializer_list<CurveRay> kinds) {
  constexpr double tolerance = 1e-4;
  std::atomic<std::uint64_t> unresolved = 0, grazing = 0;
  CheckResult result = run_ray_check(
      context, kinds, tolerance, "relative",
      [&](const CurveSet& set, const CurveRayInput& in, const CurveHit& out) {
        const OracleRay ray(set, in);
        const double t = out.t, expected = ray.oracle.primary_hit(ray.origin, ray.direction);
        unresolved += std::isfinite(t) && out.u < 0;
        if (t == expected) return 0.0;
        const double beyond = std::fabs(t - expected) - ray.tolerance / length(ray.direction);
        const double error = std::isinf(t) || std::isinf(expected) ? 1 : std::max(beyond, 0.0) / expected;
        if (error <= tolerance || std::isnan(error) || !ray.right_within_rounding(t)) return error;
        ++grazing;
        return 0.0;
      });
  result.note = std::to_string(unresolved) + " unresolved, " + std::to_string(grazing) + " up to rounding";
  return result;
}

CheckResult ordinary_rays(CheckContext& context) {
  return primary_hits(context, {CurveRay::outside, CurveRay::aimed, CurveRay::inside});
}

CheckResult tangent_rays(CheckContext& context) {
  return primary_hits(context, {CurveRay::tangent, CurveRay::near_tangent, CurveRay::chord});
}

CheckResult axis_rays(CheckContext& context) {
  return primary_hits(context, {CurveRay::upright, CurveRay::axial, CurveRay::through_axis});
}

CheckResult horizontal_rays(CheckContext& context) {
  return primary_hits(context, {CurveRay::horizontal, CurveRay::near_horizontal});
}

/// The distance of the hit point from the surface, in units of the bound by which spawned rays are moved off
/// it; a bound above 3e-4 of the curve's size fails too, since it would hide what is wrong.
CheckResult error_bounds(CheckContext& context) {
  return run_ray_check(
      context, {CurveRay::aimed, CurveRay::inside, CurveRay::near_tangent, CurveRay::near_horizontal}, 1,
      "of the bound", [&](const CurveSet& set, const CurveRayInput& in, const CurveHit& out) {
        if (!std::isfinite(out.t)) return 0.0;
        const auto i = static_cast<std::uint32_t>(in.curve) - set.first;
        const Transform& map = set.to_local[i];
        const CurveOracle& oracle = *set.oracles[i];
        const double error = out.error * (length(map.rows[0]) + length(map.rows[1]) + length(map.rows[2]));
        if (!(std::fabs(length(to_vec3(out.normal)) - 1) < 1e-6)) return HUGE_VAL;
        return std::max(oracle.distance(map.point(to_vec3(out.position)), 4 * error) / error,
                        error / (3e-4 * oracle.scale()));
      });
}

/// Photons inside closed surfaces never meet nothing. An input is a ray.
CheckResult enclosed_photons(CheckContext& context) {
  struct Photon {
    std::uint32_t shape, seed, path;
  };
  constexpr std::uint32_t rays = 100;
  std::vector<Shape> shapes;
  std::vector<float> data;
  std::vector<float4> starts;
  for (std::size_t i = 0; i < 2 * closed_curves.size(); ++i) {
    const CurvePoints& curve = closed_curves[i / 2];
    const Transform map = i % 2 ? random_placement(i) : Transform{};
    shapes.push_back(make_shape(SHAPE_BEZIER, map, static_cast<uint>(data.size())));
    const auto floats = curve_data(curve);
    data.insert(data.end(), floats.begin(), floats.end());
    starts.push_back(to_float4(map.point({0, (curve.front()[1] + curve.back()[1]) / 2, 0})));
  }
  auto& device = context.device;
  const auto shape_buffer = device.upload(shapes, "shapes"), curve_buffer = device.upload(data, "curves"),
             start_buffer = device.upload(starts, "starts");
  CheckKernel kernel(context, context.program(source, EFFECT_BEZIER), "enclosed");
  kernel.with(shape_buffer, curve_buffer, start_buffer, cl_uint(rays));
  CheckContext photons = context;
  photons.inputs = (context.inputs + rays - 1) / rays;
  CheckResult result = run_random_check(
      photons, 0, "escapes",
      [&](InputRandom&, std::uint64_t input) {
        return Photon{static_cast<std::uint32_t>(input % shapes.size()), context.seed,
                      static_cast<std::uint32_t>(input)};
      },
      [&](const auto& inputs) { return kernel.run<std::uint32_t>(inputs); },
      [](const Photon&, std::uint32_t escapes) { return static_cast<double>(escapes); });
  result.inputs *= rays;
  return result;
}

}  // namespace

std::vector<Check> bezier_checks() {
  return {{10, "Bezier: first hit of ordinary rays", 4, ordinary_rays},
          {10, "Bezier: first hit of tangent rays and short chords", 40, tangent_rays},
          {10, "Bezier: first hit along and through the axis", 10, axis_rays},
          {10, "Bezier: first hit of horizontal rays", 20, horizontal_rays},
          {10, "Bezier: hit points within their error bound", 4, error_bounds},
          {10, "Bezier: no photon leaves a closed surface", 3, enclosed_photons}};
}

}  // namespace causticl
