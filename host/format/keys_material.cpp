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
  return {"color", either({color(unit_number), color_texture_type()}), MaterialSpec{}.color,
          "reflectance; of glass a tint at every crossing"};
}

SceneKey ior_key() {
  return {"ior", number(refractive_index), Absent::Described{"the scene's \"Ng\""},
          "index of refraction inside"};
}

SceneKey roughness_key() {
  return {"roughness", number(unit_number), MaterialSpec{}.roughness,
          "square root of the GGX width alpha; 0 is perfectly smooth"};
}

/// The rows of `first`, those of every material, and the rows of `last`.
std::vector<SceneKey> with_emission(std::vector<SceneKey> first, const std::vector<SceneKey>& last = {}) {
  first.push_back({"emission", color(non_negative_number), 0, "emitted radiance: the surface is a light"});
  first.push_back(
      {"two_sided", boolean(), MaterialSpec{}.two_sided, "emits on both sides, not on the front alone"});
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

const SceneTable& diffuse_keys() {
  static const SceneTable table{"material_diffuse", "diffuse", "Lambert surface",
                                with_emission({color_key()})};
  return table;
}

const SceneTable& mirror_keys() {
  static const SceneTable table{"material_mirror", "mirror", "perfect mirror", with_emission({color_key()})};
  return table;
}

const SceneTable& glass_keys() {
  static const SceneTable table{
      "material_glass",
      "glass",
      "dielectric, smooth or rough, that may absorb and disperse",
      with_emission(
          {color_key()},
          {ior_key(),
           {"cauchy",
            tuple("numbers, A and B of the index A + B / wavelength^2", {number(cauchy_a), number(cauchy_b)}),
            optional, "dispersion: index A + B / wavelength^2", "square micrometres"},
           {"absorption", color(non_negative_number), 0, "light keeps exp(-absorption distance) inside",
            "per unit length"},
           roughness_key(),
           {"priority", integer(-1000000, 1000000), MaterialSpec{}.priority,
            "where dielectrics overlap, the higher one fills the place"}}),
      {{KeyRule::Relation::not_both, "ior", "cauchy", "cauchy", "expected \"ior\" or \"cauchy\", got both"}}};
  return table;
}

const SceneTable& conductor_keys() {
  static const SceneTable table{
      "material_conductor", "conductor", "metal, smooth or rough",
      with_emission(
          {{"eta", color(refractive_index), required, "real part of the index of refraction"},
           {"k", color(extinction_coefficient), required, "imaginary part of the index of refraction"}},
          {roughness_key()})};
  return table;
}

const SceneTable& plastic_keys() {
  static const SceneTable table{"material_plastic", "plastic",
                                "coated diffuse: a dielectric boundary, smooth or rough, over a Lambert base",
                                with_emission({color_key()}, {ior_key(), roughness_key()})};
  return table;
}

}  // namespace

ValueType material_type() {
#define KEYS_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties) &name##_keys,
  return object("material", {MATERIAL_TABLE(KEYS_OF_ROW, )});
#undef KEYS_OF_ROW
}

}  // namespace causticl
