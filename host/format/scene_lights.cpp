// The entries of `lights`.
#include "format/scene_loader.hpp"
#include "scene/light_kind.hpp"

namespace causticl {
namespace {

Vec3 read_direction(const SceneValue& json) {
  const Vec3 direction = json.vector();
  if (length(direction) < positive_number.low) json.fail("expected a direction, got a vector of length 0");
  return normalize(direction);
}

// The frame about `position` whose +z is the unit vector `direction`.
Transform facing(Vec3 position, Vec3 direction) {
  const Vec3 z = direction, side = std::fabs(z.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = normalize(cross(side, z)), y = cross(z, x);
  Transform transform;
  for (int axis = 0; axis < 3; ++axis) transform.rows[axis] = {x[axis], y[axis], z[axis]};
  transform.translation = position;
  return transform;
}

// A black surface as others: it is seen, and emits on the side of its normal.
void add_body(const SceneObject& json, const LightSpec& light, Scene& scene) {
  Object body;
  body.shape = Object::Shape::disk;
  body.pointer = light.pointer;
  body.is_disc_light = true;
  body.radius = json.number("radius");
  body.transform = facing(light.position, light.direction);

  MaterialSpec black;
  black.color = {0, 0, 0};
  black.emission = light.intensity;
  body.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(black);
  scene.objects.push_back(body);
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

// The entry's keys, those that the row of its kind has.
LightSpec read_light(const SceneObject& json, SceneLoader& loader) {
  LightSpec light;
  light.kind = light_rows[json.type()].kind;
  light.pointer = json.pointer();
  if (json.knows("position")) light.position = json.vector("position");
  for (const char* key : {"direction", "normal"})
    if (json.knows(key)) light.direction = read_direction(json.at(key));
  if (json.knows("target")) {
    const Vec3 axis = json.vector("target") - light.position;
    if (length(axis) < positive_number.low)
      json.at("target").fail("expected a point other than `position`, got the same");
    light.direction = normalize(axis);
  }
  if (json.knows("angle")) {
    light.angle = json.number("angle");
    light.blend = json.number("blend");
  }
  if (json.knows("path")) {
    light.rotation = json.number("rotation");
    const auto path = json.find("path");
    light.map = path ? loader.radiance_map(*path) : constant_map(json.at("radiance").color());
    return light;
  }
  for (const char* key : {"intensity", "irradiance", "radiance"})
    if (json.knows(key)) light.intensity = json.color(key);
  return light;
}

}  // namespace

void read_lights(const SceneValue& json, SceneLoader& loader) {
  std::string background;
  for (const SceneValue& item : json.items()) {
    const SceneObject entry = item.object();
    LightSpec light = read_light(entry, loader);
    if (has_property(light.kind, BACKGROUND)) {
      if (!background.empty())
        entry.fail("expected one " + std::string(row_of(light.kind).text) + ", got a second beside " +
                   background);
      background = light.pointer;
    }
    if (has_property(light.kind, EMISSIVE))
      add_body(entry, light, loader.scene);
    else
      loader.scene.lights.push_back(std::move(light));
  }
}

}  // namespace causticl
