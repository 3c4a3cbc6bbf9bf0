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

// The frame whose +z is the unit vector `direction` and whose +y lies as near as it can to `up`.
Transform facing(Vec3 direction, Vec3 up) {
  const Vec3 x = normalize(cross(up, direction)), y = cross(direction, x);
  Transform transform;
  for (int axis = 0; axis < 3; ++axis) transform.rows[axis] = {x[axis], y[axis], direction[axis]};
  return transform;
}

Vec3 read_up(const SceneObject& json, Vec3 direction) {
  constexpr double parallel = 1e-6;
  if (const auto up = json.find("up")) {
    const Vec3 given = read_direction(*up);
    if (length(cross(given, direction)) < parallel)
      up->fail("expected a direction across `normal`, got one along it");
    return given;
  }
  return length(cross(Vec3{0, 1, 0}, direction)) < parallel ? Vec3{0, 0, -1} : Vec3{0, 1, 0};
}

// A black surface as others: it is seen, and emits on the side of its normal.
void add_body(const SceneObject& json, LightSpec light, SceneLoader& loader) {
  Scene& scene = loader.scene;
  Object body;
  body.pointer = light.pointer;
  body.material = static_cast<int>(scene.materials.size());
  if (has_property(light.kind, ON_DISK)) {
    body.shape = Object::Shape::disk;
    body.is_disc_light = true;
    body.radius = json.number("radius");
    const Vec3 n = light.direction;
    body.transform = facing(n, std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  } else {
    body.shape = Object::Shape::rectangle;
    const auto size = json.at("size").items();
    body.transform = Transform::scale({size[0].number(), size[1].number(), 1})
                         .followed_by(facing(light.direction, read_up(json, light.direction)));
  }
  body.transform.translation = light.position;

  MaterialSpec black;
  black.color = {0, 0, 0};
  black.emission = light.intensity;
  black.two_sided = json.knows("two_sided") && json.boolean("two_sided");
  if (!light.map.rgba.empty()) {
    light.object = static_cast<int>(scene.objects.size());
    black.light = static_cast<int>(scene.lights.size());
    scene.lights.push_back(std::move(light));
  }
  scene.materials.push_back(black);
  scene.objects.push_back(body);
}

// An image as radiance, as bright as it is times its `scale`. The light's intensity becomes the mean.
void read_radiance_image(const SceneObject& json, LightSpec& light, SceneLoader& loader) {
  light.map = loader.radiance_map(json.at("path"));
  const Color scale = json.color("scale");
  std::vector<float>& rgba = light.map.rgba;
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    for (int c = 0; c < 3; ++c) {
      const std::size_t value = i + static_cast<std::size_t>(c);
      rgba[value] = static_cast<float>(scale[c] * rgba[value]);
      light.intensity[c] += 4.0 * rgba[value] / static_cast<double>(rgba.size());
    }
}

void read_radiance(const SceneValue& json, LightSpec& light, SceneLoader& loader) {
  const SceneValue image = json.alternative(1);
  if (image.mentions("type"))
    read_radiance_image(image.object(), light, loader);
  else
    light.intensity = json.alternative(0).color();
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
  const unsigned keys = row_of(light.kind).keys;
  if ((keys & IMAGE_KEY) != 0) read_radiance(json.at("radiance"), light, loader);
  if ((keys & RADIANCE_KEY) != 0) light.intensity = json.color("radiance");
  for (const char* key : {"intensity", "irradiance"})
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
    if (has_property(light.kind, SURFACE | EMISSIVE))
      add_body(entry, std::move(light), loader);
    else
      loader.scene.lights.push_back(std::move(light));
  }
}

}  // namespace causticl
