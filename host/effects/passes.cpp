#include "effects/passes.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "scene/integrators.hpp"
#include "scene/material_kind.hpp"
#include "shared/passes.h"

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
  const std::string photons = why_no_photons(scene);
  std::vector<PassPlan> plan;
  for (const auto& program : programs_of(scene.renderer.integrator))
    plan.push_back({program, (pass_row(program).properties & SERVES_PHOTONS) ? photons : dark});
  return plan;
}

std::vector<std::string> passes_to_run(const std::vector<PassPlan>& plan) {
  std::vector<std::string> names;
  for (const auto& pass : plan)
    if (pass.skipped.empty()) names.push_back(pass.name);
  return names;
}

const PassRow& pass_row(const std::string& pass) {
#define ROW_OF_PASS(x, NAME, name, bit, kernel, properties) {#name, IN_##NAME, #kernel, properties},
  static constexpr PassRow rows[] = {PASS_TABLE(ROW_OF_PASS, )};
#undef ROW_OF_PASS
  const auto row =
      std::find_if(std::begin(rows), std::end(rows), [&](const PassRow& each) { return pass == each.name; });
  if (row == std::end(rows)) throw std::logic_error("no pass is called " + pass);
  return *row;
}

std::string why_skipped(const std::vector<PassPlan>& plan, const std::string& pass) {
  for (const auto& entry : plan)
    if (entry.name == pass) return entry.skipped;
  return "another integrator's";
}

}  // namespace causticl
