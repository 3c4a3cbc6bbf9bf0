// Hard case 13: the density of sampled microfacets, from the narrowest rough lobe to the widest.
#include <array>
#include <numbers>

#include "selftest/histogram_check.hpp"
#include "selftest/stability_checks.hpp"
#include "shared/types.h"

namespace causticl {
namespace {

constexpr const char* source = R"(
#include "materials/microfacet.cl"
#include "sampling/rng.cl"
kernel void normals(global float4 *out, uint count, uint first, uint seed, global const float2 *lobes, uint lobe_count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  RandomStream stream = {seed, 0, first + i};
  float2 lobe = lobes[(first + i) % lobe_count];
  real3 v = (real3)(sqrt(1 - lobe.x * lobe.x), 0, lobe.x);
  out[i] = convert_float4((real4)(ggx_visible_normal(v, lobe.y, random4(stream, 0).xy), 0));
}
)";

constexpr std::array<float, 4> cosines{1, 0.7f, 0.1f, 1e-3f};
constexpr std::array<float, 4> alphas{1e-4f, 1e-2f, 0.3f, 1};
constexpr std::size_t bins = 8;  // each way

/// Bins of y = 1 / sqrt(1 + tan^2 / alpha^2), by which the normals of the distribution have density 2 y, and
/// of the angle about the surface's normal. What v sees of a normal at tangent t is in proportion to max(0,
/// v.h) / cos = v.z + t v.x cos(angle).
Histogram expected_histogram(double cosine, double alpha) {
  constexpr std::size_t steps = 128, side = bins * steps;
  const double sine = std::sqrt(1 - cosine * cosine);
  Histogram histogram(bins * bins);
  double sum = 0;
  for (std::size_t i = 0; i < side; ++i) {
    const double y = (static_cast<double>(i) + 0.5) / side, tangent = alpha * std::sqrt(1 - y * y) / y;
    for (std::size_t j = 0; j < side; ++j) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(j) + 0.5) / side;
      const double weight = std::max(0.0, cosine + tangent * sine * std::cos(angle)) * y;
      histogram.probabilities[i / steps * bins + j / steps] += weight;
      sum += weight;
    }
  }
  for (double& probability : histogram.probabilities) probability /= sum;
  return histogram;
}

CheckResult visible_normals(CheckContext& context) {
  std::vector<float2> lobes;
  std::vector<Histogram> histograms;
  for (const float cosine : cosines)
    for (const float alpha : alphas) {
      lobes.push_back({cosine, alpha});
      histograms.push_back(expected_histogram(cosine, alpha));
    }
  const auto buffer = context.device.upload(lobes, "lobes of a check");
  SampleKernel<float4> draw(context, context.program(source), "normals", buffer,
                            static_cast<cl_uint>(lobes.size()));
  return run_histogram_check(
      context, histograms, draw, [&](const float4& h, std::uint64_t number, std::vector<Histogram>& out) {
        const std::size_t lobe = number % lobes.size();
        const double x = h.x / lobes[lobe].y, z = h.z, other = h.y / lobes[lobe].y;
        const double y = z / std::sqrt(x * x + other * other + z * z);
        double turn = std::atan2(other, x) / (2 * std::numbers::pi);
        if (turn < 0) ++turn;
        const auto row = static_cast<std::size_t>(std::min(y * bins, bins - 0.5));
        const auto column = static_cast<std::size_t>(std::min(turn * bins, bins - 0.5));
        if (z >= 0)
          out[lobe].add(row * bins + column);
        else
          out[lobe].add_outside();
      });
}

}  // namespace

std::vector<Check> rough_lobe_sampling_checks() {
  return {{13, "visible normals follow their density", 1, visible_normals}};
}

}  // namespace causticl
