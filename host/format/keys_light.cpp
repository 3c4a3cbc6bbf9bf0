// The tables of the entries of `lights`.
#include "format/scene_keys.hpp"
#include "scene/scene.hpp"

namespace causticl {
namespace {

using namespace types;

constexpr NumberRange cone_angle{0.01, 180, "degrees from 0.01 to 180, of the whole cone"};
constexpr NumberRange rotation_angle{-1e6, 1e6, "degrees from -1e6 to 1e6"};

const SceneTable& point_keys() {
  static const SceneTable table{
      "light_point",
      "point",
      "light that shines from a point",
      {{"position", vector(), required, "where it stands", "scene units"},
       {"intensity", color(non_negative_number), required, "radiant intensity", "power per solid angle"}}};
  return table;
}

const SceneTable& spot_keys() {
  static const SceneTable table{
      "light_spot",
      "spot",
      "light that shines from a point into a cone",
      {{"position", vector(), required, "apex of the cone", "scene units"},
       {"target", vector(), required, "a point of its axis, other than the position", "scene units"},
       {"angle", number(cone_angle), required, "angle of the whole cone", "degrees"},
       {"blend", fraction(unit_number), DeltaLight{}.blend,
        "fraction of the half angle, from the edge inward, over which the light falls off"},
       {"intensity", color(non_negative_number), required, "radiant intensity on the axis",
        "power per solid angle"}}};
  return table;
}

const SceneTable& directional_keys() {
  static const SceneTable table{
      "light_directional",
      "directional",
      "light from infinitely far, as the sun's",
      {{"direction", vector(), required, "in which light travels; not 0"},
       {"irradiance", color(non_negative_number), required, "of a surface across it", "power per area"}}};
  return table;
}

const SceneTable& disk_keys() {
  static const SceneTable table{"light_disk",
                                "disk",
                                "black disk that emits; the camera sees it",
                                {{"position", vector(), required, "centre", "scene units"},
                                 {"normal", vector(), required, "the side that emits; not 0"},
                                 {"radius", number(positive_number), required, "radius", "scene units"},
                                 {"radiance", color(non_negative_number), required, "emitted radiance",
                                  "power per area and solid angle"}}};
  return table;
}

const SceneTable& environment_keys() {
  static const SceneTable table{
      "light_environment",
      "environment",
      "light from all directions; one at most",
      {{"path", file(), optional, "image: a map of latitude and longitude; its upper edge is +y"},
       {"radiance", color(non_negative_number), optional, "the same from everywhere",
        "power per area and solid angle"},
       {"rotation", number(rotation_angle), Environment{}.rotation, "about +y", "degrees"}},
      {{KeyRule::Relation::one_of, "path", "radiance", "", ""}}};
  return table;
}

}  // namespace

ValueType light_type() {
  return object("light", {&point_keys, &spot_keys, &directional_keys, &disk_keys, &environment_keys});
}

}  // namespace causticl
