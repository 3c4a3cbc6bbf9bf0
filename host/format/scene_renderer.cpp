// The key `renderer`.
#include <type_traits>

#include "format/option_values.hpp"
#include "format/renderer_keys.hpp"
#include "format/scene_loader.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

Integrator read_integrator_name(const SceneValue& json) {
  if (json.is(JsonValue::Kind::string))
    if (const auto integrator = parse_integrator(json.string())) return *integrator;
  return integrator_rows[json.choice()].integrator;
}

/// The value of a key into its field, one function a type.
struct FieldReader {
  const SceneObject& json;
  const char* key;
  RendererSpec& renderer;

  void operator()(std::monostate) const {}
  void operator()(Integrator RendererSpec::*field) const {
    if (const auto name = json.find(key)) renderer.*field = read_integrator_name(*name);
  }
  template <typename Enum>
  void operator()(Enum RendererSpec::*field) const requires std::is_enum_v<Enum> {
    renderer.*field = json.choice<Enum>(key);
  }
  void operator()(int RendererSpec::*field) const { renderer.*field = json.integer(key); }
  void operator()(std::int64_t RendererSpec::*field) const { renderer.*field = json.integer(key); }
  void operator()(double RendererSpec::*field) const { renderer.*field = json.number(key); }
  void operator()(bool RendererSpec::*field) const { renderer.*field = json.boolean(key); }
  void operator()(std::optional<double> RendererSpec::*field) const {
    if (const auto value = json.find(key)) renderer.*field = value->number();
  }
  void operator()(std::optional<bool> RendererSpec::*field) const {
    if (const auto value = json.find(key)) renderer.*field = value->boolean();
  }
};

}  // namespace

// Keys of both integrators are welcome in either, so that one file serves --integrator too.
void read_renderer(const SceneObject& json, SceneLoader& loader) {
  RendererSpec& renderer = loader.scene.renderer;
  for (const RendererKey& row : renderer_keys())
    std::visit(FieldReader{json, row.key.name, renderer}, row.field);
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
