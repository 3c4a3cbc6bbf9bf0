// Hard cases 11 and 23: the orthonormal basis, and what samplers draw against the density they claim.
#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"
#include "selftest/vectors.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "materials/bsdf.cl"
#include "sampling/rng.cl"
typedef struct {
  float x, y, z;
} Normal;
typedef struct {
  float4 tangent, bitangent;
} Basis;
kernel void basis(global const Normal *in, global Basis *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real3 t, b;
  orthonormal_basis((real3)(in[i].x, in[i].y, in[i].z), &t, &b);
  out[i].tangent = convert_float4((real4)(t, 0));
  out[i].bitangent = convert_float4((real4)(b, 0));
}
#define DISC 0u
#define TRIANGLE 1u
#define SPHERE 2u
#define HEMISPHERE 3u
#define CONE 4u
kernel void warp(global float4 *out, uint count, uint first, uint seed, uint which, float4 axis) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, which, first + i};
  real2 u = random4(stream, DIM_EMISSION).xy;
  real3 n = convert_real3(axis.xyz), v = (real3)(0, 0, 0);
  if (which == DISC) v.xy = disc_uniform(u);
  if (which == TRIANGLE) v.xy = triangle_uniform(u);
  if (which == SPHERE) v = sphere_uniform(u);
  if (which == HEMISPHERE) v = hemisphere_cosine(u, n);
  if (which == CONE) v = cone_uniform(u, n, axis.w);
  out[i] = convert_float4((real4)(v, 0));
}
// Which way light goes on at glass with normal z that it meets under eight angles from both sides: above, or below.
kernel void glass(global float *out, uint count, uint first, uint seed, global const float *cosines, float ior) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, 99u, first + i};
  real cosine = cosines[(first + i) % 16u];
  Bsdf bsdf = {MATERIAL_GLASS, (real3)(1, 1, 1), ior};
  Surface surface = {(real3)(0, 0, 0), (real3)(0, 0, 1), (real3)(0, 0, 1), (real2)(0, 0), 0, 0};
  real3 wi = (real3)(sqrt(1 - cosine * cosine), 0, -cosine);
  BsdfSample next = bsdf_sample(&bsdf, &surface, wi, random4(stream, DIM_BOUNCE_FIRST), true);
  out[i] = next.direction.z;
}
)";

enum Warp : cl_uint { disc, triangle, sphere, hemisphere, cone };
constexpr SquareBins bins{16, 16};

cl::Program program(CheckContext& context) { return context.program(source, EFFECT_GLASS); }

struct Normal {
  float x, y, z;
};
struct Basis {
  float4 tangent, bitangent;
};

/// Unit vectors as floats hold them, a third of them near a pole of the basis and some on the equator, where
/// it changes sign. The error is the largest |dot| of two of the three vectors, or |length - 1|: both sum a
/// few roundings of 6e-8, those of the normal itself among them; or half the distance of t x b from n, which
/// sums twice as many.
CheckResult basis(CheckContext& context) {
  CheckKernel kernel(context, program(context), "basis");
  return run_random_check(
      context, 5e-7, "absolute",
      [](InputRandom& random, std::uint64_t index) {
        Vec3 n = random.direction();
        if (index % 3 == 0) {
          const double tilt = random.scale(-12, 0), angle = random.uniform(0, 2 * std::numbers::pi);
          const double z = std::copysign(std::cos(tilt), index % 6 == 0 ? -1 : 1);
          n = {std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), z};
        }
        if (index % 64 == 1) n = normalize(Vec3{n.x, n.y, 0});
        if (index % 128 == 1) n.z = -0.0;
        if (index % 64 == 2) n = {0, 0, index % 128 == 2 ? -1.0 : 1.0};
        return Normal{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
      },
      [&](const auto& inputs) { return kernel.run<Basis>(inputs); },
      [](const Normal& in, const Basis& out) {
        const Vec3 n{in.x, in.y, in.z}, t = to_vec3(out.tangent), b = to_vec3(out.bitangent);
        double error = 0;
        for (const double e :
             {dot(n, t), dot(n, b), dot(t, b), length(t) - 1, length(b) - 1, length(cross(t, b) - n) / 2})
          error = std::isnan(e) ? NAN : std::max(error, std::fabs(e));
        return error;
      });
}

template <typename Bin>
CheckResult warp_check(CheckContext& context, Warp which, float4 axis, Histogram histogram, const Bin& bin) {
  SampleKernel<float4> draw(context, program(context), "warp", static_cast<cl_uint>(which), axis);
  return run_histogram_check(
      context, {std::move(histogram)}, draw,
      [&](const float4& v, std::uint64_t, std::vector<Histogram>& to) { to[0].add(bin(to_vec3(v))); });
}

CheckResult uniform_disc(CheckContext& context) {
  return warp_check(context, disc, {}, flat_histogram(bins.count()),
                    [](Vec3 v) { return bins.bin(v.x * v.x + v.y * v.y, turn(v.y, v.x)); });
}

