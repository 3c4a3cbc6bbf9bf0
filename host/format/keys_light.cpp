// The tables of the entries of `lights`.
#include "format/scene_keys.hpp"
#include "scene/light_kind.hpp"

namespace causticl {
namespace {

using namespace types;

constexpr NumberRange cone_angle{0.01, 180, "degrees from 0.01 to 180, of the whole cone"};
constexpr NumberRange rotation_angle{-1e6, 1e6, "degrees from -1e6 to 1e6"};
constexpr const char* radiance_unit = "power per area and solid angle";

const SceneTable& radiance_image_table() {
  static const SceneTable table{
      "radiance_image",
      "image",
      "image as radiance: texels are constant",
      {{"path", file(), required, "any image; of floats, or decoded to linear RGB"},
       {"scale", color(non_negative_number), 1, "radiance of a texel that is 1", radiance_unit}}};
  return table;
}

ValueType radiance_image_type() { return object("radiance_image", {&radiance_image_table}); }

/// A light's table: the keys that its row of LIGHT_TABLE has.
SceneTable table_of(const LightRow& light) {
  std::vector<SceneKey> rows;
  std::vector<KeyRule> rules;
  const auto add = [&](unsigned key, const SceneKey& row) {
    if ((light.keys & key) != 0) rows.push_back(row);
  };
  add(POSITION_KEY,
      {"position", vector(), required, "where it stands; of a surface the centre", "scene units"});
  add(TARGET_KEY,
      {"target", vector(), required, "a point of its axis, other than the position", "scene units"});
  add(NORMAL_KEY, {"normal", vector(), required, "the side that emits; not 0"});
  add(UP_KEY, {"up", vector(), optional, "where its upper edge lies; +y, or -z where it faces up or down"});
  add(SIZE_KEY,
      {"size", tuple("lengths, width and height", {number(positive_number), number(positive_number)}),
       required, "width and height", "scene units"});
  add(RADIUS_KEY, {"radius", number(positive_number), required, "radius", "scene units"});
  add(CONE_KEY, {"angle", number(cone_angle), required, "angle of the whole cone", "degrees"});
  add(CONE_KEY, {"blend", fraction(unit_number), LightSpec{}.blend,
                 "fraction of the half angle, from the edge inward, over which the light falls off"});
  add(INTENSITY_KEY, {"intensity", color(non_negative_number), required,
                      "radiant intensity; of a spot on its axis", "power per solid angle"});
  add(DIRECTION_KEY, {"direction", vector(), required, "in which light travels; not 0"});
  add(IRRADIANCE_KEY,
      {"irradiance", color(non_negative_number), required, "of a surface across it", "power per area"});
  add(RADIANCE_KEY, {"radiance", color(non_negative_number), required, "emitted radiance", radiance_unit});
  add(IMAGE_KEY, {"radiance", either({color(non_negative_number), radiance_image_type()}), required,
                  "emitted radiance: one, or an image", radiance_unit});
  add(TWO_SIDED_KEY,
      {"two_sided", boolean(), MaterialSpec{}.two_sided, "emits on both sides, not on the front alone"});
  add(MAP_KEY, {"path", file(), optional, "image: a map of latitude and longitude; its upper edge is +y"});
  add(MAP_KEY, {"radiance", color(non_negative_number), optional, "the same from everywhere", radiance_unit});
  add(MAP_KEY, {"rotation", number(rotation_angle), LightSpec{}.rotation, "about +y", "degrees"});
  if ((light.keys & MAP_KEY) != 0) rules.push_back({KeyRule::Relation::one_of, "path", "radiance", "", ""});
  return {"light_" + std::string(light.name), light.name, light.description, rows, rules};
}

#define TABLE_OF_LIGHT(x, NAME, number, name, ...)                           \
  const SceneTable& name##_table() {                                         \
    static const SceneTable table = table_of(row_of(LightSpec::Kind::name)); \
    return table;                                                            \
  }
LIGHT_TABLE(TABLE_OF_LIGHT, )
#undef TABLE_OF_LIGHT

}  // namespace

ValueType light_type() {
#define ADD_LIGHT(x, NAME, number, name, ...) &name##_table,
  return object("light", {LIGHT_TABLE(ADD_LIGHT, )});
#undef ADD_LIGHT
}

}  // namespace causticl
