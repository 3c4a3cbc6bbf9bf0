// The tables of materials.
#include "format/scene_keys.hpp"
#include "scene/scene.hpp"
#include "shared/materials.h"

namespace causticl {
namespace {

using namespace types;

constexpr NumberRange cauchy_a{1, 100, "an index A from 1 to 100"};
constexpr NumberRange cauchy_b{0, 1, "B from 0 to 1 square micrometre"};

SceneKey color_key() {
  return {
      "color", either({color(unit_number), color_texture_type()}), MaterialSpec{}.color,
      "reflectance; of glass a tint at every crossing; of thin glass what one way through the inside leaves"};
}

SceneKey ior_key() {
  return {"ior", number(refractive_index), Absent::Described{"the scene's \"Ng\""},
          "index of refraction inside"};
}

SceneKey roughness_key() {
  return {"roughness", number(unit_number), MaterialSpec{}.roughness,
          "square root of the GGX width alpha; 0 is perfectly smooth"};
}

SceneKey cauchy_key() {
  return {"cauchy",
          tuple("numbers, A and B of the index A + B / wavelength^2", {number(cauchy_a), number(cauchy_b)}),
          optional, "dispersion: index A + B / wavelength^2", "square micrometres"};
}

/// A material's table: the keys that its row of MATERIAL_TABLE has, and those of every material.
SceneTable table_of(const std::string& name, const std::string& text, unsigned keys) {
  std::vector<SceneKey> rows;
  std::vector<KeyRule> rules;
  const auto add = [&](unsigned key, const SceneKey& row) {
    if ((keys & key) != 0) rows.push_back(row);
  };
  add(KEY_COLOR, color_key());
  add(KEY_ETA_K, {"eta", color(refractive_index), required, "real part of the index of refraction"});
  add(KEY_ETA_K, {"k", color(extinction_coefficient), required, "imaginary part of the index of refraction"});
  rows.push_back({"emission", color(non_negative_number), 0, "emitted radiance: the surface is a light"});
  rows.push_back(
      {"two_sided", boolean(), MaterialSpec{}.two_sided, "emits on both sides, not on the front alone"});
  add(KEY_IOR, ior_key());
  add(KEY_CAUCHY, cauchy_key());
  add(KEY_ABSORPTION, {"absorption", color(non_negative_number), 0,
                       "light keeps exp(-absorption distance) inside", "per unit length"});
  add(KEY_ROUGHNESS, roughness_key());
  add(KEY_DIFFUSE_ROUGHNESS, {"diffuse_roughness", number(unit_number), MaterialSpec{}.diffuse_roughness,
                              "roughness r of the model EON; 0 is Lambert"});
  add(KEY_PRIORITY, {"priority", integer(-1000000, 1000000), MaterialSpec{}.priority,
                     "where dielectrics overlap, the higher one fills the place"});
  if ((keys & KEY_CAUCHY) != 0)
    rules.push_back(
        {KeyRule::Relation::not_both, "ior", "cauchy", "cauchy", "expected \"ior\" or \"cauchy\", got both"});
  return {"material_" + name, name, text, rows, rules};
}

#define TABLE_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, keys, text) \
  const SceneTable& name##_table() {                                                                \
    static const SceneTable table = table_of(#name, text, keys);                                    \
    return table;                                                                                   \
  }
MATERIAL_TABLE(TABLE_OF_ROW, )
#undef TABLE_OF_ROW

}  // namespace

ValueType material_type() {
#define ADD_ROW(x, NAME, number, name, ...) &name##_table,
  return object("material", {MATERIAL_TABLE(ADD_ROW, )});
#undef ADD_ROW
}

}  // namespace causticl
