#include "study/study_parameters.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/spelling.hpp"
#include "format/json_document.hpp"
#include "format/scene_keys.hpp"
#include "scene/integrators.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

using Values = std::vector<ParameterValue>;
using Labels = std::vector<std::string>;

/// A key of the renderer set to each of the values that is not the scene's own.
Values settings_of(const std::string& key, const std::string& own, const std::vector<std::string>& values) {
  Values result;
  for (const auto& value : values)
    if (value != own) result.push_back({value, renderer_change(key, value)});
  return result;
}

/// The same of a key that always has a value.
Values settings_of(const std::string& key, const ParameterContext& context,
                   const std::vector<std::string>& values) {
  return settings_of(key, renderer_value(context.scene.renderer, key), values);
}

const char* name_of(bool on) { return on ? "true" : "false"; }

/// The key, as -D takes it, that sets the filter of a texture; empty where it has none, or one that cannot be
/// named so: by a name with a dot in it, or one that its pointer does not show as it is.
std::string filter_key(const TextureSpec& texture) {
  const std::string& pointer = texture.pointer;
  if (texture.kind != TextureSpec::Kind::image || pointer.find_first_of(".?") != std::string::npos) return "";
  std::string key;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/')
      key += key.empty() ? "" : ".";
    else if (pointer[i] == '~')
      key += pointer[++i] == '1' ? '/' : '~';  // RFC 6901
    else
      key += pointer[i];
  }
  return key.empty() ? "" : key + ".filter";
}

bool has_bilinear(const ParameterContext& context) {
  return std::any_of(context.scene.textures.begin(), context.scene.textures.end(),
                     [](const TextureSpec& texture) { return texture.bilinear; });
}

Values filters(const ParameterContext& context) {
  const bool bilinear = !has_bilinear(context);
  ParameterValue value{bilinear ? "bilinear" : "nearest", {}};
  const auto& textures = context.scene.textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const std::string key = filter_key(textures[i]);
    if (key.empty()) continue;
    const auto set = [=](Scene& scene, RenderOptions&) { scene.textures[i].bilinear = bilinear; };
    value.change = merged(value.change, other_change({"-D", key + "=" + value.label}, set));
  }
  return value.change.words.empty() ? Values{} : Values{value};
}

Values other_integrators(const ParameterContext& context) {
  Values values;
  for (const IntegratorRow& row : integrator_rows)
    if (row.integrator != context.scene.renderer.integrator)
      values.push_back({row.name, integrator_change(row.integrator)});
  return values;
}

/// What a pass of `points` visible points a pixel can hold.
bool fits(const Scene& scene, int points) {
  return std::int64_t{scene.width} * scene.height * points <= most_visible_points;
}

bool has_triangles(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), is_made_of_triangles);
}

}  // namespace

