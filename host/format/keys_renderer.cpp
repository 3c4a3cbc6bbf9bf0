// The table of the key `renderer`.
#include <cctype>

#include "format/option_values.hpp"
#include "format/scene_keys.hpp"
#include "scene/integrators.hpp"

namespace causticl {
namespace {

using namespace types;

constexpr std::int64_t most = 1 << 30;
constexpr NumberRange radius_factor{1, 100, "a number from 1 to 100"};
constexpr NumberRange decay{1e-6, 1, "a number from 1e-6 to 1"};

// All that parse_integrator() takes: letters of either case, and what joins words anywhere.
std::string integrator_pattern() {
  const std::string joint = "[-_ ]*";
  std::string result;
  for (const std::string& name : integrator_spellings()) {
    result += (result.empty() ? "" : "|") + joint;
    for (const char c : name)
      result +=
          std::string("[") + c + static_cast<char>(std::toupper(static_cast<unsigned char>(c))) + "]" + joint;
  }
  return "^(" + result + ")$";
}

std::vector<SceneKey> rows_of_renderer() {
  using Described = Absent::Described;
  const RendererSpec absent;
  return {
      {"type", choice(integrator_names(), integrator_pattern()), "sppm",
       "integrator: stochastic progressive photon mapping or path tracing"},
      {"sample", integer(1, most), absent.samples, "pt: samples a pixel", "", "samples"},
      {"view_point_sample", integer(1, 1024), absent.visible_points, "sppm: visible points a pixel a pass",
       "", "visible_points"},
      {"photon_sample", integer(1, most), absent.photons, "sppm: photons a pass", "", "photons"},
      {"rounds", integer(1, most), absent.passes, "sppm: passes", "", "passes"},
      {"radius", number(positive_number), Described{"chosen from the scene"}, "sppm: first search radius",
       "scene units"},
      {"radius_decay", number(decay), absent.radius_decay,
       "sppm: factor of the radius a pass, of the schedule \"geometric\""},
      {"alpha", fraction(open_unit_number), absent.alpha,
       "sppm: fraction of new photons that a shrinking radius keeps"},
      {"schedule", choice({"pixel", "global", "geometric"}), "pixel",
       "sppm: how the radius shrinks: for every pixel, once a pass, or by radius_decay"},
      {"direct_light", choice({"shadow_rays", "photons"}), "shadow_rays", "sppm: what brings direct light"},
      {"light_pos", vector(), optional, "base format: centre of a disc light that faces -y", "scene units"},
      {"light_r", number(positive_number), optional, "base format: radius of the disc light", "scene units"},
      {"light_radiance", color(non_negative_number), Vec3{10, 10, 10},
       "base format: radiance of the disc light"},
      {"indirect_radius", number(radius_factor), Described{"1"},
       "sppm: times the radius, the search radius for photons that a diffuse surface has scattered before"},
      {"guided_photons", boolean(), Described{"the pilot decides"},
       "sppm: visibility-driven Metropolis photons"},
      {"aimed_photons", boolean(), Described{"true for directional lights and the environment"},
       "sppm: projection map: more photons start where they become caustics"},
      {"boundary_correction", boolean(), absent.boundary_correction,
       "sppm: divides by the part of the search disc that holds surface"},
      {"sampler", choice({"sobol", "independent"}), "sobol",
       "samples of camera paths: low-discrepancy, or independent random numbers"}};
}

}  // namespace

ValueType renderer_type() {
  static constexpr auto table = []() -> const SceneTable& {
    constexpr auto needs = KeyRule::Relation::needs;
    const char* const hint = "a disc light needs \"light_pos\" and \"light_r\"";
    static const SceneTable keys{"renderer",
                                 "",
                                 "renderer",
                                 rows_of_renderer(),
                                 {{needs, "light_r", "light_pos", "", hint},
                                  {needs, "light_radiance", "light_pos", "", hint},
                                  {needs, "light_pos", "light_r", "", hint},
                                  {needs, "light_radiance", "light_r", "", hint}}};
    return keys;
  };
  return object("renderer", {table});
}

}  // namespace causticl
