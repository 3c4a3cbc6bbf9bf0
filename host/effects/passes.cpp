#include "effects/passes.hpp"

#include <algorithm>
#include <map>

#include "scene/material_kind.hpp"

namespace causticl {

bool stores_photons(const MaterialSpec& material) {
  const bool stores = has_property(material.kind, STORES_PHOTONS) || material.alpha_diffuse;
  return stores && (material.color_texture >= 0 || max_component(material.color) > 0);
}

namespace {

/// Why no photon would ever be stored, or found by a camera path.
std::string why_no_photons(const Scene& scene) {
  if (!has_light(scene)) return "nothing emits light";
  const bool lands = max_component(scene.medium.scattering) > 0 ||
                     std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
                       return stores_photons(scene.materials[static_cast<std::size_t>(object.material)]);
                     });
  if (!lands) return "no surface is diffuse or plastic: photons would land nowhere";
  if (scene.renderer.direct_light == DirectLight::shadow_rays && scene.max_depth == 1)
    return "max_depth is 1: all light is direct, which shadow rays bring";
  return "";
}

}  // namespace

std::vector<PassPlan> plan_passes(const Scene& scene) {
  const std::string dark = has_light(scene) ? "" : "nothing emits light: the picture is black";
  if (scene.renderer.integrator == Integrator::pt) return {{"path", dark}, {"film", dark}};
  const std::string photons = why_no_photons(scene);
  return {{"photon", photons}, {"camera", dark}, {"grid", photons}, {"gather", dark}, {"film", dark}};
}

std::vector<std::string> passes_to_run(const std::vector<PassPlan>& plan) {
  std::vector<std::string> names;
  for (const auto& pass : plan)
    if (pass.skipped.empty()) names.push_back(pass.name);
  return names;
}

const char* main_kernel(const std::string& pass) {
  static const std::map<std::string, const char*> kernels{
      {"photon", "trace_photons"},  {"camera", "trace_camera"}, {"grid", "move_photons"},
      {"gather", "gather_photons"}, {"path", "trace_paths"},    {"film", "pixel_errors"}};
  return kernels.at(pass);
}

std::string why_skipped(const std::vector<PassPlan>& plan, const std::string& pass) {
  for (const auto& entry : plan)
    if (entry.name == pass) return entry.skipped;
  return "another integrator's";
}

}  // namespace causticl
