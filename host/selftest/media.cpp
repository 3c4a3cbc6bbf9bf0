// Hard cases 12 and 23: glass that absorbs or disperses, and the medium: how far light goes and where to.
#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"
#include "selftest/vectors.hpp"
#include "shared/effects.h"
#include "shared/types.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "media/interior.cl"
#include "sampling/rng.cl"
typedef struct {
  float extinction, distance;
} Segment;
kernel void attenuate(global const Segment *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = transmittance((real3)(0, in[i].extinction, 0), in[i].distance).y;
}
kernel void phase(global const float2 *in, global float *out, uint count) {
  uint i = get_global_id(0);
  if (i < count) out[i] = phase_density(in[i].x, in[i].y);
}
kernel void turn(global float4 *out, uint count, uint first, uint seed, float4 direction, float g) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, 6, first + i};
  out[i] = convert_float4((real4)(phase_sample(g, convert_real3(direction.xyz), random4(stream, 0).xy), 0));
}
typedef struct {
  float throughput[3], extinction[3], t_max, u[2];
} Flight;
kernel void fly(global const Flight *in, global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global const Flight *f = in + i;
  Medium medium = {(real3)(f->extinction[0], f->extinction[1], f->extinction[2]), (real3)(0, 0, 0), 0};
  real3 throughput = (real3)(f->throughput[0], f->throughput[1], f->throughput[2]);
  real distance = 0;
  bool interacts = medium_flight(&medium, f->t_max, (real2)(f->u[0], f->u[1]), &throughput, &distance);
  out[i] = convert_float4((real4)(throughput, interacts ? distance : -1));
}
)";

cl::Program program(CheckContext& context) { return context.program(source, EFFECT_MEDIUM); }

struct Segment {
  float extinction, distance;
};

/// Without absorption all light is left, however far. Where little is, the rounding of the exponent counts as
/// often as the exponent is large.
CheckResult absorption(CheckContext& context) {
  CheckKernel kernel(context, program(context), "attenuate");
  return run_random_check(
      context, 3e-7, "relative, over 1 + the exponent",
      [](InputRandom& random, std::uint64_t index) {
        Segment in{static_cast<float>(random.scale(-6, 6)), 0};
        in.distance = static_cast<float>(random.scale(-6, 1.9) / in.extinction);
        if (index % 8 == 0) in = {0, index % 16 ? INFINITY : static_cast<float>(random.scale(-30, 30))};
        return in;
      },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](const Segment& in, float left) {
        if (in.extinction == 0) return std::fabs(left - 1.0);
        const double exponent = static_cast<double>(in.extinction) * in.distance;
        return std::fabs(left / std::exp(-exponent) - 1) / (1 + exponent);
      });
}

struct Turned {
  float g, cosine;
};

/// A third of the angles lie in the peak, whose width is 1 - |g|.
CheckResult phase_function(CheckContext& context) {
  CheckKernel kernel(context, program(context), "phase");
  return run_random_check(
      context, 2e-6, "relative",
      [](InputRandom& random, std::uint64_t index) {
        const double sign = random.below(2) ? 1 : -1;
        const double g = index % 2 ? random.uniform(0, 1) : 1 - random.scale(-4, 0);
        Turned in{static_cast<float>(sign * std::min(g, 0.9999)), static_cast<float>(random.uniform(-1, 1))};
        if (index % 3 == 0) in.cosine = static_cast<float>(sign * (1 - random.scale(-7, 0)));
        return in;
      },
      [&](const auto& inputs) { return kernel.run<float>(inputs); },
      [](const Turned& in, float density) {
        const double g = in.g, square = (1 - g) * (1 - g) + 2 * g * (1 - static_cast<double>(in.cosine));
        const double exact = (1 - g * g) / (4 * std::numbers::pi * square * std::sqrt(square));
        return std::fabs(density / exact - 1);
      });
}

/// In coordinates in which the phase function is uniform: the fraction of light that is turned by less, and
/// the turn about the axis.
CheckResult scattered_directions(CheckContext& context) {
  constexpr SquareBins bins{16, 16};
  constexpr double g = 0.75;
  const Frame frame(normalize(Vec3{1, -2, 0.5}));
  SampleKernel<float4> draw(context, program(context), "turn", to_float4(frame.z), static_cast<cl_float>(g));
  return run_histogram_check(
      context, {flat_histogram(bins.count())}, draw,
      [&](const float4& v, std::uint64_t, std::vector<Histogram>& to) {
        const Vec3 d = to_vec3(v), local = frame.to_local(d), chord = d - frame.z;
        const double drop = dot(chord, chord) / 2;
        // The integral of the phase function from no turn on.
        const double inner =
            (1 - g * g) / (2 * g) * (1 / (1 - g) - 1 / std::sqrt((1 - g) * (1 - g) + 2 * g * drop));
        to[0].add(std::fabs(length(d) - 1) <= 5e-7 ? bins.bin(inner, turn(local.y, local.x), 1e-5)
                                                   : bins.count());
      });
}

struct Flight {
  float throughput[3], extinction[3], t_max, u[2];
};

