// The tables of the entries of `objects`: what all shapes have.
#include "format/shape_keys.hpp"
#include "scene/shape_kind.hpp"

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

}  // namespace

SceneTable shape_table(Object::Shape shape, const char* description, std::vector<SceneKey> own) {
  std::vector<SceneKey> keys{
      {"transform", list(0, SIZE_MAX, "transforms", transform_step_type()), optional,
       "from local coordinates to the world; steps apply in the listed order"},
      {"motion", object("motion", {&motion_keys}), optional, "what it moves by while the shutter is open"},
      {"texture", base_texture_type(), optional, "base format; in place of \"material\""},
      {"material", either({string(), material_type()}), optional, "name of a material, or a material"}};
  keys.insert(keys.end(), own.begin(), own.end());
  return {std::string("object_") + name_of(shape),
          name_of(shape),
          description,
          keys,
          {{KeyRule::Relation::one_of, "material", "texture", "material", ""}}};
}

ValueType object_type() {
#define KEYS_OF_SHAPE(x, NAME, number, name, type, effect, points) &name##_keys,
#define KEYS_OF_TRIANGLES(x, name, type) &name##_keys,
  return object("object", {SHAPE_TABLE(KEYS_OF_SHAPE, ) TRIANGLE_SHAPE_TABLE(KEYS_OF_TRIANGLES, )});
#undef KEYS_OF_SHAPE
#undef KEYS_OF_TRIANGLES
}

}  // namespace causticl
