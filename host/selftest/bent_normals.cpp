// Hard case 25: photons at surfaces whose shading normals are bent far from the geometric ones.
#include <algorithm>
#include <array>
#include <cmath>

#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"
#include "selftest/vectors.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

// For functions W and L on the sphere, both sides of
//   integral of W(wo) |wo.Ng| K(wo -> wi) L(wi) = integral of L(wi) |wi.Ng| K*(wi -> wo) W(wo),
// where K is what camera paths do and K* what photons do. Each sample starts in a uniform direction; an input
// is the mean of SAMPLES on either side.
constexpr const char* source = R"(
#include "materials/adjoint_bsdf.cl"
#include "sampling/rng.cl"
#define SAMPLES 8u
typedef struct {
  float4 normal;  // the shading normal; the geometric one is z. w: alpha
  float4 seen, lit;  // the middles of the bumps that W and L are; w of seen: index of refraction
  uint kind, vectorised, pad[2];
} BentSurface;
INLINE real bump(real3 direction, float4 middle) {
  real x = (real)0.5f + (real)0.5f * dot3(direction, convert_real3(middle.xyz));
  return x * x;
}
INLINE real3 uniform_direction(real4 random) {
  real z = 2 * random.x - 1, r = sqrt(fmax(1 - z * z, (real)0));
  real2 turn = cos_sin_turn(random.y);
  return (real3)(r * turn.x, r * turn.y, z);
}
INLINE real sample(Bsdf bsdf, const Surface *surface, global const BentSurface *from, RandomStream stream, uint number,
                   bool photon) {
  real3 start = uniform_direction(random4(stream, 2 * number)), d = -start;
  real4 random = random4(stream, 2 * number + 1);
  if (is_layered(bsdf.kind)) choose_lobe(&bsdf, d, facing_normal(surface, d), random.z);
  BsdfSample next;
  if (!photon) next = bsdf_sample(&bsdf, surface, d, random, true);
  else if (from->vectorised) next = adjoint_bsdf_sample_smooth(&bsdf, surface, d, random);
  else next = adjoint_bsdf_sample(&bsdf, surface, d, random);
  return 4 * PI * fabs(start.z) * next.weight.x * bump(start, photon ? from->lit : from->seen) *
         bump(next.direction, photon ? from->seen : from->lit);
}
kernel void scatter(global float2 *out, uint count, uint first, uint seed, global const BentSurface *surfaces,
                    uint surface_count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, 25, first + i};
  global const BentSurface *from = surfaces + (first + i) % surface_count;
  Bsdf bsdf = {from->kind, (real3)(1, 0.5f, 0.25f), from->seen.w, from->normal.w, (real3)(0.2f, 1, 1), (real3)(3.9f, 2, 2), 0.5f,
               false};
  Surface surface = {(real3)(0, 0, 0), (real3)(0, 0, 1), convert_real3(from->normal.xyz), (real2)(0, 0), 0, 0};
  real camera = 0, photon = 0;
  for (uint k = 0; k < SAMPLES; ++k) {
    camera += sample(bsdf, &surface, from, stream, 2 * k, false);
    photon += sample(bsdf, &surface, from, stream, 2 * k + 1, true);
  }
  out[i] = (float2)((float)(camera / SAMPLES), (float)(photon / SAMPLES));
}
)";

struct BentSurface {
  float4 normal, seen, lit;
  std::uint32_t kind, vectorised, pad[2];
};

/// Every material, at tilts of a coarse mesh and of a strong bump, and at one beyond.
std::vector<BentSurface> bent_surfaces() {
  struct Lobe {
    uint kind;
    float alpha, ior;
    bool vectorised;
  };
  constexpr std::array lobes{
      Lobe{MATERIAL_DIFFUSE, 0, 1, false},       Lobe{MATERIAL_DIFFUSE, 0, 1, true},
      Lobe{MATERIAL_MIRROR, 0, 1, false},        Lobe{MATERIAL_MIRROR, 0, 1, true},
      Lobe{MATERIAL_GLASS, 0, 1.5f, false},      Lobe{MATERIAL_GLASS, 0, 1.5f, true},
      Lobe{MATERIAL_GLASS, 0, 0.75f, true},      Lobe{MATERIAL_CONDUCTOR, 0, 1, false},
      Lobe{MATERIAL_PLASTIC, 0, 1.5f, false},    Lobe{MATERIAL_MIRROR, 0.2f, 1, false},
      Lobe{MATERIAL_CONDUCTOR, 0.5f, 1, false},  Lobe{MATERIAL_GLASS, 0.3f, 1.5f, false},
      Lobe{MATERIAL_PLASTIC, 0.3f, 1.5f, false}, Lobe{MATERIAL_THIN_GLASS, 0, 1.5f, false},
      Lobe{MATERIAL_THIN_GLASS, 0, 0.7f, false}, Lobe{MATERIAL_OREN_NAYAR, 0, 1, false}};
  std::vector<BentSurface> surfaces;
  // Directions of 13 surfaces for each tilt, at which the mutations of the kernels show.
  for (std::size_t steepness = 0; steepness < 3; ++steepness)
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      const Lobe& lobe = lobes[i];
      InputRandom random(25, 13 * steepness + i);
      const double degrees = std::array{20.0, 45.0, 75.0}[steepness];
      const double tilt = degrees * std::numbers::pi / 180, turn = random.uniform(0, 2 * std::numbers::pi);
      const Vec3 normal{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
      surfaces.push_back({to_float4(normal, lobe.alpha),
                          to_float4(random.direction(), lobe.ior),
                          to_float4(random.direction()),
                          lobe.kind,
                          lobe.vectorised,
                          {}});
    }
  return surfaces;
}

/// Sum, sum of squares and number of samples.
struct Moments {
  double sum = 0, squares = 0, count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double variance_of_mean() const { return (squares / count - mean() * mean()) / count; }
};

/// The two sides differ by noise alone. That one of 48 pairs differs by more than is granted happens in one
/// selftest of 40000.
CheckResult adjoint(CheckContext& context) {
  constexpr std::size_t batch = std::size_t{1} << 18;
  // Fewer samples of each surface tell nothing of their variance.
  const std::uint64_t inputs = std::max<std::uint64_t>(context.inputs, 4096);
  const auto surfaces = bent_surfaces();
  const auto buffer = context.device.upload(surfaces, "surfaces of a check");
  SampleKernel<float2> scatter(context, context.program(source), "scatter", buffer,
                               static_cast<cl_uint>(surfaces.size()));
  std::vector<Moments> camera(surfaces.size()), photon(surfaces.size());
  CheckResult result;
  result.unit = "standard errors";
  result.tolerance = 5;
  for (std::uint64_t first = 0; first < inputs; first += batch) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(batch, inputs - first));
    const auto samples = scatter(first, size);
    for (std::size_t i = 0; i < size; ++i) {
      camera[(first + i) % surfaces.size()].add(samples[i].x);
      photon[(first + i) % surfaces.size()].add(samples[i].y);
    }
    result.inputs += size;
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const double error = std::fabs(camera[s].mean() - photon[s].mean()) /
                         std::sqrt(camera[s].variance_of_mean() + photon[s].variance_of_mean());
    result.failures += !(error <= result.tolerance);
    if (!(error <= result.worst_error)) result.worst_error = error;
  }
  return result;
}

}  // namespace

std::vector<Check> bent_normal_checks() {
  return {{25, "photons are the adjoint of camera paths", 3, adjoint}};
}

}  // namespace causticl
