#include "world/flat_scene.hpp"

#include <algorithm>
#include <numbers>

#include "accel/curve.hpp"
#include "base/error.hpp"
#include "scene/object_triangles.hpp"
#include "world/emitters.hpp"
#include "world/float4.hpp"

namespace causticl {
namespace {

using Shape3 = Object::Shape;

void store_rows(const Transform& transform, float4 rows[3]) {
  const Vec3& t = transform.translation;
  for (int i = 0; i < 3; ++i) rows[i] = to_float4(transform.rows[i], t[i]);
}

/// Appends the primitives of one object after another.
class SceneFlattener {
 public:
  SceneFlattener(const Scene& scene, double time, const Dielectrics& dielectrics)
      : scene_(scene), time_(time), dielectrics_(dielectrics) {
    for (const auto& object : scene.objects) materials_.push_back(static_cast<uint>(object.material));
    for (std::size_t i = 0; i < dielectrics.bodies.size(); ++i)
      materials_[static_cast<std::size_t>(dielectrics.bodies[i])] =
          static_cast<uint>(scene.materials.size() + i);
  }

  FlatScene build() {
    // Planes come first, so that a kernel scans them by number.
    for (index_ = 0; index_ < scene_.objects.size(); ++index_)
      if (scene_.objects[index_].shape == Shape3::plane) add_shape(placed(scene_.objects[index_]));
    world_.plane_count = static_cast<uint>(world_.shapes.size());
    for (index_ = 0; index_ < scene_.objects.size(); ++index_) {
      const Object object = placed(scene_.objects[index_]);
      switch (object.shape) {
        case Shape3::plane:
          break;
        case Shape3::mesh:
        case Shape3::rectangle:
        case Shape3::box:
          add_triangles(object);
          break;
        default:
          add_shape(object);
      }
    }
    finish_emitters(scene_, dielectrics_, world_);
    return std::move(world_);
  }

 private:
  const Scene& scene_;
  const double time_;
  const Dielectrics& dielectrics_;
  std::vector<uint> materials_;  // of each object, on the device
  std::size_t index_ = 0;        // of the object at hand
  FlatScene world_;

  /// The object where it is at the time.
  Object placed(Object object) const {
    object.transform.translation = object.transform.translation + time_ * object.motion;
    return object;
  }

  const MaterialSpec& material(const Object& object) const { return scene_.materials[object.material]; }
  // As a float, which is what the kernels see: the smallest doubles are none.
  bool emissive(const Object& object) const {
    return static_cast<float>(max_component(material(object).emission)) > 0;
  }

  Emitter emitter(const Object& object, uint type, double area) const {
    Emitter result{};
    result.type = type;
    result.radiance = to_float4(material(object).emission, area);
    result.two_sided = material(object).two_sided;
    result.in_dielectric = !dielectrics_.bodies.empty() && dielectrics_.holds_emitter[index_];
    return result;
  }

  /// Far from 0 a float has no digits for the place within a texel. Textures repeat, so that whole repeats
  /// are taken off there: two at a time, since the cells of a checker alternate.
  void store_uvs(const Object& object, const TriangleCorner (&corners)[3], float (&uvs)[3][2]) const {
    constexpr double far = 1024;
    const int texture = material(object).color_texture;
    for (int axis = 0; axis < 2; ++axis) {
      const auto value = [&](int c) { return axis == 0 ? corners[c].u : corners[c].v; };
      double offset = 0;
      if (texture >= 0) {
        const double scale =
            scene_.textures[static_cast<std::size_t>(texture)].scale[static_cast<std::size_t>(axis)];
        if (std::fabs(value(0) * scale) > far) offset = 2 * std::round(value(0) * scale / 2) / scale;
      }
      for (int c = 0; c < 3; ++c) uvs[c][axis] = static_cast<float>(value(c) - offset);
    }
  }

  /// One world-space triangle. Normals are used where `smooth`.
  void add_triangle(const Object& object, const TriangleCorner (&corners)[3], bool smooth) {
    TreeTriangle triangle{};
    float normals[3][3], uvs[3][2];
    for (int c = 0; c < 3; ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        triangle.position[c][axis] = static_cast<float>(corners[c].position[axis]);
        normals[c][axis] = static_cast<float>(corners[c].normal[axis]);
      }
    }
    store_uvs(object, corners, uvs);
    world_.tree.triangles.push_back(triangle);
    world_.attributes.push_back(triangle_attributes(materials_[index_], smooth ? normals : nullptr, uvs));
    if (!emissive(object)) return;
    if (!(triangle_area(corners) > 0)) return;
    const Vec3 e1 = corners[1].position - corners[0].position, e2 = corners[2].position - corners[0].position;
    const double area = 0.5 * length(cross(e1, e2));
    Emitter light = emitter(object, EMITTER_TRIANGLE, area);
    light.a = to_float4(corners[0].position);
    light.b = to_float4(e1);
    light.c = to_float4(e2);
    world_.emitters.push_back(light);
  }

  void add_triangles(const Object& object) {
    const std::size_t count =
        object.shape == Shape3::mesh ? scene_.meshes[static_cast<std::size_t>(object.mesh)].triangles() : 0;
    world_.tree.triangles.reserve(world_.tree.triangles.size() + count);
    world_.attributes.reserve(world_.attributes.size() + count);
    visit_triangles(scene_, object, [&](const TriangleCorner(&corners)[3], bool smooth) {
      add_triangle(object, corners, smooth);
      return true;
    });
  }

