// The entries of `lights`.
#include "format/scene_loader.hpp"

namespace causticl {
namespace {

using Kind = DeltaLight::Kind;

constexpr NumberRange cone_angle{0.01, 180, "degrees from 0.01 to 180, of the whole cone"};
constexpr NumberRange rotation_angle{-1e6, 1e6, "degrees from -1e6 to 1e6"};

Vec3 read_direction(const JsonReader& json) {
  const Vec3 direction = read_vector(json);
  if (length(direction) < positive_number.low) json.fail("expected a direction, got a vector of length 0");
  return normalize(direction);
}

void add_delta_light(const JsonReader& json, Kind kind, Scene& scene) {
  DeltaLight light;
  light.kind = kind;
  light.pointer = json.pointer();
  if (kind == Kind::directional) {
    json.check_keys({"type", "direction", "irradiance"});
    light.direction = read_direction(json.at("direction"));
    light.intensity = read_color(json.at("irradiance"), non_negative_number);
  } else {
    if (kind == Kind::point)
      json.check_keys({"type", "position", "intensity"});
    else
      json.check_keys({"type", "position", "target", "angle", "blend", "intensity"});
    light.position = read_vector(json.at("position"));
    light.intensity = read_color(json.at("intensity"), non_negative_number);
  }
  if (kind == Kind::spot) {
    const Vec3 axis = read_vector(json.at("target")) - light.position;
    if (length(axis) < positive_number.low)
      json.at("target").fail("expected a point other than `position`, got the same");
    light.direction = normalize(axis);
    light.angle = json.at("angle").number(cone_angle);
    light.blend = read_fraction(json, "blend", 0, unit_number);
  }
  scene.lights.push_back(light);
}

// A surface as others: it is seen, and emits on the side of its normal.
void add_disk(const JsonReader& json, Scene& scene) {
  json.check_keys({"type", "position", "normal", "radius", "radiance"});
  Object light;
  light.shape = Object::Shape::disk;
  light.pointer = json.pointer();
  light.is_disc_light = true;
  light.radius = json.at("radius").number(positive_number);
  const Vec3 n = read_direction(json.at("normal"));
  const Vec3 x = normalize(cross(std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)), y = cross(n, x);
  for (int axis = 0; axis < 3; ++axis) light.transform.rows[axis] = {x[axis], y[axis], n[axis]};
  light.transform.translation = read_vector(json.at("position"));

  MaterialSpec black;
  black.color = {0, 0, 0};
  black.emission = read_color(json.at("radiance"), non_negative_number);
  light.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(black);
  scene.objects.push_back(light);
}

// The same radiance from everywhere, in rows of which each is as good as uniform over its solid angle.
Image constant_map(Color radiance) {
  Image map;
  map.width = 64;
  map.height = 32;
  for (int i = 0; i < map.width * map.height; ++i)
    for (const double value : {radiance.x, radiance.y, radiance.z, 1.0})
      map.rgba.push_back(static_cast<float>(value));
  return map;
}

void add_environment(const JsonReader& json, SceneLoader& loader) {
  json.check_keys({"type", "path", "radiance", "rotation"});
  Scene& scene = loader.scene;
  if (scene.environment)
    json.fail("expected one environment, got a second beside " + scene.environment->pointer);
  if (json.has("path") == json.has("radiance"))
    json.fail(std::string("expected \"path\" or \"radiance\", got ") +
              (json.has("path") ? "both" : "neither"));
  Environment environment;
  environment.pointer = json.pointer();
  environment.rotation = json.number("rotation", 0, rotation_angle);
  if (const auto path = json.find("path"))
    environment.map = loader.radiance_map(*path);
  else
    environment.map = constant_map(read_color(json.at("radiance"), non_negative_number));
  scene.environment = std::move(environment);
}

}  // namespace

void read_lights(const JsonReader& json, SceneLoader& loader) {
  for (const JsonReader& light : json.items(0, SIZE_MAX, "lights")) {
    if (light.value().kind != JsonValue::Kind::object) light.fail_expected("an object");
    const auto type = light.at("type").choice({"point", "spot", "directional", "disk", "environment"});
    if (type < 3)
      add_delta_light(light, static_cast<Kind>(type), loader.scene);
    else if (type == 3)
      add_disk(light, loader.scene);
    else
      add_environment(light, loader);
  }
}

}  // namespace causticl
