#include "device_scene/wall_primitives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/passes.hpp"
#include "scene/float4.hpp"
#include "scene/material_kind.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

uint type_of(const WallPrimitive& primitive) { return static_cast<uint>(primitive.wall.origin.w); }

Vec3 absolute(Vec3 v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// A primitive of the material, without its shape.
WallPrimitive primitive_of(const Scene& scene, std::size_t material) {
  const MaterialSpec& spec = scene.materials[material];
  WallPrimitive result{};
  result.blocks = !is_transparent(spec) || spec.alpha_diffuse;
  result.receives = stores_photons(spec);
  return result;
}

void set_bounds(WallPrimitive& primitive, Vec3 low, Vec3 high) {
  primitive.low = low;
  primitive.high = high;
}

/// False for a triangle without area.
bool set_triangle(WallPrimitive& primitive, const Vec3 (&corner)[3]) {
  const Vec3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);
  if (!(length(across) > 0) || !std::isfinite(length(across))) return false;
  const Vec3 n = normalize(across);
  primitive.wall.origin = to_float4(corner[0], WALL_TRIANGLE);
  primitive.wall.normal = to_float4(n);
  Vec3 low = corner[0], high = corner[0];
  primitive.corners.assign(corner, corner + 3);
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], corner[i][axis]);
      high[axis] = std::max(high[axis], corner[i][axis]);
    }
    const Vec3 inward = normalize(cross(n, corner[(i + 1) % 3] - corner[i]));
    primitive.wall.edge[i] = to_float4(inward, dot(inward, corner[i] - corner[0]));
  }
  set_bounds(primitive, low, high);
  return true;
}

/// Makes two triangles that are the halves of a parallelogram one primitive. False if they are not.
bool join(WallPrimitive& first, const WallPrimitive& second) {
  constexpr double tolerance = 1e-6;  // of the size: what rounding the corners may change
  if (type_of(first) != WALL_TRIANGLE || first.blocks != second.blocks || first.receives != second.receives ||
      first.lit_side != second.lit_side || first.part != second.part)
    return false;
  const std::vector<Vec3>&a = first.corners, &b = second.corners;
  const double size = length(first.high - first.low);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      // The diagonal is opposite of a[i] and of b[j].
      const Vec3 p = a[(i + 1) % 3], q = a[(i + 2) % 3];
      if (!(p == b[(j + 2) % 3] && q == b[(j + 1) % 3])) continue;
      if (length(p + q - a[i] - b[j]) > tolerance * size) continue;
      const Vec3 n = to_vec3(first.wall.normal), centre = 0.5 * (p + q);
      const Vec3 along[2] = {p - a[i], q - a[i]};
      for (std::size_t k = 0; k < 2; ++k) {
        const Vec3 across = normalize(cross(n, along[k]));
        first.wall.edge[k] = to_float4(across, 0.5 * std::fabs(dot(across, along[1 - k])));
      }
      first.wall.origin = to_float4(centre, WALL_PARALLELOGRAM);
      first.corners = {a[i], p, b[j], q};
      for (int axis = 0; axis < 3; ++axis) {
        first.low[axis] = std::min(first.low[axis], second.low[axis]);
        first.high[axis] = std::max(first.high[axis], second.high[axis]);
      }
      return true;
    }
  return false;
}

/// A shape whose walls are flat pieces, which may lie a little inside of it: what they stand for is whether
/// something is behind them.
void add_facets(const Scene& scene, Object object, double time, int lit_side,
                std::vector<WallPrimitive>& primitives) {
  constexpr int curve_pieces = 24;
  object.transform.translation = object.transform.translation + time * object.motion;
  std::vector<Facet> facets;
  kind_of(object).add_facets(object, curve_pieces, facets);
  for (const Facet& facet : facets) {
    WallPrimitive primitive = primitive_of(scene, static_cast<std::size_t>(object.material));
    primitive.lit_side = lit_side;
    if (set_triangle(primitive, facet.corner)) primitives.push_back(primitive);
  }
}

}  // namespace

