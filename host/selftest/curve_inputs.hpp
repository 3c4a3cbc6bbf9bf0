// Revolved curves, and rays that ask most of their intersection.
#pragma once

#include "scene/curve.hpp"
#include "selftest/input_random.hpp"

namespace causticl {

/// Cusps, lines, flat and upright pieces, points on the axis, equal control points, tight turns, a thin wall.
extern const std::vector<CurvePoints> special_curves;

/// Closed about the axis, without self-intersections; the first is convex.
extern const std::vector<CurvePoints> closed_curves;

/// Of degree 1 to 16, turn by turn, with control points at random, as a vase, closed at the axis or across
/// it.
CurvePoints random_curve(std::uint64_t number);

/// Scales from 1/2 to 2, two rotations and a shift.
Transform random_placement(std::uint64_t number);

/// The point of the revolved curve at parameter t and an angle about the axis.
Vec3 curve_surface_point(const CurvePoints& curve, double t, double angle);

/// What a ray has to do with a curve.
enum class CurveRay {
  outside,          // towards anywhere within the bounds
  aimed,            // at a point of the surface
  inside,           // from within the bounds, any direction
  chord,            // through two points of the surface, 1e-7 to 0.1 of its size apart
  tangent,          // to the surface: a double root
  near_tangent,     // off that by 1e-8 to 0.01 of the size
  upright,          // parallel to the axis
  axial,            // along the axis, or up to 1e-3 off
  through_axis,     // meets it
  horizontal,       // d_y = 0
  near_horizontal,  // |d_y| from 1e-9 to 0.01, among them 1e-8
};

struct LocalRay {
  Vec3 origin, direction;  // of any length
};
LocalRay random_curve_ray(InputRandom& random, const CurvePoints& curve, CurveRay kind);

}  // namespace causticl
