// Rough lobes in double precision, by the equations as they are printed: what cl/materials/microfacet.cl is
// judged by.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/vec.hpp"

namespace causticl {

/// Reflectance of a smooth boundary to the relative index `eta`, real or complex, from complex amplitudes.
inline double fresnel_oracle(double cosine, std::complex<double> eta) {
  cosine = std::clamp(cosine, 0.0, 1.0);
  const std::complex<double> root = std::sqrt(eta * eta - (1 - cosine * cosine));
  const auto perpendicular = (cosine - root) / (cosine + root);
  const auto parallel = (eta * eta * cosine - root) / (eta * eta * cosine + root);
  return 0.5 * (std::norm(perpendicular) + std::norm(parallel));
}

/// GGX in the frame where z is the normal on the side of v, the direction that a path came from.
struct RoughLobeOracle {
  double alpha;
  std::complex<double> eta;  // index beyond / before
  bool transmits = false;

  struct Value {
    double value = 0;  // BSDF * |cosine|, as radiance goes
    double pdf = 0;
    Vec3 h;             // the microfacet
    double cosine = 0;  // v.h
    double length = 0;  // |v + eta wo|, by which an error of the directions grows to one of h
  };

  double distribution(Vec3 h) const {
    const double tangent2 = (h.x * h.x + h.y * h.y) / (h.z * h.z), sum = alpha * alpha + tangent2;
    return alpha * alpha / (std::numbers::pi * std::pow(h.z, 4) * sum * sum);
  }
  double lambda(Vec3 v) const {
    return (std::sqrt(1 + alpha * alpha * (v.x * v.x + v.y * v.y) / (v.z * v.z)) - 1) / 2;
  }
  double masking(Vec3 v) const { return 1 / (1 + lambda(v)); }

  /// Walter et al. 2007, equations 20 and 21, with visible normals (Heitz 2018) for the density.
  Value evaluate(Vec3 v, Vec3 wo) const {
    Value result;
    const bool reflects = wo.z > 0;
    if (wo.z == 0 || (!reflects && !transmits)) return result;
    const Vec3 sum = reflects ? v + wo : v + eta.real() * wo;
    result.length = length(sum);
    result.h = sum * ((sum.z < 0 ? -1 : 1) / result.length);
    result.cosine = dot(v, result.h);
    const double other = dot(wo, result.h);
    if (!(result.cosine > 0) || (other > 0) != reflects) return result;
    const double reflectance = fresnel_oracle(result.cosine, eta), d = distribution(result.h);
    const double visible = masking(v) * result.cosine * d / v.z;
    const double occluded_along = result.cosine * d / (v.z * (1 + lambda(v) + lambda(wo)));
    if (reflects) {
      result.value = reflectance * occluded_along / (4 * result.cosine);
      result.pdf = (transmits ? reflectance : 1) * visible / (4 * result.cosine);
    } else {
      const double root = result.cosine + eta.real() * other;
      const double jacobian = std::norm(eta) * std::fabs(other) / (root * root);
      result.value = (1 - reflectance) * occluded_along * jacobian / std::norm(eta);
      result.pdf = (1 - reflectance) * visible * jacobian;
    }
    return result;
  }
};

}  // namespace causticl