const std::vector<StudyParameter>& study_parameters() {
  using Context = const ParameterContext&;
  static const std::vector<StudyParameter> parameters{
      {"integrator", "Integrator", "",
       "Photon mapping (sppm) finds light that comes through glass and mirrors quickly but blurs it; path "
       "tracing (pt) blurs nothing but is noisy where small lamps shine through glass.",
       false, [](Context c) { return renderer_value(c.scene.renderer, "type"); }, other_integrators},
      {"photons", "Photons a pass", "photons",
       "More photons make each pass slower and less noisy; fewer let the radius shrink over more passes.",
       true, [](Context c) { return renderer_value(c.scene.renderer, "photon_sample"); },
       [](Context c) {
         Values values;
         for (const auto photons :
              {c.scene.renderer.photons / 16, c.scene.renderer.photons / 4, c.scene.renderer.photons * 4})
           if (photons >= 100 && photons <= 1 << 28)
             // A radius that is chosen from the scene would change with the photons.
             values.push_back(
                 {std::to_string(photons),
                  merged(photons_change(photons), renderer_change("radius", short_number(c.first_radius)))});
         return values;
       }},
      {"radius", "First search radius", "scene units",
       "Photons are counted within this distance: a larger one is smoother at first but blurs edges and "
       "caustics, and takes longer to search.",
       true, [](Context c) { return short_number(c.first_radius); },
       [](Context c) {
         return settings_of("radius", std::string(),
                            {short_number(c.first_radius / 2), short_number(c.first_radius * 2)});
       }},
      {"indirect_radius", "Radius for indirect light", "times the search radius",
       "Light that surfaces have scattered before is smooth, so that a larger radius takes noise from it and "
       "blurs little.",
       true, [](Context c) { return short_number(indirect_radius(c.scene.renderer)); },
       [](Context c) {
         return settings_of("indirect_radius", short_number(indirect_radius(c.scene.renderer)),
                            {"1", "2", "4"});
       }},
      {"boundary_correction", "Boundary correction", "",
       "Edges and corners cut off a part of what photons are counted in: it is either measured by one more "
       "ray, or left dark.",
       true, [](Context c) { return renderer_value(c.scene.renderer, "boundary_correction"); },
       [](Context c) {
         return settings_of("boundary_correction", c, {"true", "false"});
       }},
      {"guided_photons", "Metropolis photons", "",
       "Photons that land where the camera sees are copied with slight changes: more of them where few come "
       "so far, in place of some that could have been traced anew.",
       true, [](Context c) { return std::string(name_of(c.scene.renderer.guided_photons.value_or(false))); },
       [](Context c) {
         return settings_of("guided_photons", name_of(c.scene.renderer.guided_photons.value_or(false)),
                            {"false", "true"});
       }},
      {"aimed_photons", "Aimed photons", "",
       "Photons are sent more often where they become caustics: these have less noise, and the rest a little "
       "more.",
       true, [](Context c) { return std::string(name_of(aims_photons(c.scene))); },
       [](Context c) {
         return settings_of("aimed_photons", name_of(aims_photons(c.scene)), {"true", "false"});
       }},
      {"direct_light", "Direct light", "",
       "Light that comes straight from a lamp can be found by shadow rays, or by photons like all other "
       "light.",
       true, [](Context c) { return renderer_value(c.scene.renderer, "direct_light"); },
       [](Context c) {
         return settings_of("direct_light", c, {"shadow_rays", "photons"});
       }},
      {"alpha", "Alpha: how fast the radius shrinks", "share of new photons kept",
       "A small alpha shrinks the radius fast: less blur, more noise. In theory 2/3 balances the two.", true,
       [](Context c) { return renderer_value(c.scene.renderer, "alpha"); },
       [](Context c) {
         return settings_of("alpha", c, {"0.5", "0.6667", "0.9"});
       }},
      {"schedule", "Schedule of the radius", "",
       "Each pixel can have a radius of its own, or all one that depends on the pass alone; the geometric "
       "decay of older programs stops improving after a while.",
       true, [](Context c) { return renderer_value(c.scene.renderer, "schedule"); },
       [](Context c) {
         return settings_of("schedule", c, {"pixel", "global", "geometric"});
       }},
      {"visible_points", "Visible points of a pixel and pass", "points",
       "More camera paths a pass smooth edges and soft shadows sooner, and make each pass slower.", true,
       [](Context c) { return renderer_value(c.scene.renderer, "view_point_sample"); },
       [](Context c) {
         return settings_of("view_point_sample", c, fits(c.scene, 16) ? Labels{"1", "16"} : Labels{"1"});
       }},
      {"sampler", "Numbers of camera paths", "",
       "A pixel's samples can be spread evenly over where they may fall, by Sobol's sequence, or be "
       "independent "
       "of each other.",
       false, [](Context c) { return renderer_value(c.scene.renderer, "sampler"); },
       [](Context c) {
         return settings_of("sampler", c, {"sobol", "independent"});
       }},
      {"max_depth", "Longest path", "surface hits",
       "Shorter paths are faster and lose the light that would have come after more bounces: that error "
       "stays however long one renders.",
       false, [](Context c) { return std::to_string(c.scene.max_depth); },
       [](Context c) {
         Values values;
         for (const int depth : {2, 4, 8})
           if (depth < c.scene.max_depth)
             values.push_back({std::to_string(depth),
                               other_change({"-D", "max_depth=" + std::to_string(depth)},
                                            [=](Scene& scene, RenderOptions&) { scene.max_depth = depth; })});
         return values;
       }},
      {"triangle_test", "Test of rays against triangles", "",
       "The watertight test leaves no gaps between triangles; precomputed transforms are another way to the "
       "same hits, with rare gaps at edges.",
       false, [](Context) { return std::string("watertight"); },
       [](Context c) {
         const RenderChange precomputed = other_change(
             {"--triangle-test", "precomputed"},
             [](Scene&, RenderOptions& options) { options.triangle_test = TriangleTest::precomputed; });
         return has_triangles(c.scene) ? Values{{"precomputed", precomputed}} : Values{};
       }},
      {"precision", "Precision of arithmetic", "",
       "Double precision is slower; where its error is no smaller, single precision costs no accuracy.",
       false, [](Context) { return std::string("float"); },
       [](Context c) {
         const RenderChange in_double =
             other_change({"--precision", "double"},
                          [](Scene&, RenderOptions& options) { options.precision = Precision::float64; });
         return c.fp64 ? Values{{"double", in_double}} : Values{};
       }},
      {"texture_filter", "Lookup of image textures", "",
       "Bilinear lookup smooths the texels of an image, nearest shows them; the reference does what the "
       "scene "
       "says.",
       false, [](Context c) { return std::string(has_bilinear(c) ? "bilinear" : "nearest"); }, filters},
  };
  return parameters;
}

std::vector<const StudyParameter*> wanted_parameters(const std::vector<std::string>& names) {
  std::string known;
  std::vector<std::string> all;
  for (const StudyParameter& parameter : study_parameters()) {
    known += (known.empty() ? "" : ", ") + std::string(parameter.name);
    all.emplace_back(parameter.name);
  }
  for (const auto& name : names)
    if (std::none_of(study_parameters().begin(), study_parameters().end(),
                     [&](const StudyParameter& parameter) { return name == parameter.name; }))
      throw UserError("--parameters: there is no parameter " + json_quote(name) + "; expected some of " +
                      known + did_you_mean(name, all));
  std::vector<const StudyParameter*> wanted;
  for (const StudyParameter& parameter : study_parameters())
    if (names.empty() || std::find(names.begin(), names.end(), parameter.name) != names.end())
      wanted.push_back(&parameter);
  return wanted;
}

}  // namespace causticl
