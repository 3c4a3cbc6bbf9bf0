// The key `renderer`.
#include <limits>

#include "format/option_values.hpp"
#include "format/scene_loader.hpp"

namespace causticl {
namespace {

constexpr std::int64_t count_limit = 1 << 30;

const std::vector<std::string> renderer_keys{"type",
                                             "sample",
                                             "view_point_sample",
                                             "photon_sample",
                                             "rounds",
                                             "radius",
                                             "radius_decay",
                                             "alpha",
                                             "schedule",
                                             "direct_light",
                                             "light_pos",
                                             "light_r",
                                             "light_radiance",
                                             "indirect_radius",
                                             "guided_photons",
                                             "aimed_photons",
                                             "boundary_correction",
                                             "sampler",
                                             "samples",
                                             "visible_points",
                                             "photons",
                                             "passes"};

Integrator read_integrator_name(const JsonReader& json) {
  if (json.value().kind == JsonValue::Kind::string)
    if (const auto integrator = parse_integrator(json.string())) return *integrator;
  return json.choice({"sppm", "pt"}) == 0 ? Integrator::sppm : Integrator::pt;
}

// A key that has two names: that of cg_tracing and that of the command line. A -D that comes with the one
// replaces the other.
std::optional<JsonReader> find_either(const JsonReader& json, const char* key, const char* other_key) {
  const auto value = json.find(key), other = json.find(other_key);
  if (!value || !other) return value ? value : other;
  const int source = value->value().source, other_source = other->value().source;
  if (source == other_source)
    other->fail(std::string("expected \"") + key + "\" or \"" + other_key +
                "\", which are the same, got both");
  return source > other_source ? value : other;
}

}  // namespace

void read_renderer(const JsonReader& json, SceneLoader& loader) {
  // Keys of both integrators are welcome in either, so that one file serves --integrator too.
  json.check_keys(renderer_keys);
  RendererSpec& renderer = loader.scene.renderer;
  if (const auto type = json.find("type")) renderer.integrator = read_integrator_name(*type);
  if (const auto samples = find_either(json, "sample", "samples"))
    renderer.samples = static_cast<int>(samples->integer(1, count_limit));
  if (const auto points = find_either(json, "view_point_sample", "visible_points"))
    renderer.visible_points = static_cast<int>(points->integer(1, 1024));
  if (const auto photons = find_either(json, "photon_sample", "photons"))
    renderer.photons = photons->integer(1, count_limit);
  if (const auto passes = find_either(json, "rounds", "passes"))
    renderer.passes = static_cast<int>(passes->integer(1, count_limit));
  if (const auto radius = json.find("radius")) renderer.radius = radius->number(positive_number);
  if (const auto wider = json.find("indirect_radius"))
    renderer.indirect_radius = wider->number({1, 100, "a number from 1 to 100"});
  if (json.has("guided_photons")) renderer.guided_photons = json.boolean("guided_photons", true);
  if (json.has("aimed_photons")) renderer.aimed_photons = json.boolean("aimed_photons", true);
  renderer.boundary_correction = json.boolean("boundary_correction", renderer.boundary_correction);
  renderer.alpha = read_fraction(json, "alpha", renderer.alpha, open_unit_number);
  renderer.radius_decay =
      json.number("radius_decay", renderer.radius_decay, {1e-6, 1, "a number from 1e-6 to 1"});
  if (const auto schedule = json.find("schedule"))
    renderer.schedule = static_cast<Schedule>(schedule->choice({"pixel", "global", "geometric"}));
  if (const auto sampler = json.find("sampler"))
    renderer.sampler = static_cast<Sampler>(sampler->choice({"sobol", "independent"}));
  if (const auto direct_light = json.find("direct_light"))
    renderer.direct_light = static_cast<DirectLight>(direct_light->choice({"shadow_rays", "photons"}));
  if (json.has("radius_decay") && renderer.schedule != Schedule::geometric)
    loader.notice(json.at("radius_decay"),
                  "ignored, since a geometric decay does not converge: alpha rules the radius; "
                  "\"schedule\": \"geometric\" brings it back");
}

void read_disc_light(const JsonReader& json, SceneLoader& loader) {
  if (!json.has("light_pos") && !json.has("light_r") && !json.has("light_radiance")) return;
  for (const char* key : {"light_pos", "light_r"})
    if (!json.has(key))
      json.at(key).fail_expected("a value", "a disc light needs \"light_pos\" and \"light_r\"");

  Object light;
  light.shape = Object::Shape::disk;
  light.pointer = json.pointer();
  light.is_disc_light = true;
  light.radius = json.at("light_r").number(positive_number);
  // Local +z, the front, turns to world -y.
  light.transform.rows = {Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}};
  light.transform.translation = read_vector(json.at("light_pos"));

  MaterialSpec black;
  black.pointer = json.pointer();
  black.color = {0, 0, 0};
  black.emission = read_color(json, "light_radiance", {10, 10, 10}, non_negative_number);
  light.material = static_cast<int>(loader.scene.materials.size());
  loader.scene.materials.push_back(black);
  loader.scene.objects.push_back(light);
}

}  // namespace causticl