/// The distance by the extinction of the channel that was drawn, and what is carried on: transmittance over
/// the density of all channels together.
CheckResult free_flight(CheckContext& context) {
  CheckKernel kernel(context, program(context), "fly");
  return run_random_check(
      context, 2e-5, "relative",
      [](InputRandom& random, std::uint64_t index) {
        Flight in;
        for (float& value : in.throughput) value = index % 5 && random.below(4) ? random.uniform24() : 0;
        if (index % 5 == 0) in.throughput[random.below(3)] = 1;
        for (float& value : in.extinction) value = static_cast<float>(random.scale(-1, 1));
        in.t_max = index % 7 ? static_cast<float>(random.scale(-2, 0.5)) : INFINITY;
        for (float& value : in.u) value = random.uniform24();
        return in;
      },
      [&](const auto& inputs) { return kernel.run<float4>(inputs); },
      [](const Flight& in, const float4& out) {
        const double throughput[] = {in.throughput[0], in.throughput[1], in.throughput[2]},
                     sum = throughput[0] + throughput[1] + throughput[2];
        if (!(sum > 0)) return out.x == 0 && out.y == 0 && out.z == 0 && out.w < 0 ? 0.0 : INFINITY + 0.0;
        // A random number at the border of two channels may choose either.
        const double u = in.u[0] * sum, one = throughput[0], two = throughput[0] + throughput[1];
        if (std::fabs(u - one) < 1e-6 * sum || std::fabs(u - two) < 1e-6 * sum) return 0.0;
        const int channel = u < one ? 0 : u < two ? 1 : 2;
        const double distance = -std::log1p(-static_cast<double>(in.u[1])) / in.extinction[channel];
        if (std::fabs(distance / in.t_max - 1) < 1e-6) return 0.0;  // before or behind the end
        const bool interacts = distance < in.t_max;
        if (interacts != (out.w >= 0)) return INFINITY + 0.0;
        const double flown = interacts ? distance : in.t_max;
        double density = 0, left[3];
        for (int c = 0; c < 3; ++c) {
          left[c] = std::exp(-in.extinction[c] * flown);
          density += throughput[c] / sum * left[c] * (interacts ? in.extinction[c] : 1);
        }
        double error = interacts && distance > 0 ? std::fabs(out.w / distance - 1) : 0;
        const float found[] = {out.x, out.y, out.z};
        for (int c = 0; c < 3; ++c) {
          const double exact = throughput[c] * left[c] / density, scale = 1 + in.extinction[c] * flown;
          // What is far below the float's range beside the others may be lost.
          if (exact > 1e-20) error = std::max(error, std::fabs(found[c] / exact - 1) / scale);
        }
        return error;
      });
}

constexpr const char* dispersion_source = R"(
#include "materials/dispersion.cl"
typedef struct {
  float throughput[3], random, b;
} DispersionInput;
typedef struct {
  float throughput[3], ior;
} DispersionOutput;
kernel void bend(global const DispersionInput *in, global DispersionOutput *out, uint count, global Material *materials,
                 float4 inverse_wavelength2) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = {0};
  bsdf.kind = MATERIAL_GLASS;
  bsdf.ior = (real)1.5;
  materials[i].absorption.w = in[i].b;
  real3 throughput = (real3)(in[i].throughput[0], in[i].throughput[1], in[i].throughput[2]);
  disperse(&bsdf, materials + i, convert_real3(inverse_wavelength2.xyz), in[i].random, &throughput);
  vstore3(convert_float3(throughput), 0, out[i].throughput);
  out[i].ior = bsdf.ior;
}
)";

struct DispersionInput {
  float throughput[3], random, b;
};
struct DispersionOutput {
  float throughput[3], ior;
};

/// One channel goes on, with the weight of all and the index of its own wavelength.
CheckResult dispersion(CheckContext& context) {
  const auto materials = context.device.buffer(check_batch * sizeof(Material), "materials of a check");
  const float4 inverse{1 / (0.61f * 0.61f), 1 / (0.55f * 0.55f), 1 / (0.46f * 0.46f), 0};
  CheckKernel kernel(context, context.program(dispersion_source, EFFECT_GLASS | EFFECT_DISPERSION), "bend");
  kernel.with(materials, inverse);
  return run_random_check(
      context, 4e-7, "relative",
      [](InputRandom& random, std::uint64_t index) {
        DispersionInput in;
        for (float& value : in.throughput) value = random.below(4) ? random.uniform24() : 0;
        in.random = random.uniform24();
        in.b = index % 8 ? static_cast<float>(random.scale(-4, -1)) : 0;
        return in;
      },
      [&](const auto& inputs) { return kernel.run<DispersionOutput>(inputs); },
      [&](const DispersionInput& in, const DispersionOutput& out) {
        const double one = in.throughput[0], two = one + in.throughput[1], sum = two + in.throughput[2];
        if (!(in.b > 0) || !(sum > 0)) {
          const bool kept = std::equal(in.throughput, in.throughput + 3, out.throughput) && out.ior == 1.5f;
          return kept ? 0.0 : INFINITY + 0.0;
        }
        const double u = in.random * sum;
        if (std::fabs(u - one) < 1e-6 * sum || std::fabs(u - two) < 1e-6 * sum) return 0.0;
        const int channel = u < one ? 0 : u < two ? 1 : 2;
        const double ior = 1.5 + static_cast<double>(in.b) * (channel == 0   ? inverse.x
                                                              : channel == 1 ? inverse.y
                                                                             : inverse.z);
        double error = std::max(std::fabs(out.throughput[channel] / sum - 1), std::fabs(out.ior / ior - 1));
        for (int c = 0; c < 3; ++c)
          if (c != channel && out.throughput[c] != 0) error = INFINITY;
        return error;
      });
}

}  // namespace

std::vector<Check> media_checks() {
  return {{12, "glass disperses one channel by its own index", 2, dispersion, "dispersion"},
          {23, "light that is left behind absorption", 1, absorption},
          {23, "the phase function against double", 1, phase_function},
          {23, "directions by the phase function", 1, scattered_directions},
          {23, "free flight in a medium", 1, free_flight}};
}

}  // namespace causticl
