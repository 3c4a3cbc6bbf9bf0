// The key `camera`: both forms become one thin lens.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "format/scene_loader.hpp"

namespace causticl {
namespace {

constexpr NumberRange field_of_view{0.001, 179.9, "degrees from 0.001 to 179.9"};

const std::vector<std::string> direct_keys{"origin",         "direct",         "view_angle_scale",
                                           "plane_distance", "focal_distance", "aperture"};
const std::vector<std::string> target_keys{"position", "target",         "up",     "fov",
                                           "aperture", "focus_distance", "shutter"};

// A key of the other form is no spelling mistake: say what it is.
void refuse_keys_of(const std::vector<std::string>& other, const std::vector<std::string>& own,
                    const JsonReader& json, const std::string& form) {
  for (const auto& [key, value] : json.members())
    if (std::find(own.begin(), own.end(), key) == own.end() &&
        std::find(other.begin(), other.end(), key) != other.end())
      value.fail("key " + json_quote(key) + " does not belong to a camera with " + form +
                 "; use the keys of one form only");
}

// "origin", "direct": the film spans (aspect s, 0, 0) and normalize(that x direct) s at distance 1.
CameraSpec read_direct_camera(const JsonReader& json, double aspect) {
  refuse_keys_of(target_keys, direct_keys, json, "\"origin\" and \"direct\"");
  json.check_keys(direct_keys);
  CameraSpec camera;
  camera.origin = read_vector(json.at("origin"));
  const Vec3 direct = read_vector(json.at("direct"));
  if (length(direct) < positive_number.low)
    json.at("direct").fail("expected a direction, got a vector of length 0");
  camera.axis = normalize(direct);
  const double s = json.at("view_angle_scale").number({1e-5, 1e4, "a positive number from 1e-5 to 1e4"});
  camera.right = {aspect * s, 0, 0};
  const Vec3 up = cross({1, 0, 0}, camera.axis);
  if (length(up) < 1e-6)
    json.at("direct").fail(
        "expected a direction off the x axis, which is the film's horizontal, got one along it");
  camera.up = normalize(up) * s;
  camera.plane_distance = json.number("plane_distance", 0, non_negative_number);
  camera.aperture = json.number("aperture", 0, non_negative_number);
  camera.focal_distance = json.number("focal_distance", 1, non_negative_number);
  // A pinhole has everything in focus, and older files then give 0.
  if (camera.aperture == 0)
    camera.focal_distance = 1;
  else if (camera.focal_distance < positive_number.low)
    json.at("focal_distance").fail_expected("a positive number", "a lens with an aperture needs a focus");
  camera.flat_focus = false;
  return camera;
}

std::array<double, 2> read_shutter(const JsonReader& json) {
  constexpr NumberRange time{-1e6, 1e6, "a time from -1e6 to 1e6"};
  const auto items = json.items(2, 2, "times, at which the shutter opens and closes");
  const double opens = items[0].number(time), closes = items[1].number(time);
  if (closes < opens)
    items[1].fail("expected the shutter to close no earlier than it opens, got an earlier time");
  return {opens, closes};
}

CameraSpec read_target_camera(const JsonReader& json, double aspect) {
  refuse_keys_of(direct_keys, target_keys, json, "\"position\" and \"target\"");
  json.check_keys(target_keys);
  CameraSpec camera;
  camera.origin = read_vector(json.at("position"));
  const Vec3 to_target = read_vector(json.at("target")) - camera.origin;
  const double distance = length(to_target);
  if (distance < positive_number.low)
    json.at("target").fail("expected a point other than `position`, got the same");
  camera.axis = to_target / distance;
  const Vec3 up = read_vector(json, "up", {0, 1, 0});
  const Vec3 right = length(up) < positive_number.low ? Vec3{} : cross(camera.axis, normalize(up));
  if (length(right) < 1e-6) {
    const std::string fault = "expected a direction off the line of sight, got one along it or of length 0";
    json.at("up").fail(json.has("up") ? fault : fault + "; the default is [0, 1, 0]");
  }
  const double height = 2 * std::tan(json.at("fov").number(field_of_view) * std::numbers::pi / 360);
  camera.right = normalize(right) * (height * aspect);
  camera.up = cross(normalize(right), camera.axis) * height;
  camera.aperture = json.number("aperture", 0, non_negative_number);
  camera.focal_distance = json.number("focus_distance", distance, positive_number);
  camera.flat_focus = true;
  if (const auto shutter = json.find("shutter")) camera.shutter = read_shutter(*shutter);
  return camera;
}

}  // namespace

CameraSpec read_camera(const JsonReader& json, double aspect) {
  if (json.value().kind != JsonValue::Kind::object) json.fail_expected("an object");
  if (json.has("position") || json.has("target")) return read_target_camera(json, aspect);
  if (json.has("origin") || json.has("direct")) return read_direct_camera(json, aspect);
  std::vector<std::string> keys = target_keys;
  keys.insert(keys.end(), direct_keys.begin(), direct_keys.end());
  json.check_keys(keys);
  json.fail(
      "expected \"position\", \"target\" and \"fov\", or \"origin\", \"direct\" and \"view_angle_scale\", "
      "got neither");
}

}  // namespace causticl
