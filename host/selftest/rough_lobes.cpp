// Hard case 13: rough lobes as their width goes to zero.
#include <array>

#include "selftest/random_check.hpp"
#include "selftest/rough_lobe_oracle.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "materials/bsdf.cl"
typedef struct {
  float wi[3], wo[3], random[3];
  float alpha, ior;
  uint kind;
} Input;
typedef struct {
  float direction[3], weight, pdf;
  float again_weight, again_pdf;  // what evaluation says of the sampled direction
  float value, value_pdf;         // and of `wo`
  float alpha;                    // what the lobe is treated as
} Output;
kernel void lobe(global const Input *in, global Output *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Material material = {(float4)(1, 1, 1, in[i].ior), (float4)(0, 0, 0, 0), (float4)(0.2f, 1, 1, 0),
                       (float4)(3.9f, 2, 2, 0), (float4)(0, 0, 0, 0), in[i].kind, 0, 0, in[i].alpha};
  Bsdf bsdf = {material.kind, (real3)(1, 1, 1), in[i].ior, 0, convert_real3(material.eta.xyz),
               convert_real3(material.k.xyz), 0, false};
  bsdf.alpha = lobe_alpha(material.alpha, bsdf.kind == MATERIAL_GLASS ? bsdf.ior : 0);
  real3 n = (real3)(0, 0, 1), wi = convert_real3(vload3(0, in[i].wi));
  Surface surface = {(real3)(0, 0, 0), n, n, (real2)(0, 0), 0, 0};
  real4 random = (real4)(convert_real3(vload3(0, in[i].random)), 0);
  BsdfSample next = bsdf_sample(&bsdf, &surface, wi, random, true);
  vstore3(convert_float3(next.direction), 0, out[i].direction);
  out[i].weight = next.weight.x;
  out[i].pdf = next.pdf;
  out[i].alpha = bsdf.alpha;
  n = facing_normal(&surface, wi);
  BsdfSample again = rough_evaluate(&bsdf, &surface, wi, n, next.direction);
  BsdfSample other = rough_evaluate(&bsdf, &surface, wi, n, convert_real3(vload3(0, in[i].wo)));
  out[i].again_weight = again.weight.x;
  out[i].again_pdf = again.pdf;
  out[i].value = other.weight.x * other.pdf;
  out[i].value_pdf = other.pdf;
}
)";

struct Input {
  float wi[3], wo[3], random[3];
  float alpha, ior;
  std::uint32_t kind;
};
struct Output {
  float direction[3], weight, pdf;
  float again_weight, again_pdf;
  float value, value_pdf;
  float alpha;
};

constexpr double unit = 0x1p-24;
/// How much a lobe may differ from its oracle, in units of its condition: each of some twenty operations
/// rounds by one unit at most, and the distribution is a square of squares.
constexpr double operations = 32;

constexpr double grazing_cosine = 1e-6;  // to which the kernels lift wi

Vec3 to_vec(const float* v) { return {v[0], v[1], v[2]}; }
void store(Vec3 v, float* out) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(v[axis]);
}

/// The oracle of an input's lobe, and the direction it came from in the facing frame; sides are turned so
/// that z > 0 is where it came from.
struct Lobe {
  RoughLobeOracle oracle;
  Vec3 v;
  double side;

  Lobe(const Input& in, double alpha) {
    side = in.wi[2] < 0 ? 1 : -1;
    v = {-in.wi[0], -in.wi[1], std::max(std::fabs(double(in.wi[2])), grazing_cosine)};
    oracle.alpha = alpha;
    oracle.transmits = in.kind == MATERIAL_GLASS;
    oracle.eta = oracle.transmits ? std::complex<double>(side > 0 ? in.ior : 1 / double(in.ior))
                                  : std::complex<double>(double(0.2f), double(3.9f));
  }
  Vec3 local(const float* direction) const { return {direction[0], direction[1], side * direction[2]}; }

