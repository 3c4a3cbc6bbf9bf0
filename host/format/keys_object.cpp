// The tables of the entries of `objects`.
#include "format/scene_keys.hpp"
#include "scene/scene.hpp"

namespace causticl {
namespace {

using namespace types;

const SceneTable& motion_keys() {
  static const SceneTable table{"motion",
                                "",
                                "motion while the shutter is open",
                                {{"shift", vector(), required, "shift in a unit of time", "scene units"}}};
  return table;
}

SceneTable shape(const char* type, const char* description, std::vector<SceneKey> own = {}) {
  std::vector<SceneKey> keys{
      {"transform", list(0, SIZE_MAX, "transforms", transform_step_type()), optional,
       "from local coordinates to the world; steps apply in the listed order"},
      {"motion", object("motion", {&motion_keys}), optional, "what it moves by while the shutter is open"},
      {"texture", base_texture_type(), optional, "base format; in place of \"material\""},
      {"material", either({string(), material_type()}), optional, "name of a material, or a material"}};
  keys.insert(keys.end(), own.begin(), own.end());
  return {std::string("object_") + type,
          type,
          description,
          keys,
          {{KeyRule::Relation::one_of, "material", "texture", "material", ""}}};
}

const SceneTable& sphere_keys() {
  static const SceneTable table =
      shape("sphere", "sphere about the local origin; its transform scales by one factor only",
            {{"radius", number(positive_number), required, "radius", "local units"}});
  return table;
}

const SceneTable& plane_keys() {
  static const SceneTable table = shape("plane", "infinite plane z = 0");
  return table;
}

const SceneTable& rectangle_keys() {
  static const SceneTable table =
      shape("rectangle", "square in z = 0, from -1/2 to 1/2 in x and y; the front looks to +z");
  return table;
}

const SceneTable& disk_keys() {
  static const SceneTable table =
      shape("disk", "disk in z = 0 about the local origin; the front looks to +z",
            {{"radius", number(positive_number), Object{}.radius, "radius", "local units"}});
  return table;
}

const SceneTable& box_keys() {
  static const SceneTable table =
      shape("box", "box about the local origin",
            {{"size", vector(positive_number), Object{}.size, "edge lengths", "local units"}});
  return table;
}

const SceneTable& mesh_keys() {
  static const SceneTable table =
      shape("mesh", "triangles of a file",
            {{"path", file(), required, "an .obj or a .ply file"},
             {"tree_type", choice({"KDTree", "BSPTree", "MyTree"}), optional,
              "base format; every mesh goes into the KD-tree"},
             {"smooth", boolean(), Absent::Described{"true if the file has normals"},
              "shading normals: those of the file, else averaged ones; false: flat faces"}});
  return table;
}

const SceneTable& bezier_keys() {
  static const SceneTable table = shape(
      "bezier_rotate", "Bezier curve revolved about the local y axis",
      {{"point", list(2, 17, "control points", tuple("numbers, radius and height", {number(), number()})),
        required, "control points [radius, height]; the curve does not cross the axis", "local units"}});
  return table;
}

}  // namespace

ValueType object_type() {
  return object("object", {&sphere_keys, &plane_keys, &rectangle_keys, &disk_keys, &box_keys, &mesh_keys,
                           &bezier_keys});
}

}  // namespace causticl
