// The entries of `objects`.
#include <algorithm>
#include <cmath>

#include "format/scene_loader.hpp"
#include "scene/material_kind.hpp"

namespace causticl {
namespace {

using Shape = Object::Shape;

// A sphere stays one under rotations, mirrors and one factor for all axes.
bool scales_uniformly(const Transform& transform) {
  const auto& [a, b, c] = transform.rows;
  const double s = dot(a, a), tolerance = 1e-6 * s;
  return std::abs(dot(b, b) - s) <= tolerance && std::abs(dot(c, c) - s) <= tolerance &&
         std::abs(dot(a, b)) <= tolerance && std::abs(dot(b, c)) <= tolerance &&
         std::abs(dot(c, a)) <= tolerance;
}

// Whether the polynomial with these Bernstein coefficients is below -tolerance somewhere in [0, 1]: it stays
// within the hull of its coefficients, so halve the interval (de Casteljau) until they decide.
bool goes_below_zero(const std::vector<double>& coefficients, double tolerance, int halvings = 20) {
  if (*std::min_element(coefficients.begin(), coefficients.end()) >= -tolerance) return false;
  if (std::min(coefficients.front(), coefficients.back()) < -tolerance) return true;
  if (halvings == 0) return false;
  std::vector<double> first, last = coefficients;
  for (std::size_t n = coefficients.size(); n > 0; --n) {
    first.push_back(last[0]);
    for (std::size_t i = 0; i + 1 < n; ++i) last[i] = (last[i] + last[i + 1]) / 2;
  }
  return goes_below_zero(first, tolerance, halvings - 1) || goes_below_zero(last, tolerance, halvings - 1);
}

// One Bezier curve (radius, height) of degree up to 16. Control points may lie across the axis, the curve may
// not: its surface would be turned inside out there.
std::vector<std::array<double, 2>> read_points(const SceneValue& json) {
  std::vector<std::array<double, 2>> points;
  std::vector<double> radii;
  bool distinct = false;
  double largest = 0;
  for (const SceneValue& item : json.items()) {
    const auto xy = item.items();
    points.push_back({xy[0].number(), xy[1].number()});
    radii.push_back(points.back()[0]);
    largest = std::max(largest, std::abs(radii.back()));
    distinct |= points.back() != points.front();
  }
  if (largest < positive_number.low)
    json.fail("expected a control point off the axis, got a curve of radius 0");
  if (!distinct) json.fail("expected control points that differ, got one point");
  if (goes_below_zero(radii, 1e-9 * largest))
    json.fail("expected a curve whose radius is nowhere negative, got one that crosses the axis");
  return points;
}

void read_mesh_keys(const SceneObject& json, Object& object, SceneLoader& loader) {
  if (const auto tree = json.find("tree_type"))
    if (tree->choice() != 0)
      loader.notice(*tree, "every mesh is put into the KD-tree; \"tree_type\" is ignored");
  object.mesh = loader.mesh(json.at("path"));
  // A file without normals is drawn as the flat faces it has, unless smoothing is asked for.
  const Mesh& mesh = loader.scene.meshes[static_cast<std::size_t>(object.mesh)];
  object.smooth = json.boolean("smooth", mesh.has_normals);
}

// What the mesh of an object has to be for its material.
void prepare_mesh(const SceneObject& json, Object& object, SceneLoader& loader) {
  const MaterialSpec& material = loader.scene.materials[static_cast<std::size_t>(object.material)];
  if (bounds_body(material)) object.mesh = loader.mesh_of_glass(json, object.mesh);
  Mesh& mesh = loader.scene.meshes[static_cast<std::size_t>(object.mesh)];
  if (object.smooth && json.has("smooth")) add_missing_normals(mesh);
  if (material.color_texture >= 0 && mesh.uvs.empty())
    loader.notice(json, "the mesh has no (u, v): its texture shows the one texel at (0, 0)");
}

}  // namespace

void read_object(const SceneValue& value, SceneLoader& loader) {
  const SceneObject json = value.object();
  Object object;
  object.pointer = json.pointer();
  object.shape = static_cast<Shape>(json.type());
  if (const auto transform = json.find("transform")) object.transform = read_transform(*transform);
  if (const auto motion = json.find("motion")) object.motion = motion->object().vector("shift");

  switch (object.shape) {
    case Shape::sphere:
      object.radius = json.number("radius");
      if (!scales_uniformly(object.transform))
        json.at("transform")
            .fail("expected one factor for x, y and z, got a scale that makes the sphere an ellipsoid");
      break;
    case Shape::disk:
      object.radius = json.number("radius");
      break;
    case Shape::box:
      object.size = json.vector("size");
      break;
    case Shape::mesh:
      read_mesh_keys(json, object, loader);
      break;
    case Shape::bezier:
      object.points = read_points(json.at("point"));
      break;
    default:
      break;
  }

  if (const auto texture = json.find("texture"))
    object.material = read_base_texture(*texture, object.shape, loader);
  else
    object.material = read_material_of(json.at("material"), loader);

  if (object.shape == Shape::mesh) prepare_mesh(json, object, loader);
  const Scene& scene = loader.scene;
  const MaterialSpec& material = scene.materials[static_cast<std::size_t>(object.material)];
  if (object.shape == Shape::plane && max_component(material.emission) > 0 &&
      scene.renderer.integrator == Integrator::sppm)
    json.fail("an infinite light has no power to emit; use a rectangle or the integrator \"pt\"");
  loader.scene.objects.push_back(object);
}

}  // namespace causticl
