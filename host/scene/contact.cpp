#include "scene/contact.hpp"

#include <algorithm>

#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

// Pairs of facets beyond which whole boxes are compared in their place.
constexpr std::size_t most_pairs = 20'000'000;

struct Plane {
  Vec3 normal, point;  // unit normal
  double distance(Vec3 p) const { return dot(normal, p - point); }
};

Plane plane_of(const Facet& facet) {
  const Vec3 n = facet.normal();
  const double size = length(n);
  return {size > 0 ? n / size : Vec3{}, facet.corner[0]};
}

Plane plane_of(const Object& object) {
  return {normalize(object.transform.inverse().rows[2]), object.transform.translation};
}

bool lies_in(const Facet& facet, const Plane& plane, double tolerance) {
  return std::all_of(std::begin(facet.corner), std::end(facet.corner),
                     [&](Vec3 p) { return std::fabs(plane.distance(p)) <= tolerance; });
}

BoundingBox around(Vec3 point, double reach) {
  BoundingBox box;
  box.add(point);
  return box.grown(reach);
}

/// Half the width of what lies within the tolerance of a tangent plane, for a sphere of that radius.
double tangent_reach(double radius, double tolerance) {
  return 2 * std::sqrt(2 * radius * tolerance) + tolerance;
}

BoundingBox tangent_spheres(const Body& a, const Body& b, double tolerance) {
  const Vec3 between = b.centre - a.centre;
  const double distance = length(between), larger = std::max(a.radius, b.radius);
  if (distance + std::fabs(a.radius - b.radius) <= tolerance) return intersection(a.bounds, b.bounds);
  const bool outside = std::fabs(distance - a.radius - b.radius) <= tolerance;
  const bool inside = std::fabs(distance - std::fabs(a.radius - b.radius)) <= tolerance;
  if (!(outside || inside) || !(distance > 0)) return {};
  const Vec3 direction = between / distance;
  const Body& one = outside || a.radius > b.radius ? a : b;
  const Vec3 place = one.centre + one.radius * (&one == &a ? direction : -direction);
  return around(
      place,
      tangent_reach(inside ? larger * larger / std::max(std::fabs(a.radius - b.radius), tolerance) : larger,
                    tolerance));
}

void add_tangent_plane(const Body& sphere, const Plane& plane, const BoundingBox* facet, double tolerance,
                       BoundingBox& region) {
  const double s = plane.distance(sphere.centre);
  if (!(std::fabs(std::fabs(s) - sphere.radius) <= tolerance)) return;
  const Vec3 foot = sphere.centre - s * plane.normal;
  const double reach = tangent_reach(sphere.radius, tolerance);
  if (!facet || holds(facet->grown(reach), foot)) region.add(around(foot, reach));
}

std::vector<const Facet*> facets_within(const Body& body, const BoundingBox& box, double tolerance) {
  std::vector<const Facet*> result;
  for (const auto& facet : body.facets)
    if (overlap(facet.bounds().grown(tolerance), box)) result.push_back(&facet);
  return result;
}

BoundingBox touching_facets(const Body& a, const Body& b, double tolerance) {
  const BoundingBox shared = intersection(a.bounds.grown(tolerance), b.bounds.grown(tolerance));
  if (shared.empty()) return {};
  const auto of_a = facets_within(a, shared, tolerance), of_b = facets_within(b, shared, tolerance);
  if (of_a.size() * of_b.size() > most_pairs) return shared;
  BoundingBox region;
  for (const Facet* f : of_a) {
    const BoundingBox bounds = f->bounds().grown(tolerance);
    const Plane plane = plane_of(*f);
    for (const Facet* g : of_b) {
      const BoundingBox common = intersection(bounds, g->bounds().grown(tolerance));
      if (common.empty()) continue;
      if (lies_in(*g, plane, tolerance) || lies_in(*f, plane_of(*g), tolerance)) region.add(common);
    }
  }
  return region;
}

BoundingBox touching_plane(const Body& body, const Plane& plane, double tolerance) {
  BoundingBox region;
  if (body.radius > 0) add_tangent_plane(body, plane, nullptr, tolerance, region);
  for (const auto& facet : body.facets)
    if (lies_in(facet, plane, tolerance)) region.add(facet.bounds().grown(tolerance));
  return region;
}

/// The distance from a point to a box, squared.
double distance2(const BoundingBox& box, Vec3 p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = std::max({box.low[axis] - p[axis], 0.0, p[axis] - box.high[axis]});
    sum += d * d;
  }
  return sum;
}

bool facets_near(const Body& a, const Body& b, double tolerance) {
  const BoundingBox shared = intersection(a.bounds.grown(tolerance), b.bounds.grown(tolerance));
  const auto of_a = facets_within(a, shared, tolerance), of_b = facets_within(b, shared, tolerance);
  if (of_a.size() * of_b.size() > most_pairs) return true;
  return std::any_of(of_a.begin(), of_a.end(), [&](const Facet* f) {
    const BoundingBox bounds = f->bounds().grown(tolerance);
    return std::any_of(of_b.begin(), of_b.end(),
                       [&](const Facet* g) { return overlap(bounds, g->bounds()); });
  });
}

}  // namespace

double contact_tolerance(const BoundingBox& bounds) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::fabs(bounds.low[axis]), std::fabs(bounds.high[axis])});
  return 8e-6 * largest;
}

BoundingBox touching_faces(const Body& a, const Body& b, double tolerance) {
  if (is_infinite(*a.object) && is_infinite(*b.object)) return {};
  if (is_infinite(*a.object)) return touching_plane(b, plane_of(*a.object), tolerance);
  if (is_infinite(*b.object)) return touching_plane(a, plane_of(*b.object), tolerance);
  if (!overlap(a.bounds.grown(tolerance), b.bounds)) return {};
  if (a.radius > 0 && b.radius > 0) return tangent_spheres(a, b, tolerance);
  if (a.radius > 0 || b.radius > 0) {
    const Body &sphere = a.radius > 0 ? a : b, &other = a.radius > 0 ? b : a;
    BoundingBox region;
    for (const auto& facet : other.facets) {
      const BoundingBox bounds = facet.bounds();
      add_tangent_plane(sphere, plane_of(facet), &bounds, tolerance, region);
    }
    return region;
  }
  return touching_facets(a, b, tolerance);
}

bool surfaces_meet(const Body& a, const Body& b, double tolerance) {
  if (is_infinite(*a.object) || is_infinite(*b.object)) return true;
  if (!overlap(a.bounds.grown(tolerance), b.bounds)) return false;
  if (a.radius > 0 && b.radius > 0) return length(a.centre - b.centre) <= a.radius + b.radius + tolerance;
  if (a.radius > 0 || b.radius > 0) {
    const Body &sphere = a.radius > 0 ? a : b, &other = a.radius > 0 ? b : a;
    const double reach = sphere.radius + tolerance;
    if (std::any_of(other.facets.begin(), other.facets.end(),
                    [&](const Facet& f) { return distance2(f.bounds(), sphere.centre) <= reach * reach; }))
      return true;
    return other.holds(sphere.centre);
  }
  return facets_near(a, b, tolerance) || a.holds(b.facets[0].corner[0]) || b.holds(a.facets[0].corner[0]);
}

}  // namespace causticl