std::vector<WallPrimitive> wall_primitives(const Scene& scene, const FlatScene& world, const LitSides& sides,
                                           double time) {
  std::vector<WallPrimitive> primitives;
  primitives.reserve(world.tree.triangles.size() + world.shapes.size());
  for (std::size_t i = 0; i < world.tree.triangles.size(); ++i) {
    const auto& position = world.tree.triangles[i].position;
    WallPrimitive primitive = primitive_of(scene, world.attributes[i].material & ~TRIANGLE_SMOOTH);
    primitive.lit_side = sides.triangles[i];
    primitive.part = sides.parts[i];
    const auto corner = [&](int c) { return Vec3{position[c][0], position[c][1], position[c][2]}; };
    if (!set_triangle(primitive, {corner(0), corner(1), corner(2)})) continue;
    if (primitives.empty() || !join(primitives.back(), primitive)) primitives.push_back(std::move(primitive));
  }
  for (std::size_t i = 0; i < world.shapes.size(); ++i) {
    const causticl::Shape& shape = world.shapes[i];
    WallPrimitive primitive = primitive_of(scene, shape.material);
    primitive.lit_side = sides.shapes[i];
    ShapeWall wall{};
    if (!kind_of_record(shape).wall(shape, wall)) continue;
    primitive.wall = wall.wall;
    set_bounds(primitive, wall.low, wall.high);
    primitives.push_back(primitive);
  }
  std::size_t shape = world.plane_count;  // of the next object that is one
  for (const auto& object : scene.objects) {
    if (is_infinite(object) || is_made_of_triangles(object)) continue;
    ShapeWall wall{};
    if (!kind_of(object).wall(world.shapes[shape], wall))
      add_facets(scene, object, time, sides.shapes[shape], primitives);
    ++shape;
  }
  return primitives;
}

bool may_reach(const WallPrimitive& primitive, const WallBox& box, double reach) {
  const Vec3 from = box.centre - to_vec3(primitive.wall.origin);
  const double half_diagonal = length(box.half);
  if (type_of(primitive) == WALL_SPHERE)
    return std::fabs(length(from) - primitive.wall.normal.w) <= reach + half_diagonal;
  const Vec3 n = to_vec3(primitive.wall.normal);
  if (std::fabs(dot(n, from)) > reach + dot(absolute(n), box.half)) return false;
  if (type_of(primitive) == WALL_DISK) return length(from) <= reach + half_diagonal + primitive.wall.normal.w;
  if (type_of(primitive) == WALL_TRIANGLE)
    for (const float4& edge : primitive.wall.edge) {
      const Vec3 inward = to_vec3(edge);
      if (edge.w - dot(inward, from) > reach + dot(absolute(inward), box.half)) return false;
    }
  if (type_of(primitive) == WALL_PARALLELOGRAM)
    for (int i = 0; i < 2; ++i) {
      const Vec3 across = to_vec3(primitive.wall.edge[i]);
      if (std::fabs(dot(across, from)) - primitive.wall.edge[i].w > reach + dot(absolute(across), box.half))
        return false;
    }
  return true;
}

std::vector<Vec3> clipped(std::vector<Vec3> polygon, const WallBox& box) {
  std::vector<Vec3> next;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const auto outside = [&](Vec3 p) { return sign * (p[axis] - box.centre[axis]) - box.half[axis]; };
      next.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = outside(a), db = outside(b);
        if (da <= 0) next.push_back(a);
        if ((da < 0) != (db < 0) && da != db) next.push_back(a + (da / (da - db)) * (b - a));
      }
      polygon.swap(next);
    }
  return polygon;
}

WallSides sides_of(const WallPrimitive& wall, const WallPrimitive& other, const std::vector<Vec3>& polygon,
                   double tolerance) {
  WallSides sides;
  const Vec3 origin = to_vec3(wall.wall.origin), n = to_vec3(wall.wall.normal);
  const bool sphere = type_of(wall) == WALL_SPHERE;
  const double radius = wall.wall.normal.w;
  const auto add = [&](double low, double high) {
    sides.front = sides.front || high > tolerance;
    sides.back = sides.back || low < -tolerance;
  };
  const auto distance = [&](Vec3 p) { return sphere ? length(p - origin) - radius : dot(n, p - origin); };
  const Vec3 place = to_vec3(other.wall.origin), other_normal = to_vec3(other.wall.normal);
  switch (type_of(other)) {
    case WALL_SPHERE: {
      const double at = distance(place), reach = other.wall.normal.w;
      add(sphere ? std::max(at - reach, -radius) : at - reach, at + reach);
      break;
    }
    case WALL_PLANE:
    case WALL_DISK: {
      if (sphere) {
        add(std::fabs(dot(other_normal, origin - place)) - radius, infinity);
        break;
      }
      // Of a plane what lies in the box, at most.
      const double sine = std::sqrt(std::max(0.0, 1 - dot(n, other_normal) * dot(n, other_normal)));
      const double reach = type_of(other) == WALL_PLANE ? infinity : other.wall.normal.w;
      if (sine < 1e-6)
        add(distance(place), distance(place));
      else
        add(distance(place) - reach * sine, distance(place) + reach * sine);
      break;
    }
    default: {
      if (polygon.empty()) break;
      double low = infinity, high = -infinity;
      for (const Vec3 p : polygon) {
        low = std::min(low, distance(p));
        high = std::max(high, distance(p));
      }
      if (sphere) {  // a face may dip into the sphere between its corners
        const double at = std::fabs(dot(other_normal, origin - polygon[0])) - radius;
        low = std::min(low, at);
      }
      add(low, high);
    }
  }
  return sides;
}

}  // namespace causticl