  /// How far rounding of the directions and of the index by one unit may change the relative value at
  /// `wo`: the half vector turns by unit / |v + eta wo|, the lobe's width is alpha, cosines count
  /// relative to themselves, and so does eta - 1. Next to total reflection the cosine of refraction is the
  /// root of a difference.
  double condition(const RoughLobeOracle::Value& exact, Vec3 wo) const {
    double turned = 1 / oracle.alpha + 1 / std::fabs(exact.cosine) + 1 / exact.h.z,
           fixed = 1 / std::fabs(wo.z);
    if (oracle.transmits) {
      const double eta = oracle.eta.real(), square = (eta - 1) * (eta + 1) + exact.cosine * exact.cosine;
      turned += 1 / std::fabs(square);
      fixed += 1 / std::fabs(eta - 1);
    }
    return unit * (1 + turned / exact.length + fixed);
  }
  /// Whether rounding may decide if there is anything at all.
  bool on_verge(const RoughLobeOracle::Value& exact, Vec3 wo) const {
    return !(operations * condition(exact, wo) < 1);
  }
};

/// The angle over which a lobe spreads; refraction turns by |eta - 1| of a microfacet's tilt.
double lobe_width(const Input& in) {
  const double ior = in.ior;
  return in.alpha * (in.kind == MATERIAL_GLASS ? std::fabs(ior - 1) / std::max(ior, 1.0) : 1);
}

/// No wider lobe may be made a perfectly specular one: a tenth of what a pixel sees.
constexpr double widest_specular = 1.001e-4;

float corner_alpha(InputRandom& random) {
  constexpr std::array<float, 12> corners{0,     1e-30f, 1e-15f, 1e-8f, 1e-6f, 1e-5f,
                                          1e-4f, 1e-3f,  1e-2f,  0.1f,  0.5f,  1};
  const float corner = corners[random.below(corners.size())];
  return random.below(8) == 0 ? next_float(corner, static_cast<int>(random.below(3)) - 1) : corner;
}

Input make_input(InputRandom& random, std::uint64_t index) {
  Input in{};
  in.alpha =
      std::clamp(index % 2 ? corner_alpha(random) : static_cast<float>(random.scale(-5, 0)), 0.0f, 1.0f);
  in.kind = random.below(3) ? MATERIAL_GLASS : MATERIAL_CONDUCTOR;
  constexpr std::array<float, 8> indices{1, 1.0001f, 1.001f, 0.999f, 1.33f, 1.5f, 2.4f, 0.4f};
  in.ior = index % 3 ? indices[random.below(indices.size())] : static_cast<float>(random.uniform(0.34, 3));

  // Arriving at any angle, or grazing, or straight down, from either side.
  constexpr std::array<double, 6> cosines{1, 1e-2, 1e-4, 1e-6, 1e-8, 0};
  const double cosine = index % 5 ? random.uniform() : cosines[random.below(cosines.size())];
  const double angle = random.uniform(0, 2 * std::numbers::pi), sine = std::sqrt(1 - cosine * cosine);
  const double side = random.below(2) ? 1 : -1;
  store({sine * std::cos(angle), sine * std::sin(angle), -side * cosine}, in.wi);

  for (float& u : in.random) u = random.uniform24();
  if (index % 7 == 0)
    for (float& u : in.random)
      if (random.below(2)) u = random.below(2) ? 0.0f : 1 - 0x1p-24f;

  // A direction next to the mirror image or the straight continuation, or any.
  Vec3 wo = random.direction();
  if (random.below(4)) {
    const double spread = in.alpha * random.scale(-1, 1), z = random.below(2) ? -1 : 1;
    wo = normalize(Vec3{in.wi[0], in.wi[1], z * in.wi[2]} + spread * wo);
  }
  store(wo, in.wo);
  return in;
}

/// A lobe of which float directions resolve nothing must be a perfectly specular one: a lobe that is rough
/// keeps its value within 5% where it meets surface and microfacet at 6 degrees or more, both ways.
constexpr double resolved = 0.05, resolved_cosine = 0.1;

double lobe_error(double found, double exact, double condition, const RoughLobeOracle::Value& at, Vec3 wo) {
  const double error = std::fabs(found - exact) / exact;
  const bool well = at.cosine > resolved_cosine && std::fabs(dot(wo, at.h)) > resolved_cosine &&
                    std::fabs(wo.z) > resolved_cosine && at.length > 0.5;
  return std::max(error / (operations * condition), well ? error / resolved : 0);
}

