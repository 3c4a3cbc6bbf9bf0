// A Bezier curve revolved about the y axis: what the device needs of it, its bounds and its area.
#pragma once

#include <array>
#include <vector>

#include "base/vec.hpp"

namespace causticl {

/// Control points (radius x, height y) of one Bezier curve of degree size() - 1. Negative x revolves to the
/// same surface as |x|, which is the profile that everything below speaks of.
using CurvePoints = std::vector<std::array<double, 2>>;

/// The curve as cl/shapes/primitives/bezier.cl reads it: see the layout there. The curve is scaled into the
/// unit cylinder and cut into spans on which |x|, y and the direction of the tangent are monotone and the
/// direction turns little; a span holds polynomials of degree 5 that differ from the curve by less than
/// float's rounding. A curve without area (a point, a piece of the axis) has no spans.
std::vector<float> curve_data(const CurvePoints& points);

/// Axis-aligned bounds of the revolved surface in local space, padded by what single precision may lose.
struct CurveBounds {
  Vec3 low, high;
};
CurveBounds curve_bounds(const CurvePoints& points);

/// How the local-space area of the revolved surface spreads over equal steps of the curve parameter, for
/// sampling emission: float 0 is `segments`, float 1 the whole area, and then come `segments` inclusive
/// running sums divided by it, multiples of 2^-24, the last one exactly 1.
std::vector<float> curve_area_table(const CurvePoints& points, int segments);

}  // namespace causticl
