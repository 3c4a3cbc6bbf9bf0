#include "selftest/curve_inputs.hpp"

#include "selftest/curve_oracle.hpp"

namespace causticl {

const std::vector<CurvePoints> special_curves{
    {{0.5, 0}, {1.5, 1}, {0.5, 1}, {1.5, 0}},                  // cusp
    {{0.5, 0}, {1.5, 1}, {0.501, 1}, {1.5, 0}},                // nearly a cusp
    {{0, 0}, {1, 0}},                                          // disc
    {{0.5, 0}, {0.5, 1}},                                      // cylinder
    {{0, 0}, {1, 1}},                                          // cone
    {{0.2, 0}, {0.4, 0}, {0.6, 0}, {1, 0}},                    // annulus of degree 3
    {{0.5, 0}, {0.5, 0.1}, {0.5, 0.7}, {0.5, 0.2}, {0.5, 1}},  // a cylinder that runs back on itself
    {{0.1, 0}, {0.4, 0.3}, {0.7, 0.6}, {1, 0.9}},              // control points on a line
    {{0, -1}, {1.4, -1}, {1.4, 1}, {0, 1}},                    // egg, smooth at the poles
    {{0, -1}, {0, -1}, {1, 0}, {0, 1}, {0, 1}},                // equal ends
    {{0, 0}, {0, 0.5}, {1, 0.5}, {1, 1}},                      // leaves along the axis
    {{1, 0}, {0, 0}, {0, 1}},                                  // ends along the axis
    {{0.3, 0}, {1, 0.2}, {1, 0.2}, {1, 0.2}, {0.3, 0.4}},      // a narrow nose
    {{0.6, -1}, {0.6, 1e-3}, {0.6, -1e-3}, {0.601, 1}},        // almost a cylinder
    {{0.6, -1}, {0.6, 1}, {0.6000001, 1}, {0.6000001, -1}},    // a wall 1e-7 thick
    {{-1, 0}, {0.2, 1.5}, {0.2, -1.5}, {1, 0}},                // through the axis
    {{1000, 5000}, {2000, 6000}, {500, 7000}, {1000, 8000}},   // large, far from its origin
    {{1e-4, 0}, {3e-4, 1e-4}, {1e-4, 4e-4}},                   // small
};

const std::vector<CurvePoints> closed_curves{
    {{0, -1}, {1.4, -1}, {1.4, 1}, {0, 1}},                                // egg
    {{0, -1}, {2, -1}, {-0.2, 0}, {1.5, 1}, {0, 1}},                       // waist
    {{0, -1}, {0.8, 0}, {0, 1}},                                           // pointed at both poles
    {{0, 1}, {1, 0.2}, {1.6, -0.4}, {0.1, 0.1}, {1, -1}, {0, -1}},         // from top to bottom
    {{0, -1}, {3, -1}, {3, -0.9}, {3, 0.5}, {-1, 0.7}, {1, 0.9}, {0, 1}},  // flat below, narrow above
    {{0, 0}, {1e3, 0}, {2e3, 1e3}, {1e3, 3e3}, {0, 3e3}},                  // large
};

CurvePoints random_curve(std::uint64_t number) {
  InputRandom random(1, number);
  const auto degree = static_cast<int>(1 + number % 16);
  CurvePoints points;
  for (int i = 0; i <= degree; ++i) {
    const double step = static_cast<double>(i) / degree;
    switch (number / 16 % 4) {
      case 0:
        points.push_back({random.uniform(0, 1), random.uniform(-1, 1)});
        break;
      case 1:  // a vase
        points.push_back({random.uniform(0.1, 1), 2 * step - 1});
        break;
      case 2:  // closed at the axis
        points.push_back({i == 0 || i == degree ? 0 : random.uniform(0, 2), 2 * step - 1});
        break;
      default:  // across the axis
        points.push_back({random.uniform(-1, 1), random.uniform(-1, 1)});
    }
  }
  return points;
}

Transform random_placement(std::uint64_t number) {
  InputRandom random(2, number);
  const auto scale = [&] { return random.uniform(0.5, 2); };
  const auto angle = [&] { return random.uniform(0, 2 * std::numbers::pi); };
  const auto shift = [&] { return random.uniform(-1, 1); };
  return Transform::scale({scale(), scale(), scale()})
      .followed_by(Transform::rotate(0, angle()))
      .followed_by(Transform::rotate(1, angle()))
      .followed_by(Transform::shift({shift(), shift(), shift()}));
}

Vec3 curve_surface_point(const CurvePoints& curve, double t, double angle) {
  const auto p = CurveOracle::point(curve, t);
  return {p[0] * std::cos(angle), p[1], p[0] * std::sin(angle)};
}

LocalRay random_curve_ray(InputRandom& random, const CurvePoints& curve, CurveRay kind) {
  // Of the control points, which hold the curve.
  double radius = 0, low = curve[0][1], high = low;
  for (const auto& p : curve) {
    radius = std::max(radius, std::abs(p[0]));
    low = std::min(low, p[1]);
    high = std::max(high, p[1]);
  }
  const double size = std::hypot(2 * radius, 2 * radius, high - low);
  const auto within = [&] {
    return Vec3{random.uniform(-radius, radius), random.uniform(low, high), random.uniform(-radius, radius)};
  };
  const double t = random.uniform(), angle = random.uniform(0, 2 * std::numbers::pi);
  const Vec3 outside = Vec3{0, (low + high) / 2, 0} + random.direction() * size;
  const Vec3 target = curve_surface_point(curve, t, angle);

  switch (kind) {
    case CurveRay::outside:
      return {outside, within() - outside};
    case CurveRay::aimed:
      return {outside, target - outside};
    case CurveRay::inside:
      return {within(), random.direction()};
    case CurveRay::chord: {
      const double apart = random.scale(-7, -1);
      const Vec3 second = curve_surface_point(curve, std::clamp(t + apart * random.uniform(-1, 1), 0.0, 1.0),
                                              angle + apart * random.uniform(-1, 1));
      const Vec3 along = second - target;
      if (!(length(along) > 0)) return {outside, target - outside};
      return {target - normalize(along) * (size * random.uniform(0.1, 1.5)), along};
    }
    case CurveRay::tangent:
    case CurveRay::near_tangent: {
      const Vec3 around{-std::sin(angle), 0, std::cos(angle)};
      const Vec3 up =
          curve_surface_point(curve, t + 1e-6, angle) - curve_surface_point(curve, t - 1e-6, angle);
      const double mix = random.uniform(-1, 1);
      const Vec3 along =
          length(up) > 0 ? normalize(normalize(up) * mix + around * (1 - std::abs(mix))) : around;
      const double off = kind == CurveRay::tangent ? 0 : size * random.scale(-8, -2);
      return {target + random.direction() * off - along * (size * random.uniform(0, 1.5)), along};
    }
    case CurveRay::upright: {
      Vec3 o = within();
      o.y = low - size;
      return {o, {0, 1, 0}};
    }
    case CurveRay::axial: {
      const double tilt = random.below(2) ? 0 : random.scale(-9, -3);
      return {{0, high + size, 0}, {tilt, -1, tilt * random.uniform(-1, 1)}};
    }
    case CurveRay::through_axis:
      return {outside, Vec3{0, random.uniform(low, high), 0} - outside};
    default: {
      Vec3 o = outside, d = within() - outside;
      const bool flat = kind == CurveRay::horizontal;
      o.y = flat ? random.uniform(low, high) : target.y;
      d.y = 0;
      d = normalize(d);
      if (!flat) d.y = std::copysign(random.below(4) ? random.scale(-9, -2) : 1e-8, random.uniform(-1, 1));
      return {o, d};
    }
  }
}

}  // namespace causticl
