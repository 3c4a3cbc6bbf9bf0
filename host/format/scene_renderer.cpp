// The key `renderer`.
#include "format/option_values.hpp"
#include "format/scene_loader.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

Integrator read_integrator_name(const SceneValue& json) {
  if (json.is(JsonValue::Kind::string))
    if (const auto integrator = parse_integrator(json.string())) return *integrator;
  return integrator_rows[json.choice()].integrator;
}

}  // namespace

// Keys of both integrators are welcome in either, so that one file serves --integrator too.
void read_renderer(const SceneObject& json, SceneLoader& loader) {
  RendererSpec& renderer = loader.scene.renderer;
  if (const auto type = json.find("type")) renderer.integrator = read_integrator_name(*type);
  renderer.samples = json.integer("sample");
  renderer.visible_points = json.integer("view_point_sample");
  renderer.photons = json.integer("photon_sample");
  renderer.passes = json.integer("rounds");
  if (const auto radius = json.find("radius")) renderer.radius = radius->number();
  if (const auto wider = json.find("indirect_radius")) renderer.indirect_radius = wider->number();
  if (const auto guided = json.find("guided_photons")) renderer.guided_photons = guided->boolean();
  if (const auto aimed = json.find("aimed_photons")) renderer.aimed_photons = aimed->boolean();
  renderer.boundary_correction = json.boolean("boundary_correction");
  renderer.alpha = json.number("alpha");
  renderer.radius_decay = json.number("radius_decay");
  renderer.schedule = json.choice<Schedule>("schedule");
  renderer.sampler = json.choice<Sampler>("sampler");
  renderer.direct_light = json.choice<DirectLight>("direct_light");
  if (json.has("radius_decay") && renderer.schedule != Schedule::geometric)
    loader.notice(json.at("radius_decay"),
                  "ignored, since a geometric decay does not converge: alpha rules the radius; "
                  "\"schedule\": \"geometric\" brings it back");
}

void read_disc_light(const SceneObject& json, SceneLoader& loader) {
  if (!json.has("light_pos")) return;
  Object light;
  light.shape = Object::Shape::disk;
  light.pointer = json.pointer();
  light.is_disc_light = true;
  light.radius = json.at("light_r").number();
  // Local +z, the front, turns to world -y.
  light.transform.rows = {Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}};
  light.transform.translation = json.at("light_pos").vector();

  MaterialSpec black;
  black.pointer = json.pointer();
  black.color = {0, 0, 0};
  black.emission = json.color("light_radiance");
  light.material = static_cast<int>(loader.scene.materials.size());
  loader.scene.materials.push_back(black);
  loader.scene.objects.push_back(light);
}

}  // namespace causticl