/// Squares of the unit square: those under the diagonal are whole, those on it are halved.
CheckResult uniform_triangle(CheckContext& context) {
  Histogram histogram(bins.count());
  for (std::size_t y = 0; y < bins.ny; ++y)
    for (std::size_t x = 0; x + y < bins.nx; ++x)
      histogram.probabilities[y * bins.nx + x] =
          (x + y == bins.nx - 1 ? 1.0 : 2.0) / static_cast<double>(bins.count());
  return warp_check(context, triangle, {}, histogram, [](Vec3 v) {
    // A sum of 1 that rounds up beside a corner of the diagonal belongs to the square on it.
    const std::size_t bin = bins.bin(v.x, v.y), x = bin % bins.nx, y = bin / bins.nx;
    if (x + y == bins.nx && v.x + v.y <= 1 + 2e-7) return x > y ? bin - 1 : bin - bins.nx;
    return v.x + v.y <= 1 + 2e-7 ? bin : bins.count();
  });
}

CheckResult uniform_sphere(CheckContext& context) {
  return warp_check(context, sphere, {}, flat_histogram(bins.count()), [](Vec3 v) {
    return std::fabs(length(v) - 1) <= 5e-7 ? bins.bin((v.z + 1) / 2, turn(v.y, v.x)) : bins.count();
  });
}

/// The density cos / pi makes the squared cosine uniform.
CheckResult cosine_hemisphere(CheckContext& context) {
  const float4 axis = to_float4(normalize({1e-4, -2e-4, -1}));
  const Frame frame(normalize(to_vec3(axis)));
  return warp_check(context, hemisphere, axis, flat_histogram(bins.count()), [&](Vec3 v) {
    const Vec3 local = frame.to_local(v);
    const bool valid = local.z > 0 && std::fabs(length(v) - 1) <= 5e-7;
    return valid ? bins.bin(local.z * local.z, turn(local.y, local.x)) : bins.count();
  });
}

/// 1 - cos is uniform in a cone. Relative to this one's opening of 1.4 degrees the 24 bits of a direction are
/// 5e-6, and as much may lie beyond its edge.
CheckResult uniform_cone(CheckContext& context) {
  const float4 axis = to_float4(normalize({0.3, -0.5, 0.8}), 3e-4);
  const Vec3 exact_axis = normalize(to_vec3(axis));
  const Frame frame(exact_axis);
  return warp_check(context, cone, axis, flat_histogram(bins.count()), [&](Vec3 v) {
    // 1 - cos = |v - axis|^2 / 2 without cancellation.
    const Vec3 chord = normalize(v) - exact_axis, local = frame.to_local(v);
    return bins.bin(dot(chord, chord) / 2 / axis.w, turn(local.y, local.x), 1e-4);
  });
}

/// Each angle's fraction of reflected light is its reflectance, by the exact equations.
CheckResult glass_choice(CheckContext& context) {
  constexpr float ior = 1.5f;
  std::vector<float> cosines;
  std::vector<Histogram> histograms;
  for (int i = 0; i < 16; ++i) {
    // From within, the angles that are not reflected totally: cos^2 > 5/9.
    const double magnitude = i < 8 ? 0.06 + 0.13 * i : 0.75 + 0.03 * (i - 8);
    cosines.push_back(static_cast<float>(i < 8 ? magnitude : -magnitude));
    const double eta = i < 8 ? ior : 1 / static_cast<double>(ior), cosine = std::fabs(cosines.back());
    const double c = std::sqrt(eta * eta - 1 + cosine * cosine) / eta;
    const double parallel = (eta * cosine - c) / (eta * cosine + c),
                 perpendicular = (cosine - eta * c) / (cosine + eta * c);
    const double reflectance = 0.5 * (parallel * parallel + perpendicular * perpendicular);
    histograms.emplace_back(2);
    histograms.back().probabilities = {reflectance, 1 - reflectance};
  }
  const auto buffer = context.device.upload(cosines, "cosines of a check");
  SampleKernel<float> draw(context, program(context), "glass", buffer, ior);
  return run_histogram_check(context, std::move(histograms), draw,
                             [](float z, std::uint64_t number, std::vector<Histogram>& to) {
                               const std::size_t i = number % 16;
                               const bool reflected = i < 8 ? z > 0 : z < 0;
                               to[i].add(std::isnan(z) ? 2 : reflected ? 0 : 1);
                             });
}

}  // namespace

std::vector<Check> sampling_checks() {
  return {{11, "basis is orthonormal and right-handed", 1, basis},
          {23, "points of a disc", 1, uniform_disc},
          {23, "points of a triangle", 1, uniform_triangle},
          {23, "points of a sphere", 1, uniform_sphere},
          {23, "directions of a hemisphere", 1, cosine_hemisphere},
          {23, "directions of a cone", 1, uniform_cone},
          {23, "reflection or refraction at glass", 1, glass_choice}};
}

}  // namespace causticl
