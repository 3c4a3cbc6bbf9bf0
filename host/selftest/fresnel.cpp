// Hard case 12: Fresnel equations at their limits.
#include <cfloat>

#include "selftest/random_check.hpp"
#include "selftest/stability_checks.hpp"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "materials/bsdf.cl"
kernel void fresnel(global const float2 *in, global float2 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  real cosine_t, reflectance = fresnel_dielectric(in[i].x, in[i].y, &cosine_t);
  out[i] = (float2)(reflectance, cosine_t);
}
)";

struct Incidence {
  float cosine, eta;
};
struct Boundary {
  float reflectance, cosine_t;
};

Incidence incidence(InputRandom& random, std::uint64_t index) {
  constexpr float cosines[] = {0.0f,   -0.0f, 1e-7f,          -1e-7f,       1e-20f,
                               2e-38f, 1.0f,  0x1.fffffep-1f, 0x1.000002p0f};
  constexpr float indices[] = {1.0f, 1.0f / 3, 3.0f, 1.5f, 1 / 1.5f, 0x1.fffffep-1f, 0x1.000002p0f, 1.00001f};
  Incidence in{random.uniform24(), static_cast<float>(random.scale(-0.47712, 0.47712))};
  if (index % 8 < 3) in.eta = indices[random.below(8)];
  switch (index % 6) {
    case 0:
      in.cosine = cosines[random.below(9)];
      break;
    case 1:
      in.cosine = static_cast<float>(random.scale(-20, 0));
      break;
    case 2:  // the critical angle and a few ulp about it
      if (in.eta > 1) in.eta = 1 / in.eta;
      in.cosine = next_float(static_cast<float>(std::sqrt(1 - static_cast<double>(in.eta) * in.eta)),
                             static_cast<int>(random.below(9)) - 4);
  }
  if (std::fabs(in.cosine) < FLT_MIN) in.cosine = 0;  // devices may flush denormals
  return in;
}

struct Exact {
  double reflectance, cosine_t;
};

/// The exact equations, for a squared cosine of refraction that is off by `shift` of the size of its terms.
Exact fresnel_exact(const Incidence& in, double shift) {
  const double cosine = std::clamp(static_cast<double>(in.cosine), 0.0, 1.0), eta = in.eta;
  const double difference = (eta - 1) * (eta + 1), size = std::fabs(difference) + cosine * cosine;
  const double square = difference + cosine * cosine + shift * size;
  if (square <= 0) return {eta == 1 ? 0.0 : 1.0, 0};
  const double c = std::sqrt(square) / eta;
  const double parallel = (eta * cosine - c) / (eta * cosine + c);
  const double perpendicular = (cosine - eta * c) / (cosine + eta * c);
  return {0.5 * (parallel * parallel + perpendicular * perpendicular), std::min(c, 1.0)};
}

/// The distance of x from the interval between a and b.
double outside(double x, double a, double b) {
  return std::max({0.0, std::min(a, b) - x, x - std::max(a, b)});
}

/// At the critical angle R has an infinite slope, and four roundings of the squared cosine of refraction move
/// it visibly: R must lie between what the exact equations give for the ends of that interval. What is left
/// are the roundings of the quotients, some eight of 6e-8 each. Outside [0, 1], or other than 1 past the
/// critical angle, it is wrong whatever its distance.
CheckResult exact_reflectance(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "fresnel");
  return run_random_check(
      context, 5e-7, "absolute", incidence, [&](const auto& inputs) { return kernel.run<Boundary>(inputs); },
      [](const Incidence& in, const Boundary& out) {
        constexpr double rounding = 4 * 0x1p-24;
        const Exact exact = fresnel_exact(in, 0), low = fresnel_exact(in, -rounding),
                    high = fresnel_exact(in, rounding);
        if (!(out.reflectance >= 0 && out.reflectance <= 1)) return INFINITY + 0.0;
        if (in.eta < 1 && high.cosine_t == 0 && out.reflectance != 1) return INFINITY + 0.0;
        const double r = std::min(outside(out.reflectance, low.reflectance, exact.reflectance),
                                  outside(out.reflectance, exact.reflectance, high.reflectance));
        return std::max(r, outside(out.cosine_t, low.cosine_t, high.cosine_t));
      });
}

/// Transmittance from the refracted angle that the kernel states, in double: with exact quotients R + T = 1
/// for any angle, so that the roundings of R alone are left.
CheckResult conservation(CheckContext& context) {
  CheckKernel kernel(context, context.program(source, 0), "fresnel");
  return run_random_check(
      context, 1e-6, "absolute", incidence, [&](const auto& inputs) { return kernel.run<Boundary>(inputs); },
      [](const Incidence& in, const Boundary& out) {
        const double cosine = std::clamp(static_cast<double>(in.cosine), 0.0, 1.0), eta = in.eta,
                     c = out.cosine_t;
        // Along a boundary between equal indices nothing is reflected, and no angle says so.
        if (cosine == 0 && eta == 1) return static_cast<double>(out.reflectance);
        const double parallel = eta * cosine + c, perpendicular = cosine + eta * c;
        const double transmittance =
            c == 0 ? 0
                   : 2 * eta * cosine * c * (1 / (parallel * parallel) + 1 / (perpendicular * perpendicular));
        return std::fabs(out.reflectance + transmittance - 1);
      });
}

}  // namespace

std::vector<Check> fresnel_checks() {
  return {{12, "Fresnel reflectance is exact, and 1 past critical", 1, exact_reflectance},
          {12, "reflected and refracted light add up to 1", 1, conservation}};
}

}  // namespace causticl
