// The table of the key `renderer`.
#include <cctype>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "format/option_values.hpp"
#include "format/renderer_keys.hpp"
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

/// The row of a field that has a value without the key: that of a RendererSpec as it is made.
template <typename Value>
RendererKey row(Value RendererSpec::*field, const char* name, ValueType type, const char* description,
                const char* unit = "", const char* alias = nullptr) {
  const Value absent = RendererSpec{}.*field;
  if constexpr (std::is_enum_v<Value>) {
    const std::string word = type.words.at(static_cast<std::size_t>(absent));
    return {{name, std::move(type), word.c_str(), description, unit, alias}, field};
  } else {
    return {{name, std::move(type), absent, description, unit, alias}, field};
  }
}

/// The row of a field that has none; `absent` says what holds then.
template <typename Value>
RendererKey optional_row(std::optional<Value> RendererSpec::*field, const char* name, ValueType type,
                         Absent::Described absent, const char* description, const char* unit = "") {
  return {{name, std::move(type), absent, description, unit}, field};
}

/// A key of the disc light.
RendererKey disc_row(const char* name, ValueType type, Absent absent, const char* description,
                     const char* unit = "") {
  return {{name, std::move(type), std::move(absent), description, unit}, {}};
}

}  // namespace

const std::vector<RendererKey>& renderer_keys() {
  using R = RendererSpec;
  static const std::vector<RendererKey> rows{
      row(&R::integrator, "type", choice(integrator_names(), integrator_pattern()),
          "integrator: stochastic progressive photon mapping or path tracing"),
      row(&R::samples, "sample", integer(1, most), "pt: samples a pixel", "", "samples"),
      row(&R::visible_points, "view_point_sample", integer(1, 1024), "sppm: visible points a pixel a pass",
          "", "visible_points"),
      row(&R::photons, "photon_sample", integer(1, most), "sppm: photons a pass", "", "photons"),
      row(&R::passes, "rounds", integer(1, most), "sppm: passes", "", "passes"),
      optional_row(&R::radius, "radius", number(positive_number), {"chosen from the scene"},
                   "sppm: first search radius", "scene units"),
      row(&R::radius_decay, "radius_decay", number(decay),
          "sppm: factor of the radius a pass, of the schedule \"geometric\""),
      row(&R::alpha, "alpha", fraction(open_unit_number),
          "sppm: fraction of new photons that a shrinking radius keeps"),
      row(&R::schedule, "schedule", choice({"pixel", "global", "geometric"}),
          "sppm: how the radius shrinks: for every pixel, once a pass, or by radius_decay"),
      row(&R::direct_light, "direct_light", choice({"shadow_rays", "photons"}),
          "sppm: what brings direct light"),
      disc_row("light_pos", vector(), optional, "base format: centre of a disc light that faces -y",
               "scene units"),
      disc_row("light_r", number(positive_number), optional, "base format: radius of the disc light",
               "scene units"),
      disc_row("light_radiance", color(non_negative_number), Vec3{10, 10, 10},
               "base format: radiance of the disc light"),
      optional_row(&R::indirect_radius, "indirect_radius", number(radius_factor), {"1"},
                   "sppm: times the radius, the search radius for photons that a diffuse surface has "
                   "scattered before"),
      optional_row(&R::guided_photons, "guided_photons", boolean(), {"the pilot decides"},
                   "sppm: visibility-driven Metropolis photons"),
      optional_row(&R::aimed_photons, "aimed_photons", boolean(),
                   {"true for directional lights and the environment"},
                   "sppm: projection map: more photons start where they become caustics"),
      row(&R::boundary_correction, "boundary_correction", boolean(),
          "sppm: divides by the part of the search disc that holds surface"),
      row(&R::sampler, "sampler", choice({"sobol", "independent"}),
          "samples of camera paths: low-discrepancy, or independent random numbers")};
  return rows;
}

const RendererKey& renderer_key(const std::string& name) {
  for (const RendererKey& row : renderer_keys())
    if (name == row.key.name) return row;
  throw std::logic_error("the renderer has no key \"" + name + "\"");
}

ValueType renderer_type() {
  static constexpr auto table = []() -> const SceneTable& {
    constexpr auto needs = KeyRule::Relation::needs;
    const char* const hint = "a disc light needs \"light_pos\" and \"light_r\"";
    std::vector<SceneKey> rows;
    for (const RendererKey& each : renderer_keys()) rows.push_back(each.key);
    static const SceneTable keys{"renderer",
                                 "",
                                 "renderer",
                                 std::move(rows),
                                 {{needs, "light_r", "light_pos", "", hint},
                                  {needs, "light_radiance", "light_pos", "", hint},
                                  {needs, "light_pos", "light_r", "", hint},
                                  {needs, "light_radiance", "light_r", "", hint}}};
    return keys;
  };
  return object("renderer", {table});
}

}  // namespace causticl
