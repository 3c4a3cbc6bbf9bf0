// The entries of `lights`.
#include "format/scene_loader.hpp"

namespace causticl {
namespace {

using Kind = DeltaLight::Kind;

Vec3 read_direction(const SceneValue& json) {
  const Vec3 direction = json.vector();
  if (length(direction) < positive_number.low) json.fail("expected a direction, got a vector of length 0");
  return normalize(direction);
}

void add_delta_light(const SceneObject& json, Kind kind, Scene& scene) {
  DeltaLight light;
  light.kind = kind;
  light.pointer = json.pointer();
  if (kind == Kind::directional) {
    light.direction = read_direction(json.at("direction"));
    light.intensity = json.color("irradiance");
  } else {
    light.position = json.vector("position");
    light.intensity = json.color("intensity");
  }
  if (kind == Kind::spot) {
    const Vec3 axis = json.vector("target") - light.position;
    if (length(axis) < positive_number.low)
      json.at("target").fail("expected a point other than `position`, got the same");
    light.direction = normalize(axis);
    light.angle = json.number("angle");
    light.blend = json.number("blend");
  }
  scene.lights.push_back(light);
}

// A surface as others: it is seen, and emits on the side of its normal.
void add_disk(const SceneObject& json, Scene& scene) {
  Object light;
  light.shape = Object::Shape::disk;
  light.pointer = json.pointer();
  light.is_disc_light = true;
  light.radius = json.number("radius");
  const Vec3 n = read_direction(json.at("normal"));
  const Vec3 x = normalize(cross(std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)), y = cross(n, x);
  for (int axis = 0; axis < 3; ++axis) light.transform.rows[axis] = {x[axis], y[axis], n[axis]};
  light.transform.translation = json.vector("position");

  MaterialSpec black;
  black.color = {0, 0, 0};
  black.emission = json.color("radiance");
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

void add_environment(const SceneObject& json, SceneLoader& loader) {
  Scene& scene = loader.scene;
  if (scene.environment)
    json.fail("expected one environment, got a second beside " + scene.environment->pointer);
  Environment environment;
  environment.pointer = json.pointer();
  environment.rotation = json.number("rotation");
  if (const auto path = json.find("path"))
    environment.map = loader.radiance_map(*path);
  else
    environment.map = constant_map(json.at("radiance").color());
  scene.environment = std::move(environment);
}

}  // namespace

void read_lights(const SceneValue& json, SceneLoader& loader) {
  for (const SceneValue& item : json.items()) {
    const SceneObject light = item.object();
    if (light.type() < 3)
      add_delta_light(light, static_cast<Kind>(light.type()), loader.scene);
    else if (light.type() == 3)
      add_disk(light, loader.scene);
    else
      add_environment(light, loader);
  }
}

}  // namespace causticl
