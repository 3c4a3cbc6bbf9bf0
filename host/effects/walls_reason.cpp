#include "effects/walls_reason.hpp"

#include <algorithm>
#include <cmath>

#include "effects/passes.hpp"
#include "scene/lit_sides.hpp"
#include "scene/object_sides.hpp"

namespace causticl {
namespace {

using Shape = Object::Shape;

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

/// Whether a search radius may take in something of both: if the gap between them is a quarter of the larger
/// at most.
bool are_near(const Scene& scene, const Object& wall, const Object& other) {
  constexpr double near = 0.25;
  const auto points = object_corners(scene, wall);
  const Box a = box_of(points);
  if (other.shape == Shape::plane) {
    const Vec3 n = normalize(other.transform.inverse().rows[2]);
    double low = INFINITY, high = -INFINITY;
    for (const Vec3 p : points) {
      low = std::min(low, dot(n, p - other.transform.translation));
      high = std::max(high, dot(n, p - other.transform.translation));
    }
    return std::max(low, -high) <= near * a.edge();
  }
  const Box b = box_of(object_corners(scene, other));
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
  return length(gap) <= near * std::max(a.edge(), b.edge());
}

bool may_part(const Scene& scene, const Object& wall) {
  const MaterialSpec& material = material_of(scene, wall);
  if (material.kind == MaterialSpec::Kind::glass && !material.alpha_diffuse) return false;
  const bool moves = has_motion(scene);
  // On which sides of a flat wall there is something that holds photons, and what of it is near.
  int found = 0, near = 0;
  const bool several = wall.shape == Shape::mesh || wall.shape == Shape::bezier;
  for (const Object& other : scene.objects) {
    if (!stores_photons(material_of(scene, other)) || (is_flat(wall) && &other == &wall)) continue;
    if (is_flat(wall) && !moves) {
      const int on = sides_with(wall, scene, other);
      found |= on;
      near |= are_near(scene, wall, other) ? on : 0;
    } else if (&other == &wall ? several : moves || are_near(scene, wall, other)) {
      return true;
    }
  }
  if (found == 3) return true;
  // Itself it holds photons on the other side.
  return near != 0 && stores_photons(material) && (sides_that_may_be_lit(scene, wall) & ~near) != 0;
}

}  // namespace

std::string walls_reason(const Scene& scene) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
                                  [&](const Object& object) { return may_part(scene, object); });
  return found == scene.objects.end() ? "" : "surfaces about " + found->pointer;
}

}  // namespace causticl
