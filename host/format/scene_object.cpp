// The entries of `objects`.
#include "format/shape_keys.hpp"
#include "scene/integrators.hpp"
#include "scene/material_kind.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

/// By the function of its shape.
void read_own_keys(const SceneObject& json, Object& object, SceneLoader& loader) {
  switch (object.shape) {
#define READ_SHAPE(x, NAME, number, name, type, effect, points) READ(name)
#define READ_TRIANGLES(x, name, type) READ(name)
#define READ(name)          \
  case Object::Shape::name: \
    return read_##name(json, object, loader);
    SHAPE_TABLE(READ_SHAPE, )
    TRIANGLE_SHAPE_TABLE(READ_TRIANGLES, )
#undef READ
#undef READ_SHAPE
#undef READ_TRIANGLES
  }
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
  object.shape = static_cast<Object::Shape>(json.type());
  if (const auto transform = json.find("transform")) object.transform = read_transform(*transform);
  if (const auto motion = json.find("motion")) object.motion = motion->object().vector("shift");

  read_own_keys(json, object, loader);

  if (const auto texture = json.find("texture"))
    object.material = read_base_texture(*texture, object.shape, loader);
  else
    object.material = read_material_of(json.at("material"), loader);

  if (object.mesh >= 0) prepare_mesh(json, object, loader);
  const Scene& scene = loader.scene;
  const MaterialSpec& material = scene.materials[static_cast<std::size_t>(object.material)];
  if (is_infinite(object) && max_component(material.emission) > 0 &&
      traces_photons(scene.renderer.integrator))
    json.fail("an infinite light has no power to emit; use a rectangle or the integrator \"pt\"");
  loader.scene.objects.push_back(object);
}

}  // namespace causticl
