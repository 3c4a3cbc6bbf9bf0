#include "world/flat_scene.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "scene/float4.hpp"
#include "scene/shape_kind.hpp"
#include "world/emitters.hpp"

namespace causticl {
namespace {

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
      if (is_infinite(scene_.objects[index_])) add_shape(placed(scene_.objects[index_]));
    world_.plane_count = static_cast<uint>(world_.shapes.size());
    for (index_ = 0; index_ < scene_.objects.size(); ++index_) {
      const Object object = placed(scene_.objects[index_]);
      if (is_infinite(object)) continue;
      if (is_made_of_triangles(object))
        add_triangles(object);
      else
        add_shape(object);
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
    return material(object).light < 0 && static_cast<float>(max_component(material(object).emission)) > 0;
  }

  /// Of type and place alone: that of the object.
  Emitter emitter(const Object& object, Emitter result, double area) const {
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
    Emitter light{};
    light.type = EMITTER_TRIANGLE;
    light.a = to_float4(corners[0].position);
    light.b = to_float4(e1);
    light.c = to_float4(e2);
    world_.emitters.push_back(emitter(object, light, area));
  }

  void add_triangles(const Object& object) {
    const std::size_t count = kind_of(object).triangles(scene_, object);
    world_.tree.triangles.reserve(world_.tree.triangles.size() + count);
    world_.attributes.reserve(world_.attributes.size() + count);
    visit_triangles(scene_, object, [&](const TriangleCorner(&corners)[3], bool smooth) {
      add_triangle(object, corners, smooth);
      return true;
    });
  }

  /// What is a primitive of its own.
  void add_shape(const Object& object) {
    ShapePrimitive primitive = kind_of(object).primitive(object, emissive(object));
    const auto index = static_cast<uint>(world_.shapes.size());
    causticl::Shape shape = primitive.shape;
    shape.material = materials_[index_];
    shape.curve += static_cast<uint>(world_.curves.size());
    shape.area_table += static_cast<uint>(world_.curves.size());
    world_.curves.insert(world_.curves.end(), primitive.curves.begin(), primitive.curves.end());
    if (!primitive.bounds.empty()) world_.tree.shapes.push_back({rounded_outward(primitive.bounds), index});
    if (primitive.area > 0 && emissive(object)) {
      Emitter light = emitter(object, primitive.emitter, primitive.area);
      light.shape = index;
      world_.emitters.push_back(light);
    }
    world_.shapes.push_back(shape);
  }

  /// Outward, so that rounding to float never cuts the shape.
  static Bounds rounded_outward(const BoundingBox& box) {
    Bounds bounds;
    for (int axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = std::nextafter(static_cast<float>(box.low[axis]), -INFINITY);
      bounds.high[axis] = std::nextafter(static_cast<float>(box.high[axis]), INFINITY);
    }
    return bounds;
  }
};

}  // namespace

std::size_t bounded_primitives(const Scene& scene) {
  std::size_t count = 0;
  for (const auto& object : scene.objects)
    if (!is_infinite(object))
      count += is_made_of_triangles(object) ? kind_of(object).triangles(scene, object) : 1;
  return count;
}

FlatScene flatten_scene(const Scene& scene, double time, const Dielectrics& dielectrics) {
  return SceneFlattener(scene, time, dielectrics).build();
}

}  // namespace causticl
