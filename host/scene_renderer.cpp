// The key `renderer`.
#include <limits>

#include "scene_loader.hpp"

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
                                             "sampler"};

}  // namespace

void read_renderer(const JsonReader& json, SceneLoader& loader) {
  // Keys of both integrators are welcome in either, so that one file serves --integrator too.
  json.check_keys(renderer_keys);
  RendererSpec& renderer = loader.scene.renderer;
  if (const auto type = json.find("type"))
    renderer.integrator = type->choice({"sppm", "pt"}) == 0 ? Integrator::sppm : Integrator::pt;
  renderer.samples = static_cast<int>(json.integer("sample", renderer.samples, 1, count_limit));
  renderer.visible_points =
      static_cast<int>(json.integer("view_point_sample", renderer.visible_points, 1, 1024));
  renderer.photons = json.integer("photon_sample", renderer.photons, 1, count_limit);
  renderer.passes = static_cast<int>(json.integer("rounds", renderer.passes, 1, count_limit));
  if (const auto radius = json.find("radius")) renderer.radius = radius->number(positive_number);
  if (const auto wider = json.find("indirect_radius"))
    renderer.indirect_radius = wider->number({1, 100, "a number from 1 to 100"});
  if (json.has("guided_photons")) renderer.guided_photons = json.boolean("guided_photons", true);
  if (json.has("aimed_photons")) renderer.aimed_photons = json.boolean("aimed_photons", true);
  renderer.boundary_correction = json.boolean("boundary_correction", renderer.boundary_correction);
  renderer.alpha = json.number("alpha", renderer.alpha, open_unit_number);
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
  black.emission = read_vector(json, "light_radiance", {10, 10, 10}, non_negative_number);
  light.material = static_cast<int>(loader.scene.materials.size());
  loader.scene.materials.push_back(black);
  loader.scene.objects.push_back(light);
}

}  // namespace causticl
