// The parts of the JSON reader, one concept a file (scene_*.cpp).
#pragma once

#include "format/scene_builder.hpp"
#include "format/scene_value.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// The scene under construction, and what of the file its parts need.
struct SceneLoader : SceneBuilder {
  double glass_ior = 0;                        // key `Ng`
  std::map<std::string, int> named_materials;  // into scene.materials
};

/// A list of shifts, scales, rotations and matrices, applied in listed order.
Transform read_transform(const SceneValue& json);

/// Either camera form; `aspect` is width / height.
CameraSpec read_camera(const SceneValue& json, double aspect);

/// The key `renderer`, without the disc light, which is an object (read_disc_light).
void read_renderer(const SceneObject& json, SceneLoader& loader);
void read_disc_light(const SceneObject& json, SceneLoader& loader);

/// The base format's `texture` on an object of this shape: a new material.
int read_base_texture(const SceneValue& json, Object::Shape shape, SceneLoader& loader);
/// The table `materials`.
void read_named_materials(const SceneValue& json, SceneLoader& loader);
/// The key `material` of an object: the name of one, or a new one.
int read_material_of(const SceneValue& json, SceneLoader& loader);

/// One entry of `objects`, appended to the scene.
void read_object(const SceneValue& json, SceneLoader& loader);

/// The key `lights`. After the objects, since photons from beyond the scene cannot reach all of an infinite
/// plane.
void read_lights(const SceneValue& json, SceneLoader& loader);

}  // namespace causticl
