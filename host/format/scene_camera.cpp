// The key `camera`: both forms become one thin lens.
#include <cmath>
#include <numbers>

#include "format/scene_keys.hpp"
#include "format/scene_loader.hpp"

namespace causticl {
namespace {

// "origin", "direct": the film spans (aspect s, 0, 0) and normalize(that x direct) s at distance 1.
CameraSpec read_direct_camera(const SceneObject& json, double aspect) {
  CameraSpec camera;
  camera.origin = json.vector("origin");
  const Vec3 direct = json.vector("direct");
  if (length(direct) < positive_number.low)
    json.at("direct").fail("expected a direction, got a vector of length 0");
  camera.axis = normalize(direct);
  const double s = json.number("view_angle_scale");
  camera.right = {aspect * s, 0, 0};
  const Vec3 up = cross({1, 0, 0}, camera.axis);
  if (length(up) < 1e-6)
    json.at("direct").fail(
        "expected a direction off the x axis, which is the film's horizontal, got one along it");
  camera.up = normalize(up) * s;
  camera.plane_distance = json.number("plane_distance");
  camera.aperture = json.number("aperture");
  camera.focal_distance = json.number("focal_distance");
  // A pinhole has everything in focus, and older files then give 0.
  if (camera.aperture == 0)
    camera.focal_distance = 1;
  else if (camera.focal_distance < positive_number.low)
    json.at("focal_distance").fail_expected("a positive number", "a lens with an aperture needs a focus");
  camera.flat_focus = false;
  return camera;
}

std::array<double, 2> read_shutter(const SceneValue& json) {
  const auto items = json.items();
  const double opens = items[0].number(), closes = items[1].number();
  if (closes < opens)
    items[1].fail("expected the shutter to close no earlier than it opens, got an earlier time");
  return {opens, closes};
}

CameraSpec read_target_camera(const SceneObject& json, double aspect) {
  CameraSpec camera;
  camera.origin = json.vector("position");
  const Vec3 to_target = json.vector("target") - camera.origin;
  const double distance = length(to_target);
  if (distance < positive_number.low)
    json.at("target").fail("expected a point other than `position`, got the same");
  camera.axis = to_target / distance;
  const Vec3 up = json.vector("up");
  const Vec3 right = length(up) < positive_number.low ? Vec3{} : cross(camera.axis, normalize(up));
  if (length(right) < 1e-6) {
    const std::string fault = "expected a direction off the line of sight, got one along it or of length 0";
    json.at("up").fail(json.has("up") ? fault : fault + "; the default is [0, 1, 0]");
  }
  const double height = 2 * std::tan(json.number("fov") * std::numbers::pi / 360);
  camera.right = normalize(right) * (height * aspect);
  camera.up = cross(normalize(right), camera.axis) * height;
  camera.aperture = json.number("aperture");
  camera.focal_distance = json.number("focus_distance", distance);
  camera.flat_focus = true;
  if (const auto shutter = json.find("shutter")) camera.shutter = read_shutter(*shutter);
  return camera;
}

}  // namespace

CameraSpec read_camera(const SceneValue& json, double aspect) {
  if (json.mentions("position") || json.mentions("target"))
    return read_target_camera(json.object(target_camera_keys()), aspect);
  if (json.mentions("origin") || json.mentions("direct"))
    return read_direct_camera(json.object(direct_camera_keys()), aspect);
  json.check_keys_of_all();
  json.fail(
      "expected \"position\", \"target\" and \"fov\", or \"origin\", \"direct\" and \"view_angle_scale\", "
      "got neither");
}

}  // namespace causticl
