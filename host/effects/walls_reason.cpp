#include "effects/walls_reason.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/passes.hpp"

namespace causticl {
namespace {

using Shape = Object::Shape;

const MaterialSpec& material_of(const Scene& scene, const Object& object) {
  return scene.materials[static_cast<std::size_t>(object.material)];
}

bool is_flat(const Object& object) {
  return object.shape == Shape::plane || object.shape == Shape::rectangle || object.shape == Shape::disk;
}

/// Corners of a box around the object in the world; of a plane none.
std::vector<Vec3> corners(const Scene& scene, const Object& object) {
  Vec3 low, high;
  switch (object.shape) {
    case Shape::plane:
      return {};
    case Shape::mesh: {
      const Mesh& mesh = scene.meshes[static_cast<std::size_t>(object.mesh)];
      const double infinity = std::numeric_limits<double>::infinity();
      low = {infinity, infinity, infinity};
      high = -low;
      for (const auto& position : mesh.positions)
        for (int axis = 0; axis < 3; ++axis) {
          const double x = position[static_cast<std::size_t>(axis)];
          low[axis] = std::min(low[axis], x);
          high[axis] = std::max(high[axis], x);
        }
      break;
    }
    case Shape::box:
      high = 0.5 * object.size;
      low = -high;
      break;
    case Shape::rectangle:
      high = {0.5, 0.5, 0};
      low = -high;
      break;
    case Shape::bezier:
      for (const auto& [radius, height] : object.points) {
        const double r = std::max(high.x, std::fabs(radius));
        low = {-r, std::min(low.y, height), -r};
        high = {r, std::max(high.y, height), r};
      }
      break;
    case Shape::sphere:
    case Shape::disk:
      high = {object.radius, object.radius, object.shape == Shape::disk ? 0 : object.radius};
      low = -high;
  }
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i)
    points.push_back(
        object.transform.point({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}));
  return points;
}

/// On which sides of the flat `wall` the other object has some of itself, as 1 and 2.
int sides(const Object& wall, const Scene& scene, const Object& other) {
  const Vec3 n = normalize(wall.transform.inverse().rows[2]);
  const Vec3 origin = wall.transform.translation;
  if (other.shape == Shape::plane) {
    const Vec3 m = normalize(other.transform.inverse().rows[2]);
    if (length(cross(m, n)) > 1e-6) return 3;
  }
  auto points = corners(scene, other);
  if (points.empty()) points = {other.transform.translation};
  double low = 0, high = 0, size = 0;
  for (const Vec3 p : points) {
    low = std::min(low, dot(n, p - origin));
    high = std::max(high, dot(n, p - origin));
    size = std::max({size, length(p), length(origin)});
  }
  return (high > 1e-5 * size ? 1 : 0) | (low < -1e-5 * size ? 2 : 0);
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
  const auto points = corners(scene, wall);
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
  const Box b = box_of(corners(scene, other));
  Vec3 gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
  return length(gap) <= near * std::max(a.edge(), b.edge());
}

bool may_part(const Scene& scene, const Object& wall) {
  const MaterialSpec& material = material_of(scene, wall);
  if (material.kind == MaterialSpec::Kind::glass && !material.alpha_diffuse) return false;
  const bool moves = has_motion(scene);
  int did_hit = 0;
  const bool several = wall.shape == Shape::mesh || wall.shape == Shape::bezier;
  for (const Object& other : scene.objects) {
    if (!stores_photons(material_of(scene, other)) || (is_flat(wall) && &other == &wall)) continue;
    if (is_flat(wall) && !moves)
      did_hit |= sides(wall, scene, other);
    else if (&other == &wall ? several : moves || are_near(scene, wall, other))
      return true;
  }
  return did_hit == 3;
}

}  // namespace

std::string walls_reason(const Scene& scene) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
                                  [&](const Object& object) { return may_part(scene, object); });
  return found == scene.objects.end() ? "" : "surfaces about " + found->pointer;
}

}  // namespace causticl
