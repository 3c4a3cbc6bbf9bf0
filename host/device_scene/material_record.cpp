#include "device_scene/material_record.hpp"

#include <cmath>

#include "scene/float4.hpp"

namespace causticl {
namespace {

/// Fraction of diffuse light that a smooth boundary to the index `eta` reflects back inside, from what it
/// lets in from outside by reciprocity. The integral over sin^2 theta by the midpoint rule, to 1e-6.
double inner_reflectance(double eta) {
  constexpr int steps = 10000;
  double entering = 0;
  for (int i = 0; i < steps; ++i) {
    const double cosine = std::sqrt((i + 0.5) / steps), square = (eta - 1) * (eta + 1) + cosine * cosine;
    if (square <= 0) continue;
    const double c = std::sqrt(square) / eta;
    const double parallel = (eta * cosine - c) / (eta * cosine + c);
    const double perpendicular = (cosine - eta * c) / (cosine + eta * c);
    entering += (1 - 0.5 * (parallel * parallel + perpendicular * perpendicular)) / steps;
  }
  return 1 - entering / (eta * eta);
}

// Fields that a kind has beside the common ones: MATERIAL_TABLE says which kinds do.

void write_conductor(const MaterialSpec& spec, double outside_ior, Material& record) {
  record.eta = to_float4(1 / outside_ior * spec.eta);
  record.k = to_float4(1 / outside_ior * spec.k);
}

void write_plastic(const MaterialSpec& spec, double outside_ior, Material& record) {
  record.eta.w = static_cast<float>(inner_reflectance(spec.ior / outside_ior));
}

void write_oren_nayar(const MaterialSpec& spec, double, Material& record) {
  record.eta.w = static_cast<float>(spec.diffuse_roughness);
}

}  // namespace

Material material_record(const MaterialSpec& spec, double outside_ior) {
  Material record{};
  record.kind = static_cast<uint>(spec.kind);
  record.color = to_float4(spec.color, spec.ior / outside_ior);
  record.emission = to_float4(spec.emission);
  record.absorption = to_float4(spec.absorption, spec.dispersion / outside_ior);
  record.alpha = static_cast<float>(spec.roughness * spec.roughness);
  record.flags =
      (spec.two_sided ? MATERIAL_TWO_SIDED : 0u) | (spec.alpha_diffuse ? MATERIAL_ALPHA_DIFFUSE : 0u);
  record.color_texture = static_cast<uint>(spec.color_texture + 1);
#define WRITE_COMMON_FIELDS(name)
#define WRITE_OWN_FIELDS(name) \
  if (spec.kind == MaterialSpec::Kind::name) write_##name(spec, outside_ior, record);
#define WRITE_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) WRITE_##fields(name)
  MATERIAL_TABLE(WRITE_ROW, )
  return record;
}

}  // namespace causticl
