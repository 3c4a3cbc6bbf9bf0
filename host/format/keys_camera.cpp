// The tables of the key `camera`.
#include "format/scene_keys.hpp"
#include "scene/scene.hpp"

namespace causticl {
namespace {

using namespace types;

constexpr NumberRange field_of_view{0.001, 179.9, "degrees from 0.001 to 179.9"};
constexpr NumberRange film_height{1e-5, 1e4, "a positive number from 1e-5 to 1e4"};
constexpr NumberRange shutter_time{-1e6, 1e6, "a time from -1e6 to 1e6"};

}  // namespace

const SceneTable& target_camera_keys() {
  const CameraSpec absent;
  static const SceneTable table{
      "camera_target",
      "",
      "camera with \"position\" and \"target\"",
      {{"position", vector(), required, "where the camera stands", "scene units"},
       {"target", vector(), required, "where it looks; other than the position", "scene units"},
       {"up", vector(), Vec3{0, 1, 0}, "what is up in the picture; not along the line of sight"},
       {"fov", number(field_of_view), required, "vertical field of view", "degrees"},
       {"aperture", number(non_negative_number), absent.aperture, "radius of the lens; 0 is a pinhole",
        "scene units"},
       {"focus_distance", number(positive_number), Absent::Described{"the distance to the target"},
        "distance of the plane in focus", "scene units"},
       {"shutter",
        tuple("times, at which the shutter opens and closes", {number(shutter_time), number(shutter_time)}),
        {absent.shutter[0], absent.shutter[1]},
        "when the shutter opens and closes",
        "time"}}};
  return table;
}

const SceneTable& direct_camera_keys() {
  const CameraSpec absent;
  static const SceneTable table{
      "camera_direct",
      "",
      "camera with \"origin\" and \"direct\"",
      {{"origin", vector(), required, "where the camera stands", "scene units"},
       {"direct", vector(), required, "viewing direction; not 0, not along x"},
       {"view_angle_scale", number(film_height), required,
        "height s of the picture at distance 1: the vertical field of view is 2 atan(s / 2)"},
       {"plane_distance", number(non_negative_number), absent.plane_distance,
        "rays start on the plane at this distance", "scene units"},
       {"focal_distance", number(non_negative_number), absent.focal_distance,
        "distance of the sphere in focus; positive where the aperture is not 0", "scene units"},
       {"aperture", number(non_negative_number), absent.aperture, "radius of the lens; 0 is a pinhole",
        "scene units"}}};
  return table;
}

ValueType camera_type() { return object("camera", {&target_camera_keys, &direct_camera_keys}); }

}  // namespace causticl