/// Samples: finite, of unit length; the weight is that of the oracle and bounded, since visible normals leave
/// but the shadowing; nothing of positive weight has no density, and every rough one leaves on its side.
CheckResult sampled(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "lobe");
  return run_random_check(
      context, 1, "of what rounding allows", make_input,
      [&](const auto& inputs) { return kernel.run<Output>(inputs); },
      [](const Input& in, const Output& out) {
        const Vec3 direction = to_vec(out.direction);
        if (!(std::fabs(length(direction) - 1) < 8 * unit) || !std::isfinite(out.weight) ||
            !std::isfinite(out.pdf) || out.weight < 0 || out.pdf < 0)
          return 1e9;
        const Lobe lobe(in, out.alpha);
        const double eta = lobe.oracle.transmits ? lobe.oracle.eta.real() : 1;
        if (out.weight > (1 + 8 * unit) * std::max(1.0, 1 / (eta * eta))) return 1e9;
        if (out.alpha == 0) return out.pdf == 0 && lobe_width(in) < widest_specular ? 0.0 : 1e9;
        if (out.weight == 0) return 0.0;  // the path ends
        if (!(out.pdf > 0)) return 1e9;
        const Vec3 wo = lobe.local(out.direction);
        if (wo.z == 0 || (wo.z < 0 && !lobe.oracle.transmits)) return 1e9;
        const auto exact = lobe.oracle.evaluate(lobe.v, wo);
        if (!(exact.pdf > 0)) return lobe.on_verge(exact, wo) ? 0.0 : 1e9;
        const double condition = lobe.condition(exact, wo);
        return std::max(lobe_error(out.pdf, exact.pdf, condition, exact, wo),
                        lobe_error(double(out.weight) * out.pdf, exact.value, condition, exact, wo));
      });
}

/// The density with which a direction was sampled is that which light sampling finds for it: else the two
/// would be weighted by sums other than 1.
CheckResult sampled_again(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "lobe");
  return run_random_check(
      context, 1, "of what rounding allows", make_input,
      [&](const auto& inputs) { return kernel.run<Output>(inputs); },
      [](const Input& in, const Output& out) {
        if (out.alpha == 0 || out.weight == 0) return 0.0;
        const Lobe lobe(in, out.alpha);
        const Vec3 wo = lobe.local(out.direction);
        const auto exact = lobe.oracle.evaluate(lobe.v, wo);
        if (!(exact.pdf > 0)) return 0.0;  // judged by the check of samples
        if (!(out.again_pdf > 0)) return lobe.on_verge(exact, wo) ? 0.0 : 1e9;
        const double condition = lobe.condition(exact, wo);
        return std::max(lobe_error(out.again_pdf, out.pdf, 2 * condition, exact, wo),
                        lobe_error(out.again_weight, out.weight, 2 * condition, exact, wo));
      });
}

/// Evaluation in any direction: that of the equations, and nothing where they say so.
CheckResult evaluated(CheckContext& context) {
  CheckKernel kernel(context, context.program(source), "lobe");
  return run_random_check(
      context, 1, "of what rounding allows", make_input,
      [&](const auto& inputs) { return kernel.run<Output>(inputs); },
      [](const Input& in, const Output& out) {
        if (out.alpha == 0) return 0.0;
        if (!std::isfinite(out.value) || !std::isfinite(out.value_pdf) || out.value < 0 || out.value_pdf < 0)
          return 1e9;
        const Lobe lobe(in, out.alpha);
        const Vec3 wo = lobe.local(in.wo);
        const auto exact = lobe.oracle.evaluate(lobe.v, wo);
        const double condition = lobe.condition(exact, wo);
        if (exact.length == 0 || lobe.on_verge(exact, wo)) return 0.0;
        // A path exactly along the surface has no side to reflect to.
        if (in.wi[2] == 0 && out.value == 0) return 0.0;
        if (!(exact.pdf > 0)) return out.value_pdf == 0 ? 0.0 : 1e9;
        return std::max(lobe_error(out.value_pdf, exact.pdf, condition, exact, wo),
                        lobe_error(out.value, exact.value, condition, exact, wo));
      });
}

}  // namespace

std::vector<Check> rough_lobe_checks() {
  return {{13, "rough samples against double", 2, sampled},
          {13, "densities of both ways alike", 2, sampled_again},
          {13, "rough evaluation against double", 2, evaluated}};
}

}  // namespace causticl
