#include "scene/flush_emitters.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "scene/contact.hpp"

namespace causticl {
namespace {

const MaterialSpec& material_of(const Scene& scene, const Object& object) {
  return scene.materials[static_cast<std::size_t>(object.material)];
}

bool emits(const Scene& scene, const Object& object) {
  return max_component(material_of(scene, object).emission) > 0;
}

Vec3 unit_normal(const Facet& facet) {
  const Vec3 n = facet.normal();
  const double size = length(n);
  return size > 0 ? n / size : Vec3{};
}

/// The normal of facets that all lie in one plane; none where they do not.
std::optional<Vec3> flat_normal(const std::vector<Facet>& facets, double tolerance) {
  if (facets.empty()) return {};
  const Vec3 n = unit_normal(facets[0]), at = facets[0].corner[0];
  if (!(length(n) > 0)) return {};
  for (const Facet& facet : facets) {
    if (dot(n, facet.normal()) < 0) return {};
    for (const Vec3& corner : facet.corner)
      if (std::fabs(dot(n, corner - at)) > tolerance) return {};
  }
  return n;
}

/// Points inside the facets, none of them at an edge: surfaces that meet there are beside each other.
std::vector<Vec3> inner_points(const std::vector<Facet>& facets) {
  std::vector<Vec3> points;
  for (const Facet& facet : facets) {
    const Vec3 middle = (facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3;
    points.push_back(middle);
    for (const Vec3& corner : facet.corner) points.push_back(middle + 0.9 * (corner - middle));
  }
  return points;
}

/// How far above a plane a point lies, along `normal`, if the plane lies across that and within the
/// tolerance.
std::optional<double> height_over(Vec3 plane_normal, Vec3 in_plane, Vec3 point, Vec3 normal,
                                  double tolerance) {
  if (!(std::fabs(dot(plane_normal, normal)) > 1 - 1e-9)) return {};
  const double height = dot(normal, point - in_plane);
  return std::fabs(height) <= tolerance ? std::optional(height) : std::nullopt;
}

bool lies_over(const Facet& facet, Vec3 point) {
  const Vec3 n = facet.normal();
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = facet.corner[i], b = facet.corner[(i + 1) % 3];
    if (dot(cross(b - a, point - a), n) < 0) return false;
  }
  return true;
}

/// A flat emitter.
struct FlatEmitter {
  std::vector<Vec3> points;
  Vec3 normal;
  BoundingBox bounds;
  double tolerance;
};

/// How far above the surface of `other` the emitter lies, along its normal, where it lies in it.
std::optional<double> height_over(const Scene& scene, const Object& other, const FlatEmitter& emitter) {
  if (other.shape == Object::Shape::plane)
    return height_over(normalize(other.transform.inverse().rows[2]), other.transform.translation,
                       emitter.points[0], emitter.normal, emitter.tolerance);
  const BoundingBox around = emitter.bounds.grown(emitter.tolerance);
  if (!overlap(around, object_bounds(scene, other))) return {};
  for (const Facet& facet : object_facets(scene, other)) {
    if (!overlap(facet.bounds(), around)) continue;
    for (const Vec3& point : emitter.points)
      if (lies_over(facet, point))
        if (const auto height =
                height_over(unit_normal(facet), facet.corner[0], point, emitter.normal, emitter.tolerance))
          return height;
  }
  return {};
}

/// The emitter that an object is, if it is flat.
std::optional<FlatEmitter> flat_emitter(const Scene& scene, const Object& object) {
  if (!is_lit(scene, object) || object.shape == Object::Shape::plane || object.shape == Object::Shape::sphere)
    return {};
  const BoundingBox bounds = object_bounds(scene, object);
  // Rays and photons keep so far off a surface that one behind a gap of a quarter of this may be met through
  // it.
  const double tolerance = 4 * contact_tolerance(bounds);
  const auto facets = object_facets(scene, object);
  const auto normal = flat_normal(facets, tolerance);
  if (!normal) return {};
  return FlatEmitter{inner_points(facets), *normal, bounds, tolerance};
}

}  // namespace

std::vector<std::string> lift_flush_emitters(Scene& scene) {
  std::vector<std::string> moved;
  for (Object& object : scene.objects) {
    const auto emitter = flat_emitter(scene, object);
    if (!emitter) continue;
    for (const Object& other : scene.objects) {
      if (&other == &object || emits(scene, other) ||
          material_of(scene, other).kind == MaterialSpec::Kind::glass)
        continue;
      if (length(object.motion - other.motion) > 0) continue;
      const auto height = height_over(scene, other, *emitter);
      if (!height) continue;
      const double gap = *height < -1e-7 * emitter->tolerance ? -emitter->tolerance : emitter->tolerance;
      object.transform.translation = object.transform.translation + (gap - *height) * emitter->normal;
      char distance[32];
      std::snprintf(distance, sizeof distance, "%.1g", std::fabs(gap - *height));
      moved.push_back(object.pointer + " lies in " + other.pointer +
                      " as far as rays can tell: moved clear of it by " + distance);
      break;
    }
  }
  return moved;
}

}  // namespace causticl
