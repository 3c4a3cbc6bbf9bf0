// The native format: JSON with comments, by the tables of scene_keys.hpp.
#include <algorithm>
#include <tuple>

#include "base/error.hpp"
#include "format/scene_formats.hpp"
#include "format/scene_keys.hpp"
#include "format/scene_loader.hpp"
#include "format/scene_output.hpp"
#include "scene/integrators.hpp"
#include "scene/light_kind.hpp"

namespace causticl {
namespace {

void read_size(const SceneObject& json, const SceneOptions& options, Scene& scene) {
  scene.width = json.integer("width");
  scene.height = json.integer("height");
  const std::string limit = "expected at most 2^28 pixels, got ";
  if (options.size) {
    std::tie(scene.width, scene.height) = *options.size;
    const std::string size = std::to_string(scene.width) + "x" + std::to_string(scene.height);
    if (scene.width < 1 || scene.height < 1)
      throw UserError("--size " + size + ": expected a width and a height of at least 1, got " + size);
    if (std::int64_t{scene.width} * scene.height > most_pixels)
      throw UserError("--size " + size + ": " + limit + size);
  } else if (std::int64_t{scene.width} * scene.height > most_pixels) {
    (json.has("height") ? json.at("height") : json.at("width"))
        .fail(limit + std::to_string(scene.width) + "x" + std::to_string(scene.height));
  }
}

// The first cg_tracing files have no `renderer` but `sample` at the top: they are path traced.
void read_integrator(const SceneObject& json, const SceneOptions& options, SceneLoader& loader) {
  RendererSpec& renderer = loader.scene.renderer;
  if (const auto sample = json.find("sample")) {
    renderer.integrator = Integrator::pt;
    renderer.samples = static_cast<int>(sample->integer());
  }
  const auto settings = json.find("renderer");
  if (settings) read_renderer(settings->object(), loader);
  if (options.integrator) renderer.integrator = *options.integrator;
  const Scene& scene = loader.scene;
  if (traces_photons(renderer.integrator) &&
      std::int64_t{scene.width} * scene.height * renderer.visible_points > most_visible_points)
    (settings ? SceneNode(*settings) : SceneNode(json))
        .fail("expected at most 2^31 visible points in a pass, got " + std::to_string(scene.width) + "x" +
              std::to_string(scene.height) + " pixels with " + std::to_string(renderer.visible_points));
}

MediumSpec read_medium(const SceneObject& json) {
  MediumSpec medium;
  medium.absorption = json.color("absorption");
  medium.scattering = json.color("scattering");
  medium.g = json.number("g");
  return medium;
}

// Through a medium without end nothing is left of light from infinitely far, while its photons start near the
// scene.
void refuse_infinite_light(const SceneObject& json, const Scene& scene) {
  if (!(max_component(scene.medium.absorption + scene.medium.scattering) > 0)) return;
  const bool infinite = std::any_of(scene.lights.begin(), scene.lights.end(), [](const LightSpec& light) {
    return has_property(light.kind, BEYOND_SCENE);
  });
  if (infinite)
    json.at("medium").fail(
        "expected no environment and no directional light beside a medium, which swallows light "
        "from infinitely far, got one; use a large disk or a point light");
}

}  // namespace

// What may stand before its first brace: a byte order mark, blank space, comments.
bool is_json_scene(const std::string& beginning) {
  const std::size_t mark = beginning.starts_with("\xef\xbb\xbf") ? 3 : 0;
  const std::size_t first = beginning.find_first_not_of(" \t\r\n", mark);
  if (first == std::string::npos) return true;  // the reader says that it is empty
  return beginning[first] == '{' || beginning[first] == '[' || beginning.compare(first, 2, "//") == 0 ||
         beginning.compare(first, 2, "/*") == 0;
}

Scene load_json_scene(const std::string& file, const SceneOptions& options) {
  JsonDocument document = json_read(file);
  for (const auto& [key, value] : options.overrides) json_override(document, key, value);
  const SceneObject json(JsonReader(document), scene_keys());

  SceneLoader loader;
  loader.image_limits = options.image_limits;
  Scene& scene = loader.scene;
  scene.file = file;
  if (const auto schema = json.find("$schema")) schema->string();
  if (const auto path = json.find("path")) scene.output = read_output(*path);
  read_size(json, options, scene);
  scene.max_depth = json.integer("max_depth");
  scene.outside_ior = json.number("Na");
  loader.glass_ior = json.number("Ng");
  for (const char* key : {"thread_num", "stack_size"})
    if (const auto ignored = json.find(key)) {
      ignored->integer();
      loader.notice(*ignored, "\"thread_num\" and \"stack_size\" are ignored: the device schedules itself");
    }
  read_integrator(json, options, loader);
  scene.camera = read_camera(json.at("camera"), static_cast<double>(scene.width) / scene.height);
  if (const auto medium = json.find("medium")) scene.medium = read_medium(medium->object());
  if (const auto materials = json.find("materials")) read_named_materials(*materials, loader);
  for (const SceneValue& object : json.at("objects").items()) read_object(object, loader);
  if (const auto renderer = json.find("renderer")) read_disc_light(renderer->object(), loader);
  if (const auto lights = json.find("lights")) read_lights(*lights, loader);
  refuse_infinite_light(json, scene);
  loader.finish(json);
  return std::move(scene);
}

}  // namespace causticl
