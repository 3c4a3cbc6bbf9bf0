#include "scene/dielectrics.hpp"

#include <algorithm>

#include "scene/contact.hpp"
#include "scene/light_kind.hpp"
#include "scene/material_kind.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

/// How much of one surface another body holds, as far as some points tell.
enum class Held { nothing, part, all };

Held held_by(const Body& holder, const Body& body) {
  if (!overlap(holder.bounds, body.bounds) && holder.closed) return Held::nothing;
  std::vector<Vec3> points = surface_points(body);
  // A winding number asks every facet.
  const std::size_t affordable = 20'000'000 / (holder.facets.size() + 1) + 1;
  const std::size_t step = points.size() / affordable + 1;
  std::size_t inside = 0, asked = 0;
  for (std::size_t i = 0; i < points.size(); i += step, ++asked) inside += holder.holds(points[i]);
  return inside == 0 ? Held::nothing : inside == asked ? Held::all : Held::part;
}

class Finder {
 public:
  explicit Finder(const Scene& scene) : scene_(scene) {
    result_.holds_emitter.assign(scene.objects.size(), false);
    result_.holds_light.assign(scene.lights.size(), false);
  }

  Dielectrics find() {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i)
      if (is_glass(scene_.objects[i])) {
        objects_.push_back(static_cast<int>(i));
        glass_.push_back(make_body(scene_, scene_.objects[i]));
        absorbs_ = absorbs_ || max_component(material(scene_.objects[i]).absorption) > 0;
      }
    if (glass_.empty()) return std::move(result_);
    find_camera();
    find_lights();
    for (std::size_t i = 0; i < glass_.size(); ++i) intersect_others(i);
    order_bodies();
    for (const auto& line : overlaps_) result_.lines.push_back(line);
    return std::move(result_);
  }

 private:
  const Scene& scene_;
  Dielectrics result_;
  std::vector<int> objects_;
  std::vector<Body> glass_;
  std::vector<std::pair<std::size_t, std::size_t>> inside_;  // (inner, outer) of `glass_`
  std::vector<std::string> overlaps_;
  bool absorbs_ = false;

  const MaterialSpec& material(const Object& object) const {
    return scene_.materials[static_cast<std::size_t>(object.material)];
  }
  bool is_glass(const Object& object) const { return bounds_body(material(object)); }
  bool fills(Vec3 v) const { return max_component(v) > 0; }
  /// Whether what lies inside glass is told from what lies outside along a segment that ends at neither.
  bool media_differ() const {
    return absorbs_ || fills(scene_.medium.absorption) || fills(scene_.medium.scattering);
  }

  void call(const std::string& reason) {
    if (result_.reason.empty()) result_.reason = reason;
  }

  std::string holders(Vec3 point, bool& any) const {
    std::string names;
    for (std::size_t i = 0; i < glass_.size(); ++i)
      if (glass_[i].holds(point)) names += (names.empty() ? "" : ", ") + scene_.objects[objects_[i]].pointer;
    any = !names.empty();
    return names;
  }

  void find_camera() {
    const CameraSpec& camera = scene_.camera;
    bool any = false;
    const std::string names = holders(camera.origin, any);
    if (any) result_.lines.push_back("the camera stands in " + names);
    for (int corner = 0; corner < 4 && !any; ++corner) {
      const double x = (corner & 1) - 0.5, y = (corner >> 1) - 0.5;
      const Vec3 lens = camera.aperture * (x * normalize(camera.right) + y * normalize(camera.up)) * 2;
      const Vec3 along = camera.axis + x * camera.right + y * camera.up;
      holders(camera.origin + lens + camera.plane_distance * along, any);
    }
    result_.holds_camera = any;
    if (any && media_differ()) call("the camera stands in a dielectric");
  }

  void find_lights() {
    bool any = false;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const LightSpec& light = scene_.lights[i];
      if (!shines_from_point(light.kind) || !is_lit(light)) continue;
      const std::string names = holders(light.position, any);
      if (!any) continue;
      result_.holds_light[i] = true;
      result_.lines.push_back(light.pointer + " stands in " + names);
      if (media_differ()) call("light " + light.pointer + " stands in " + names);
    }
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const Object& object = scene_.objects[i];
      if (!(max_component(material(object).emission) > 0) || is_infinite(object)) continue;
      const Body body = make_body(scene_, object);
      std::string names;
      for (std::size_t k = 0; k < glass_.size(); ++k)
        if (objects_[k] != static_cast<int>(i) && held_by(glass_[k], body) != Held::nothing)
          names += (names.empty() ? "" : ", ") + scene_.objects[objects_[k]].pointer;
      if (names.empty()) continue;
      result_.holds_emitter[i] = true;
      result_.lines.push_back("emitter " + object.pointer + " stands in " + names);
      if (media_differ()) call("emitter " + object.pointer + " stands in " + names);
    }
  }

  bool moves(const Object& object) const { return length(object.motion) > 0; }

  /// What body `i` of glass does with the other objects.
  void intersect_others(std::size_t i) {
    const Object& object = scene_.objects[objects_[i]];
    const double tolerance = contact_tolerance(glass_[i].bounds);
    for (std::size_t k = 0; k < scene_.objects.size(); ++k) {
      const Object& other = scene_.objects[k];
      if (is_glass(other)) continue;
      const bool emits = max_component(material(other).emission) > 0;
      BoundingBox region;
      if (moves(object) || moves(other))
        region = intersection(swept_bounds(scene_, object).grown(tolerance), swept_bounds(scene_, other));
      else if (is_infinite(other) || overlap(glass_[i].bounds.grown(tolerance), object_bounds(scene_, other)))
        region = touching_faces(glass_[i], make_body(scene_, other), tolerance);
      if (region.empty()) continue;
      result_.contact.add(region);
      if (emits) result_.holds_emitter[k] = result_.touches_emitter = true;
      call(object.pointer + " touches " + other.pointer);
    }
    for (std::size_t k = 0; k < i; ++k) meet_glass(k, i, tolerance);
  }

  void meet_glass(std::size_t a, std::size_t b, double tolerance) {
    const Object &first = scene_.objects[objects_[a]], &second = scene_.objects[objects_[b]];
    if (moves(first) || moves(second)) {
      const BoundingBox region =
          intersection(swept_bounds(scene_, first).grown(tolerance), swept_bounds(scene_, second));
      if (region.empty()) return;
      result_.contact.add(region);
      call(first.pointer + " and " + second.pointer + " may meet");
      return;
    }
    const Held in_second = held_by(glass_[b], glass_[a]), in_first = held_by(glass_[a], glass_[b]);
    const bool held = in_first != Held::nothing || in_second != Held::nothing;
    if (!held && !surfaces_meet(glass_[a], glass_[b], tolerance)) return;
    const BoundingBox region = touching_faces(glass_[a], glass_[b], tolerance);
    const bool nested = in_first == Held::all || in_second == Held::all;
    if (in_second == Held::all && in_first != Held::all) inside_.push_back({a, b});
    if (in_first == Held::all && in_second != Held::all) inside_.push_back({b, a});
    result_.contact.add(region);
    if (!nested)
      result_.contact.add(intersection(glass_[a].bounds.grown(tolerance), glass_[b].bounds.grown(tolerance)));
    const std::string names = first.pointer + " and " + second.pointer;
    call(names + (nested ? " lie in each other" : !region.empty() ? " touch" : " overlap or come near"));
    const int p = material(first).priority, q = material(second).priority;
    if (!nested && p == q && (in_first == Held::part || in_second == Held::part))
      overlaps_.push_back(names +
                          " overlap and have the same priority: the later one fills what both hold; give "
                          "one the higher \"priority\" to choose");
  }

  /// By priority, then what lies inside after what holds it, then in the order of the scene.
  void order_bodies() {
    if (result_.reason.empty()) return;
    // A direction that no scene has on purpose, or near the normals of open surfaces.
    const Vec3 odd{0.36514837, 0.91287093, -0.18257419};
    Vec3 normals;
    for (const auto& body : glass_)
      if (!body.closed) normals = normals + body.mean_normal();
    result_.inside_direction = length(normals) > 1e-3 ? normalize(normalize(normals) + 1e-3 * odd) : odd;
    const auto priority = [&](std::size_t i) { return material(scene_.objects[objects_[i]]).priority; };
    std::vector<bool> placed(glass_.size(), false);
    const auto waits = [&](std::size_t i) {
      return std::any_of(inside_.begin(), inside_.end(), [&](const auto& pair) {
        return pair.first == i && !placed[pair.second] && priority(pair.second) == priority(i);
      });
    };
    for (std::size_t count = 0; count < glass_.size(); ++count) {
      std::size_t next = glass_.size();
      for (std::size_t i = 0; i < glass_.size(); ++i)
        if (!placed[i] && !waits(i) && (next == glass_.size() || priority(i) < priority(next))) next = i;
      placed[next] = true;
      result_.bodies.push_back(objects_[next]);
    }
  }
};

}  // namespace

Dielectrics find_dielectrics(const Scene& scene) { return Finder(scene).find(); }

}  // namespace causticl