  /// Spheres, planes, disks and revolved curves.
  void add_shape(const Object& object) {
    causticl::Shape shape{};
    shape.material = materials_[index_];
    Transform transform = object.transform;
    Bounds bounds;
    double area = 0;
    Emitter light{};
    switch (object.shape) {
      case Shape3::sphere: {
        // The format allows only uniform scales here: every axis is scaled alike.
        const double radius = object.radius * std::cbrt(std::fabs(transform.determinant()));
        shape.type = SHAPE_SPHERE;
        shape.sphere = to_float4(transform.translation, radius);
        const Vec3 r{radius, radius, radius};
        bounds = make_bounds(transform.translation - r, transform.translation + r);
        area = 4 * std::numbers::pi * radius * radius;
        light = emitter(object, EMITTER_SPHERE, area);
        light.a = shape.sphere;
        break;
      }
      case Shape3::plane:
        shape.type = SHAPE_PLANE;
        break;
      case Shape3::disk: {
        shape.type = SHAPE_DISK;
        transform = Transform::scale({object.radius, object.radius, object.radius}).followed_by(transform);
        const Vec3 x = transform.vector({1, 0, 0}), y = transform.vector({0, 1, 0});
        Vec3 reach;
        for (int axis = 0; axis < 3; ++axis) reach[axis] = std::hypot(x[axis], y[axis]);
        bounds = make_bounds(transform.translation - reach, transform.translation + reach);
        area = std::numbers::pi * length(cross(x, y));
        light = emitter(object, EMITTER_DISK, area);
        light.a = to_float4(transform.translation);
        light.b = to_float4(x);
        // The emitting side is local +z, which a mirroring transform puts on the other side of x cross y.
        light.c = to_float4(transform.determinant() < 0 ? -y : y);
        break;
      }
      default: {
        shape.type = SHAPE_BEZIER;
        const auto points = near_points(object, transform);
        shape.degree = static_cast<uint>(points.size() - 1);
        shape.curve = static_cast<uint>(world_.curves.size());
        const auto data = curve_data(points);
        world_.curves.insert(world_.curves.end(), data.begin(), data.end());
        const CurveBounds local = curve_bounds(points);
        bounds = transformed_bounds(local.low, local.high, transform);
        if (emissive(object)) {
          const auto table = curve_area_table(points, EMITTER_AREA_STEPS);
          shape.area_table =
              static_cast<uint>(world_.curves.size()) + 2;  // past the number of steps and the area
          world_.curves.insert(world_.curves.end(), table.begin(), table.end());
          // The world's area where the scale is uniform; elsewhere kernels only need it to be the same
          // throughout.
          area = table[1] * std::pow(std::fabs(transform.determinant()), 2.0 / 3.0);
          shape.area = static_cast<float>(area);
        }
        light = emitter(object, EMITTER_BEZIER, area);
        light.first_area = shape.area_table;
        light.shape = static_cast<uint>(world_.shapes.size());
      }
    }
    store_rows(transform, shape.to_world);
    store_rows(transform.inverse(), shape.to_local);
    if (object.shape != Shape3::plane)
      world_.tree.shapes.push_back({bounds, static_cast<uint>(world_.shapes.size())});
    if (area > 0 && emissive(object)) world_.emitters.push_back(light);
    world_.shapes.push_back(shape);
  }

  /// The control points of a revolved curve. Where they lie far along the axis, they are brought near the
  /// local origin, and the transform takes them back, so that floats keep the curve's digits.
  static std::vector<std::array<double, 2>> near_points(const Object& object, Transform& transform) {
    constexpr double far = 64;  // times the curve's own size
    auto points = object.points;
    double low = points[0][1], high = low, radius = 0;
    for (const auto& [r, height] : points) {
      low = std::min(low, height);
      high = std::max(high, height);
      radius = std::max(radius, std::fabs(r));
    }
    const double middle = 0.5 * (low + high);
    if (std::fabs(middle) <= far * std::max(radius, high - low)) return points;
    for (auto& point : points) point[1] -= middle;
    transform = Transform::shift({0, middle, 0}).followed_by(transform);
    return points;
  }

  static Bounds make_bounds(Vec3 low, Vec3 high) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
      // Outward, so that rounding to float never cuts the shape.
      bounds.low[axis] = std::nextafter(static_cast<float>(low[axis]), -INFINITY);
      bounds.high[axis] = std::nextafter(static_cast<float>(high[axis]), INFINITY);
    }
    return bounds;
  }

  static Bounds transformed_bounds(Vec3 local_low, Vec3 local_high, const Transform& transform) {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = (corner >> axis & 1) ? local_high[axis] : local_low[axis];
      p = transform.point(p);
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
    return make_bounds(low, high);
  }
};

}  // namespace

std::size_t bounded_primitives(const Scene& scene) {
  std::size_t count = 0;
  for (const auto& object : scene.objects) switch (object.shape) {
      case Shape3::plane:
        break;
      case Shape3::mesh:
        count += scene.meshes[object.mesh].triangles();
        break;
      case Shape3::rectangle:
        count += 2;
        break;
      case Shape3::box:
        count += 12;
        break;
      default:
        count += 1;
    }
  return count;
}

FlatScene flatten_scene(const Scene& scene, double time, const Dielectrics& dielectrics) {
  return SceneFlattener(scene, time, dielectrics).build();
}

}  // namespace causticl
