#include "scene/lit_sides.hpp"

#include <algorithm>

#include "mesh/mesh_parts.hpp"
#include "scene/light_kind.hpp"
#include "scene/material_kind.hpp"
#include "scene/object_bounds.hpp"
#include "scene/object_sides.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

/// How far from the camera's origin rays may start.
double start_of_view(const CameraSpec& camera) {
  return camera.aperture + camera.plane_distance * (1 + 0.5 * (length(camera.right) + length(camera.up)));
}

class LitSidesFinder {
 public:
  explicit LitSidesFinder(const Scene& scene) : scene_(scene) {
    const Vec3 lens = Vec3{1, 1, 1} * start_of_view(scene.camera);
    add_source(scene.camera.origin - lens, scene.camera.origin + lens);
    for (const auto& light : scene.lights)
      if (shines_from_point(light.kind)) add_source(light.position, light.position);
    for (const auto& object : scene.objects) {
      corners_.push_back(object_corners(scene, object));
      if (max_component(material(object).emission) > 0) {
        sources_.push_back({causticl::swept_bounds(scene, object), &object});
        endless_ = endless_ || is_infinite(object);
      }
    }
  }

  LitSides find() {
    for (const auto& object : scene_.objects)
      if (is_infinite(object)) sides_.shapes.push_back(of_flat(object));
    for (const auto& object : scene_.objects) {
      if (is_infinite(object)) continue;
      if (object.mesh >= 0) {
        add_mesh(object);
        continue;
      }
      const bool dark_inside = kind_of(object).is_convex_body(object) && is_dark_inside(object);
      const int side = is_flat(object) ? of_flat(object) : dark_inside ? 1 : 0;
      if (is_made_of_triangles(object))
        add_triangles(kind_of(object).triangles(scene_, object), side);
      else
        sides_.shapes.push_back(side);
    }
    return std::move(sides_);
  }

  bool is_dark_inside(const Object& object) const {
    return !endless_ && is_opaque(object) &&
           holds_no_source(causticl::swept_bounds(scene_, object),
                           material(object).two_sided ? nullptr : &object);
  }

  int sides_that_may_be_lit(const Object& object) const {
    constexpr int both = front_side | back_side;
    if (has_motion(scene_) || max_component(scene_.medium.scattering) > 0) return both;
    int sides = 0;
    for (const auto& light : scene_.lights) {
      if (has_property(light.kind, BEYOND_SCENE)) return both;
      if (shines_from_point(light.kind)) sides |= side_with(object, light.position);
    }
    for (const double step : {-1.0, 0.0, 1.0})  // across where rays start, as if it faced the object
      sides |= side_with(object, scene_.camera.origin + step * start_of_view(scene_.camera) *
                                                            normalize(object.transform.inverse().rows[2]));
    for (std::size_t i = 0; i < scene_.objects.size() && sides != both; ++i)
      if (&scene_.objects[i] != &object) sides |= sides_with(object, scene_.objects[i], corners_[i]);
    return sides;
  }

 private:
  const Scene& scene_;
  std::vector<std::vector<Vec3>> corners_;  // of each object
  struct Source {
    BoundingBox bounds;
    const Object* object;  // none of the lens and of lights that are no surfaces
  };
  std::vector<Source> sources_;  // of light, and the lens
  bool endless_ = false;         // an infinite plane emits
  LitSides sides_;
  std::int32_t parts_ = 0;

  const MaterialSpec& material(const Object& object) const {
    return scene_.materials[static_cast<std::size_t>(object.material)];
  }

  void add_source(Vec3 low, Vec3 high) {
    BoundingBox box;
    box.add(low);
    box.add(high);
    sources_.push_back({box, nullptr});
  }

  /// `outward` is an object that emits outwards alone, if at all.
  bool holds_no_source(const BoundingBox& bounds, const Object* outward = nullptr) const {
    return std::none_of(sources_.begin(), sources_.end(), [&](const Source& source) {
      return (!source.object || source.object != outward) && overlap(bounds, source.bounds);
    });
  }

  bool is_opaque(const Object& object) const { return !is_transparent(material(object)); }

  int of_flat(const Object& object) const {
    const int lit = sides_that_may_be_lit(object);
    return lit == front_side ? 1 : lit == back_side ? -1 : 0;
  }

  void add_mesh(const Object& object) {
    const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(object.mesh)];
    const std::size_t first = sides_.triangles.size();
    add_triangles(mesh.triangles(), 0);
    const bool may_be_dark = !endless_ && is_opaque(object);
    for (const MeshPart& part : mesh_parts(mesh)) {
      if (!part.connected) continue;
      const bool dark =
          may_be_dark && part.closed && part.has_volume() && holds_no_source(swept_bounds(object, part));
      for (const std::uint32_t t : part.triangles) {
        if (dark) sides_.triangles[first + t] = part.is_inwards() ? -1 : 1;
        sides_.parts[first + t] = parts_;
      }
      ++parts_;
    }
  }

  void add_triangles(std::size_t count, int side) {
    sides_.triangles.insert(sides_.triangles.end(), count, side);
    sides_.parts.insert(sides_.parts.end(), count, -1);
  }

  BoundingBox swept_bounds(const Object& object, const MeshPart& part) const {
    BoundingBox bounds;
    for (const double time : scene_.camera.shutter)
      for (const Vec3 corner : box_corners(object.transform, part.low, part.high))
        bounds.add(corner + time * object.motion);
    return bounds;
  }
};

}  // namespace

LitSides lit_sides(const Scene& scene) { return LitSidesFinder(scene).find(); }

bool may_be_lit_inside(const Scene& scene, const Object& object) {
  return !LitSidesFinder(scene).is_dark_inside(object);
}

int sides_that_may_be_lit(const Scene& scene, const Object& object) {
  return LitSidesFinder(scene).sides_that_may_be_lit(object);
}

}  // namespace causticl
