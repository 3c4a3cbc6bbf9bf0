#include "scene/flush_emitters.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "scene/body.hpp"
#include "scene/material_kind.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

// In roundings of the coordinates there, of a float: surfaces this near to each other are one to rays, and
// rays tell them apart this far from each other.
constexpr double one_surface = 4, clear_of_it = 8;
constexpr double rounding = 1.0 / (1 << 23);

// Points of an emitter that are looked at, and pairs of these and facets in all.
constexpr std::size_t most_points = 200, most_pairs = 50'000'000;

const MaterialSpec& material_of(const Scene& scene, const Object& object) {
  return scene.materials[static_cast<std::size_t>(object.material)];
}

Vec3 unit_normal(const Facet& facet) {
  const Vec3 n = facet.normal();
  const double size = length(n);
  return size > 0 ? n / size : Vec3{};
}

double largest_coordinate(const Vec3& p) {
  return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}

double largest_coordinate(const Facet& facet) {
  double largest = 0;
  for (const Vec3& corner : facet.corner) largest = std::max(largest, largest_coordinate(corner));
  return largest;
}

/// A flat emitter, or a pane without thickness.
struct FlatEmitter {
  std::vector<Vec3>
      points;  // inside, none at the edge of a facet: surfaces that meet there are beside each other
  Vec3 normal;
  BoundingBox bounds;
  double coordinate = 0;  // the largest of its corners
};

/// Whether light goes through the surface itself, with no body behind it.
bool is_pane(const MaterialSpec& material) { return is_transparent(material) && !bounds_body(material); }

/// The emitter or pane that an object is, if all its facets lie in one plane.
std::optional<FlatEmitter> flat_emitter(const Scene& scene, const Object& object) {
  if (!is_lit(scene, object) && !is_pane(material_of(scene, object))) return {};
  FlatEmitter emitter;
  const auto facets = object_facets(scene, object);
  for (const Facet& facet : facets) {
    emitter.bounds.add(facet.bounds());
    emitter.coordinate = std::max(emitter.coordinate, largest_coordinate(facet));
    if (!(length(emitter.normal) > 0)) emitter.normal = unit_normal(facet);
  }
  if (!(length(emitter.normal) > 0)) return {};
  for (const Facet& facet : facets) {
    if (dot(emitter.normal, facet.normal()) < 0) return {};
    for (const Vec3& corner : facet.corner)
      if (std::fabs(dot(emitter.normal, corner - facets[0].corner[0])) > rounding * emitter.coordinate)
        return {};
  }
  const std::size_t step = 4 * facets.size() / most_points + 1;
  for (std::size_t i = 0; i < facets.size(); i += step) {
    const Facet& facet = facets[i];
    const Vec3 middle = (facet.corner[0] + facet.corner[1] + facet.corner[2]) / 3;
    emitter.points.push_back(middle);
    for (const Vec3& corner : facet.corner) emitter.points.push_back(middle + 0.9 * (corner - middle));
  }
  return emitter;
}

/// How far above surfaces the points of an emitter lie that lie in one, along its normal.
struct Heights {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  double rounding = 0;  // the largest of the coordinates there
  std::string surface;  // pointer of the first

  bool any() const { return lowest <= highest; }
};

/// Adds the height of a point over a plane if the two are one surface.
void add_height(const FlatEmitter& emitter, Vec3 point, Vec3 plane_normal, Vec3 in_plane, double coordinate,
                const Object& other, Heights& heights) {
  const double cosine = dot(plane_normal, emitter.normal),
               unit = rounding * std::max(coordinate, emitter.coordinate);
  if (!(std::fabs(cosine) > 0.999)) return;
  const double height = dot(plane_normal, point - in_plane) / cosine;
  if (!(std::fabs(height) <= one_surface * unit)) return;
  heights.lowest = std::min(heights.lowest, height);
  heights.highest = std::max(heights.highest, height);
  heights.rounding = std::max(heights.rounding, unit);
  if (heights.surface.empty()) heights.surface = other.pointer;
}

bool lies_over(const Facet& facet, Vec3 point) {
  const Vec3 n = facet.normal();
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = facet.corner[i], b = facet.corner[(i + 1) % 3];
    if (dot(cross(b - a, point - a), n) < 0) return false;
  }
  return true;
}

/// The facets of objects, made once.
class Facets {
 public:
  explicit Facets(const Scene& scene) : scene_(scene), facets_(scene.objects.size()) {}

  const std::vector<Facet>& of(std::size_t object) {
    if (!facets_[object]) facets_[object] = object_facets(scene_, scene_.objects[object]);
    return *facets_[object];
  }

 private:
  const Scene& scene_;
  std::vector<std::optional<std::vector<Facet>>> facets_;
};

/// Adds what lies in the surface of object `index`.
void add_heights(const Scene& scene, std::size_t index, const FlatEmitter& emitter, Facets& facets,
                 std::size_t& pairs, Heights& heights) {
  const Object& other = scene.objects[index];
  if (is_infinite(other)) {
    const Vec3 at = other.transform.translation, n = normalize(other.transform.inverse().rows[2]);
    for (const Vec3& point : emitter.points)
      add_height(emitter, point, n, at, largest_coordinate(at), other, heights);
    return;
  }
  const BoundingBox bounds = object_bounds(scene, other);
  const double reach =
      one_surface * rounding *
      std::max({emitter.coordinate, largest_coordinate(bounds.low), largest_coordinate(bounds.high)});
  const BoundingBox around = emitter.bounds.grown(reach);
  if (!overlap(around, bounds)) return;
  for (const Facet& facet : facets.of(index)) {
    if (!overlap(facet.bounds(), around)) continue;
    if (pairs < emitter.points.size()) return;
    pairs -= emitter.points.size();
    const Vec3 n = unit_normal(facet);
    for (const Vec3& point : emitter.points)
      if (lies_over(facet, point))
        add_height(emitter, point, n, facet.corner[0], largest_coordinate(facet), other, heights);
  }
}

}  // namespace

std::vector<std::string> lift_flush_emitters(Scene& scene) {
  std::vector<std::string> moved;
  Facets facets(scene);
  std::size_t pairs = most_pairs;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    Object& object = scene.objects[i];
    const auto emitter = flat_emitter(scene, object);
    if (!emitter) continue;
    Heights heights;
    for (std::size_t j = 0; j < scene.objects.size(); ++j) {
      const Object& other = scene.objects[j];
      if (j == i || emission_of(scene, other) > 0) continue;
      // A lamp in the face of a body is left to cl/scene/contact.cl, which knows nothing of panes.
      const MaterialSpec& material = material_of(scene, other);
      if (bounds_body(material) && !is_pane(material_of(scene, object))) continue;
      if (dot(object.motion - other.motion, emitter->normal) != 0) continue;
      add_heights(scene, j, *emitter, facets, pairs, heights);
    }
    if (!heights.any()) continue;
    const double gap = clear_of_it * heights.rounding;
    const bool either_side = material_of(scene, object).two_sided || is_pane(material_of(scene, object));
    const bool behind = either_side && heights.lowest + heights.highest < -1e-6 * gap;
    const double shift = behind ? -gap - heights.highest : gap - heights.lowest;
    object.transform.translation = object.transform.translation + shift * emitter->normal;
    char distance[32];
    std::snprintf(distance, sizeof distance, "%.2g", std::fabs(shift));
    moved.push_back(object.pointer + " lies in " + heights.surface +
                    " as far as rays can tell: moved out of it by " + distance);
  }
  return moved;
}

}  // namespace causticl
