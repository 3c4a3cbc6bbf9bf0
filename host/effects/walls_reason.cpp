#include "effects/walls_reason.hpp"

#include <algorithm>
#include <cmath>

#include "effects/passes.hpp"
#include "scene/lit_sides.hpp"
#include "scene/material_kind.hpp"
#include "scene/object_sides.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

const MaterialSpec& material_of(const Scene& scene, const Object& object) {
  return scene.materials[static_cast<std::size_t>(object.material)];
}

struct Box {
  Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  double edge() const { return max_component(high - low); }
};

Box box_of(const std::vector<Vec3>& points) {
  Box box;
  for (const Vec3 p : points)
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  return box;
}

/// The scene with what is asked of its objects again and again.
class WallsFinder {
 public:
  explicit WallsFinder(const Scene& scene) : scene_(scene) {
    for (const auto& object : scene.objects) corners_.push_back(object_corners(scene, object));
  }

  /// Whether the object may stand between photons and a visible point.
  bool may_part(std::size_t index) const {
    const Object& wall = scene_.objects[index];
    const MaterialSpec& material = material_of(scene_, wall);
    if (is_transparent(material) && !material.alpha_diffuse) return false;
    const bool moves = has_motion(scene_);
    // On which sides of a flat wall there is something that holds photons, and what of it is near.
    int found = 0, near = 0;
    const bool several = !kind_of(wall).is_convex_body(wall) || may_part_itself(index);
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const Object& other = scene_.objects[i];
      if (!stores_photons(material_of(scene_, other)) || (is_flat(wall) && i == index)) continue;
      if (is_flat(wall) && !moves) {
        const int on = sides_with(wall, other, corners_[i]);
        found |= on;
        near |= are_near(index, i) ? on : 0;
      } else if (i == index ? several : moves || are_near(index, i)) {
        return true;
      }
    }
    if (found == (front_side | back_side)) return true;
    // Itself it holds photons on the other side.
    return near != 0 && stores_photons(material) && (sides_that_may_be_lit(scene_, wall) & ~near) != 0;
  }

 private:
  const Scene& scene_;
  std::vector<std::vector<Vec3>> corners_;  // of each object

  /// Radii of photons, where the scene states them; else 0.
  double stated_reach() const {
    return 1.4 * scene_.renderer.radius.value_or(0) * std::max(1.0, indirect_radius(scene_.renderer));
  }

  /// Whether a convex body has its inside lit, and a search radius may take in both of its ends.
  bool may_part_itself(std::size_t index) const {
    const Object& object = scene_.objects[index];
    if (!kind_of(object).is_convex_body(object)) return false;
    const Vec3 size = box_of(corners_[index]).high - box_of(corners_[index]).low;
    const bool fits = !scene_.renderer.radius || std::min({size.x, size.y, size.z}) <= stated_reach();
    return fits && may_be_lit_inside(scene_, object);
  }

  /// Whether a search radius may take in something of both: if the gap between them is a quarter of the
  /// larger at most, or within the radius that the scene states. Of two infinite planes nothing is known.
  bool are_near(std::size_t first, std::size_t second) const {
    constexpr double near = 0.25;
    const double stated = stated_reach();
    if (is_infinite(scene_.objects[first])) std::swap(first, second);
    if (is_infinite(scene_.objects[first])) return true;
    const Box a = box_of(corners_[first]);
    const Object& other = scene_.objects[second];
    if (is_infinite(other)) {
      const Vec3 n = normalize(other.transform.inverse().rows[2]);
      double low = INFINITY, high = -INFINITY;
      for (const Vec3 p : corners_[first]) {
        low = std::min(low, dot(n, p - other.transform.translation));
        high = std::max(high, dot(n, p - other.transform.translation));
      }
      return std::max(low, -high) <= std::max(stated, near * a.edge());
    }
    const Box b = box_of(corners_[second]);
    Vec3 gap;
    for (int axis = 0; axis < 3; ++axis)
      gap[axis] = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
    return length(gap) <= std::max(stated, near * std::max(a.edge(), b.edge()));
  }
};

}  // namespace

std::string walls_reason(const Scene& scene) {
  const WallsFinder finder(scene);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (finder.may_part(i)) return "surfaces about " + scene.objects[i].pointer;
  return "";
}

}  // namespace causticl
