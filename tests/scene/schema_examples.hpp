// A scene for every table of the format.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "format/scene_keys.hpp"
#include "schema_validator.hpp"

namespace causticl {

using Json = nlohmann::ordered_json;

/// Where an object of a table stands in a scene, and one that holds what is required.
struct TableExample {
  std::string pointer, object;
};

inline const Json& example_scene() {
  static const Json scene = parse_scene(R"({
    "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "fov": 40},
    "materials": {"white": {"type": "diffuse"}},
    "objects": [{"type": "sphere", "radius": 1, "material": "white"}],
    "lights": [{"type": "point", "position": [0, 5, 0], "intensity": 1}]})");
  return scene;
}

/// By the name of the table.
inline const std::map<std::string, TableExample>& table_examples() {
  static const std::map<std::string, TableExample> examples{
      {"scene", {"", example_scene().dump()}},
      {"medium", {"/medium", "{}"}},
      {"camera_target", {"/camera", R"({"position": [0, 1, 5], "target": [0, 0, 0], "fov": 40})"}},
      {"camera_direct", {"/camera", R"({"origin": [0, 1, 5], "direct": [0, 0, -1], "view_angle_scale": 1})"}},
      {"renderer", {"/renderer", R"({"light_pos": [0, 5, 0], "light_r": 1})"}},
      {"motion", {"/objects/0/motion", R"({"shift": [1, 0, 0]})"}},
      {"object_sphere", {"/objects/0", R"({"type": "sphere", "radius": 1, "material": "white"})"}},
      {"object_plane", {"/objects/0", R"({"type": "plane", "material": "white"})"}},
      {"object_rectangle", {"/objects/0", R"({"type": "rectangle", "material": "white"})"}},
      {"object_cylinder", {"/objects/0", R"({"type": "cylinder", "height": 2, "material": "white"})"}},
      {"object_disk", {"/objects/0", R"({"type": "disk", "material": "white"})"}},
      {"object_box", {"/objects/0", R"({"type": "box", "material": "white"})"}},
      {"object_mesh", {"/objects/0", R"({"type": "mesh", "path": "flat.obj", "material": "white"})"}},
      {"object_bezier_rotate",
       {"/objects/0", R"({"type": "bezier_rotate", "point": [[1, 0], [1, 1]], "material": "white"})"}},
      {"transform_shift", {"/objects/0/transform/0", R"({"type": "shift"})"}},
      {"transform_scale", {"/objects/0/transform/0", R"({"type": "scale"})"}},
      {"transform_rotate", {"/objects/0/transform/0", R"({"type": "rotate", "axis": "x", "degree": 1})"}},
      {"transform_rotateradian",
       {"/objects/0/transform/0", R"({"type": "rotateradian", "axis": [1, 1, 0], "radian": 1})"}},
      {"transform_matrix",
       {"/objects/0/transform/0",
        R"({"type": "matrix", "values": [1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1]})"}},
      {"material_diffuse", {"/materials/white", R"({"type": "diffuse"})"}},
      {"material_mirror", {"/materials/white", R"({"type": "mirror"})"}},
      {"material_glass", {"/materials/white", R"({"type": "glass"})"}},
      {"material_conductor", {"/materials/white", R"({"type": "conductor", "eta": 1, "k": 3})"}},
      {"material_plastic", {"/materials/white", R"({"type": "plastic"})"}},
      {"material_thin_glass", {"/materials/white", R"({"type": "thin_glass"})"}},
      {"material_oren_nayar", {"/materials/white", R"({"type": "oren_nayar"})"}},
      {"texture_image", {"/materials/white/color", R"({"type": "image", "path": "5x4.png"})"}},
      {"texture_checker", {"/materials/white/color", R"({"type": "checker", "a": 0, "b": [1, 1, 1]})"}},
      {"base_texture_raw", {"/objects/1/texture", R"({"type": "raw", "color": 1, "material": "diffuse"})"}},
      {"base_texture_image",
       {"/objects/1/texture", R"({"type": "image", "path": "5x4.png", "material": "specular"})"}},
      {"light_point", {"/lights/0", R"({"type": "point", "position": [0, 5, 0], "intensity": 1})"}},
      {"light_spot", {"/lights/0", R"({"type": "spot", "position": [0, 5, 0], "target": [0, 0, 0],
                                       "angle": 30, "intensity": 1})"}},
      {"light_directional",
       {"/lights/0", R"({"type": "directional", "direction": [0, -1, 0], "irradiance": 1})"}},
      {"light_disk", {"/lights/0", R"({"type": "disk", "position": [0, 5, 0], "normal": [0, -1, 0],
                                       "radius": 1, "radiance": 1})"}},
      {"light_rectangle", {"/lights/0", R"({"type": "rectangle", "position": [0, 5, 0], "normal": [0, -1, 0],
                                            "size": [2, 1], "radiance": 1})"}},
      {"radiance_image", {"/lights/1/radiance", R"({"type": "image", "path": "5x4.png"})"}},
      {"light_environment", {"/lights/0", R"({"type": "environment", "radiance": 1})"}},
  };
  return examples;
}

/// The example scene with `object` at a JSON pointer.
inline Json scene_with(const std::string& pointer, const Json& object) {
  Json scene = example_scene();
  if (pointer.rfind("/objects/1", 0) == 0) scene["objects"][1] = {{"type", "box"}};
  if (pointer.rfind("/lights/1/", 0) == 0)
    scene["lights"][1] = Json::parse(table_examples().at("light_rectangle").object);
  scene[Json::json_pointer(pointer)] = object;
  return scene;
}

/// All tables that hang from `type`, by name.
inline void collect_tables(const ValueType& type, std::map<std::string, const SceneTable*>& tables) {
  for (const ValueType& part : type.parts) collect_tables(part, tables);
  for (const TableFunction function : type.tables)
    if (tables.emplace(function().name, &function()).second)
      for (const SceneKey& key : function().keys) collect_tables(key.type, tables);
}

inline std::map<std::string, const SceneTable*> all_tables() {
  std::map<std::string, const SceneTable*> tables;
  collect_tables(types::object("scene", {&scene_keys}), tables);
  return tables;
}

}  // namespace causticl
