// Parts of the small scenes that checks render: made in code, so that the shipped binary needs no files.
#pragma once

#include <algorithm>
#include <cmath>

#include "render/render.hpp"
#include "scene/scene.hpp"
#include "selftest/selftest_check.hpp"

namespace causticl {

inline MaterialSpec make_material(MaterialSpec::Kind kind, double color, double emission = 0) {
  MaterialSpec material;
  material.kind = kind;
  material.color = {color, color, color};
  material.emission = {emission, emission, emission};
  return material;
}

inline Object make_object(Object::Shape shape, const Transform& transform, int material) {
  Object object;
  object.shape = shape;
  object.transform = transform;
  object.material = material;
  return object;
}

inline Object make_sphere(Vec3 centre, double radius, int material) {
  Object object = make_object(Object::Shape::sphere, Transform::shift(centre), material);
  object.radius = radius;
  return object;
}

inline Object make_mesh_object(int mesh, const Transform& transform, int material) {
  Object object = make_object(Object::Shape::mesh, transform, material);
  object.mesh = mesh;
  return object;
}

/// A pinhole at `from` whose square picture spans `size` at distance 1.
inline CameraSpec make_camera(Vec3 from, Vec3 to, double size) {
  CameraSpec camera;
  camera.origin = from;
  camera.axis = normalize(to - from);
  camera.right = normalize(cross(camera.axis, {0, 1, 0})) * size;
  camera.up = normalize(cross(camera.right, camera.axis)) * size;
  return camera;
}

/// A closed torus about y of `columns` x `rows` quads, with the smooth normals that its vertices average. Few
/// quads make these normals lean far off the faces.
inline Mesh torus(int columns, int rows, double radius, double tube) {
  Mesh mesh;
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(i % columns * rows + j % rows); };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double a = 2 * std::numbers::pi * i / columns, b = 2 * std::numbers::pi * j / rows;
      const double r = radius + tube * std::cos(b);
      mesh.positions.push_back({static_cast<float>(r * std::cos(a)), static_cast<float>(tube * std::sin(b)),
                                static_cast<float>(-r * std::sin(a))});
      mesh.position_index.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.position_index.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  add_missing_normals(mesh);
  return mesh;
}

/// How a number of inputs, which are pixels times passes, is spent on `renders` pictures: more passes first,
/// then larger pictures, since every pass costs some launches.
struct RenderBudget {
  int side, passes;

  RenderBudget(std::uint64_t inputs, int renders, int smallest_side) : side(smallest_side) {
    const double each = static_cast<double>(inputs) / renders;
    while (side < 256 && each / (side * side) > 256) side *= 2;
    passes = static_cast<int>(std::clamp(each / (side * side), 1.0, 1e9));
  }

  /// Sets picture and passes; a pass of SPPM has as many photons as pixels.
  void apply(Scene& scene) const {
    scene.width = scene.height = side;
    scene.renderer.passes = scene.renderer.samples = passes;
    scene.renderer.photons = std::int64_t{side} * side;
    scene.renderer.visible_points = 1;
  }
  std::uint64_t inputs() const { return std::uint64_t{1} * side * side * passes; }
};

/// Renders with kernels for whatever any of these scenes holds: one set of programs, which take seconds each
/// to compile, serves all of them.
inline RenderResult render_for(
    CheckContext& context, const Scene& scene,
    const std::string& effects =
        "triangles,spheres,planes,disks,textures,mirror,glass,plastic,thin_glass,oren_nayar,"
        "shadow_rays,environment,aimed_photons,smooth,needles,walls") {
  RenderOptions options;
  options.effects = effects;
  options.kernel_dir = context.kernel_dir;
  options.seed = context.seed;
  options.threads = context.threads;
  return render_scene(scene, context.device, options);
}

}  // namespace causticl
