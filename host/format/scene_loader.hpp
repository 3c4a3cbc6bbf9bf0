// The parts of load_scene, one concept a file (scene_*.cpp).
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include "format/scene_value.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// The scene under construction, and what has been loaded for it.
struct SceneLoader {
  Scene scene;
  double glass_ior = 0;                                // key `Ng`
  std::map<std::string, int> named_materials;          // into scene.materials
  std::map<std::pair<std::string, bool>, int> images;  // resolved path and srgb, into scene.images
  std::map<std::string, int> meshes;                   // resolved path, into scene.meshes
  std::map<int, int> turned_meshes;                    // of those that are glass: the one to take
  std::set<std::string> said;                          // texts of notices so far
  ImageLimits image_limits;                            // what is left for further images

  /// Tells the user `text`, with the place where it came up first.
  void notice(const SceneNode& where, const std::string& text);
  /// Tells the user what was found in a file.
  void file_notes(const SceneNode& where, const std::string& file, const std::vector<std::string>& notes);
  /// Index of the image or mesh that `path` names; each file is read once.
  int image(const SceneValue& path, bool srgb);
  int mesh(const SceneValue& path);
  /// The mesh to take for a closed body of glass: where `mesh` is wound inwards, one that is turned.
  int mesh_of_glass(const SceneNode& object, int mesh);
  /// The image that `path` names as radiance: linear, as bright as it is, and black where it is none.
  Image radiance_map(const SceneValue& path);
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
