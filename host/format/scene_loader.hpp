// The parts of load_scene, one concept a file (scene_*.cpp).
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include "format/json_reader.hpp"
#include "scene/scene.hpp"

namespace causticl {

/// The scene under construction, and what has been loaded for it.
struct SceneLoader {
  Scene scene;
  double glass_ior = 1.5;                              // key `Ng`
  std::map<std::string, int> named_materials;          // into scene.materials
  std::map<std::pair<std::string, bool>, int> images;  // resolved path and srgb, into scene.images
  std::map<std::string, int> meshes;                   // resolved path, into scene.meshes
  std::map<int, int> turned_meshes;                    // of those that are glass: the one to take
  std::set<std::string> said;                          // texts of notices so far
  ImageLimits image_limits;                            // what is left for further images

  /// Tells the user `text`, with the place where it came up first.
  void notice(const JsonReader& where, const std::string& text);
  /// Tells the user what was found in a file.
  void file_notes(const JsonReader& where, const std::string& file, const std::vector<std::string>& notes);
  /// Index of the image or mesh that `path` names; each file is read once.
  int image(const JsonReader& path, bool srgb);
  int mesh(const JsonReader& path);
  /// The mesh to take for a closed body of glass: where `mesh` is wound inwards, one that is turned.
  int mesh_of_glass(const JsonReader& object, int mesh);
  /// The image that `path` names as radiance: linear, as bright as it is, and black where it is none.
  Image radiance_map(const JsonReader& path);
};

/// A vector, {"x","y","z"} or [x,y,z].
Vec3 read_vector(const JsonReader& json, const NumberRange& range = any_number);
/// The same for a key that may be absent.
Vec3 read_vector(const JsonReader& json, const std::string& key, Vec3 absent,
                 const NumberRange& range = any_number);

/// A fraction for a key that may be absent; who writes 70 for 70% is told so.
double read_fraction(const JsonReader& json, const std::string& key, double absent, const NumberRange& range);

/// A colour: a vector, or one number for all channels.
Color read_color(const JsonReader& json, const NumberRange& range);
/// The same for a key that may be absent.
Color read_color(const JsonReader& json, const std::string& key, Color absent, const NumberRange& range);

/// A list of shifts, scales, rotations and matrices, applied in listed order.
Transform read_transform(const JsonReader& json);

/// Either camera form; `aspect` is width / height.
CameraSpec read_camera(const JsonReader& json, double aspect);

/// The key `renderer`, without the disc light, which is an object (read_disc_light).
void read_renderer(const JsonReader& json, SceneLoader& loader);
void read_disc_light(const JsonReader& json, SceneLoader& loader);

/// The base format's `texture` on an object of this shape: a new material.
int read_base_texture(const JsonReader& json, Object::Shape shape, SceneLoader& loader);
/// The table `materials`.
void read_named_materials(const JsonReader& json, SceneLoader& loader);
/// The key `material` of an object: the name of one, or a new one.
int read_material_of(const JsonReader& json, SceneLoader& loader);

/// One entry of `objects`, appended to the scene.
void read_object(const JsonReader& json, SceneLoader& loader);

/// The key `lights`. After the objects, since photons from beyond the scene cannot reach all of an infinite
/// plane.
void read_lights(const JsonReader& json, SceneLoader& loader);

}  // namespace causticl
