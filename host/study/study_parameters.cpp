#include "study/study_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"
#include "base/spelling.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

using Values = std::vector<ParameterValue>;

/// `key` set by -D to each of the values that is not the scene's own.
Values overrides(const std::string& key, const std::string& own, const std::vector<std::string>& values) {
  Values result;
  for (const auto& value : values)
    if (value != own) result.push_back({value, {"-D", key + "=" + value}});
  return result;
}

const char* name_of(Schedule schedule) {
  return schedule == Schedule::pixel ? "pixel" : schedule == Schedule::global ? "global" : "geometric";
}

const char* name_of(bool on) { return on ? "true" : "false"; }

const char* name_of(Sampler sampler) { return sampler == Sampler::sobol ? "sobol" : "independent"; }

/// Every image texture inside materials, as keys joined by dots: those have a filter.
void find_filters(const JsonValue& value, const std::string& path, bool in_material,
                  std::vector<std::string>& keys) {
  if (in_material && value.kind == JsonValue::Kind::object) {
    const JsonValue* type = value.member("type");
    if (type && type->text == "image") keys.push_back(path + ".filter");
  }
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const JsonMember& member : value.members)
    // A key with a dot in it cannot be named by -D.
    if (member.key.find('.') == std::string::npos)
      find_filters(member.value, prefix + member.key,
                   in_material || member.key == "material" || member.key == "materials", keys);
  for (std::size_t i = 0; i < value.items.size(); ++i)
    find_filters(value.items[i], prefix + std::to_string(i), in_material, keys);
}

bool has_bilinear(const ParameterContext& context) {
  return std::any_of(context.scene.textures.begin(), context.scene.textures.end(),
                     [](const TextureSpec& texture) { return texture.bilinear; });
}

Values filters(const ParameterContext& context) {
  std::vector<std::string> keys;
  find_filters(context.document.root, "", false, keys);
  if (keys.empty()) return {};
  ParameterValue value{has_bilinear(context) ? "nearest" : "bilinear", {}};
  for (const auto& key : keys) {
    value.words.push_back("-D");
    value.words.push_back(key + "=" + value.label);
  }
  return {value};
}

bool has_triangles(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), is_made_of_triangles);
}

}  // namespace

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, std::fabs(value) >= 1000 && std::fabs(value) < 1e9 ? "%.0f" : "%.4g",
                value);
  return text;
}

const std::vector<StudyParameter>& study_parameters() {
  using Context = const ParameterContext&;
  static const std::vector<StudyParameter> parameters{
      {"integrator", "Integrator", "",
       "Photon mapping (sppm) finds light that comes through glass and mirrors quickly but blurs it; path "
       "tracing (pt) blurs nothing but is noisy where small lamps shine through glass.",
       false,
       [](Context c) { return std::string(c.scene.renderer.integrator == Integrator::pt ? "pt" : "sppm"); },
       [](Context c) {
         const std::string other = c.scene.renderer.integrator == Integrator::pt ? "sppm" : "pt";
         return Values{{other, {"--integrator", other}}};
       }},
      {"photons", "Photons a pass", "photons",
       "More photons make each pass slower and less noisy; fewer let the radius shrink over more passes.",
       true, [](Context c) { return std::to_string(c.scene.renderer.photons); },
       [](Context c) {
         Values values;
         for (const auto photons :
              {c.scene.renderer.photons / 16, c.scene.renderer.photons / 4, c.scene.renderer.photons * 4})
           if (photons >= 100 && photons <= 1 << 28)
             // A radius that is chosen from the scene would change with the photons.
             values.push_back({std::to_string(photons),
                               {"--photons", std::to_string(photons), "-D",
                                "renderer.radius=" + short_number(c.first_radius)}});
         return values;
       }},
      {"radius", "First search radius", "scene units",
       "Photons are counted within this distance: a larger one is smoother at first but blurs edges and "
       "caustics, and takes longer to search.",
       true, [](Context c) { return short_number(c.first_radius); },
       [](Context c) {
         return overrides("renderer.radius", "",
                          {short_number(c.first_radius / 2), short_number(c.first_radius * 2)});
       }},
      {"indirect_radius", "Radius for indirect light", "times the search radius",
       "Light that surfaces have scattered before is smooth, so that a larger radius takes noise from it and "
       "blurs little.",
       true, [](Context c) { return short_number(indirect_radius(c.scene.renderer)); },
       [](Context c) {
         return overrides("renderer.indirect_radius", short_number(indirect_radius(c.scene.renderer)),
                          {"1", "2", "4"});
       }},
      {"boundary_correction", "Boundary correction", "",
       "Edges and corners cut off a part of what photons are counted in: it is either measured by one more "
       "ray, or left dark.",
       true, [](Context c) { return std::string(name_of(c.scene.renderer.boundary_correction)); },
       [](Context c) {
         return overrides("renderer.boundary_correction", name_of(c.scene.renderer.boundary_correction),
                          {"true", "false"});
       }},
      {"guided_photons", "Metropolis photons", "",
       "Photons that land where the camera sees are copied with slight changes: more of them where few come "
       "so far, in place of some that could have been traced anew.",
       true, [](Context c) { return std::string(name_of(c.scene.renderer.guided_photons.value_or(false))); },
       [](Context c) {
         return overrides("renderer.guided_photons", name_of(c.scene.renderer.guided_photons.value_or(false)),
                          {"false", "true"});
       }},
      {"aimed_photons", "Aimed photons", "",
       "Photons are sent more often where they become caustics: these have less noise, and the rest a little "
       "more.",
       true, [](Context c) { return std::string(name_of(aims_photons(c.scene))); },
       [](Context c) {
         return overrides("renderer.aimed_photons", name_of(aims_photons(c.scene)), {"true", "false"});
       }},
      {"direct_light", "Direct light", "",
       "Light that comes straight from a lamp can be found by shadow rays, or by photons like all other "
       "light.",
       true,
       [](Context c) {
         return std::string(c.scene.renderer.direct_light == DirectLight::photons ? "photons"
                                                                                  : "shadow_rays");
       },
       [](Context c) {
         return overrides("renderer.direct_light",
                          c.scene.renderer.direct_light == DirectLight::photons ? "photons" : "shadow_rays",
                          {"shadow_rays", "photons"});
       }},
      {"alpha", "Alpha: how fast the radius shrinks", "share of new photons kept",
       "A small alpha shrinks the radius fast: less blur, more noise. In theory 2/3 balances the two.", true,
       [](Context c) { return short_number(c.scene.renderer.alpha); },
       [](Context c) {
         return overrides("renderer.alpha", short_number(c.scene.renderer.alpha), {"0.5", "0.6667", "0.9"});
       }},
      {"schedule", "Schedule of the radius", "",
       "Each pixel can have a radius of its own, or all one that depends on the pass alone; the geometric "
       "decay of older programs stops improving after a while.",
       true, [](Context c) { return std::string(name_of(c.scene.renderer.schedule)); },
       [](Context c) {
         return overrides("renderer.schedule", name_of(c.scene.renderer.schedule),
                          {"pixel", "global", "geometric"});
       }},
      {"visible_points", "Visible points of a pixel and pass", "points",
       "More camera paths a pass smooth edges and soft shadows sooner, and make each pass slower.", true,
       [](Context c) { return std::to_string(c.scene.renderer.visible_points); },
       [](Context c) {
         return overrides("renderer.view_point_sample", std::to_string(c.scene.renderer.visible_points),
                          {"1", "16"});
       }},
      {"sampler", "Numbers of camera paths", "",
       "A pixel's samples can be spread evenly over where they may fall, by Sobol's sequence, or be "
       "independent "
       "of each other.",
       false, [](Context c) { return std::string(name_of(c.scene.renderer.sampler)); },
       [](Context c) {
         return overrides("renderer.sampler", name_of(c.scene.renderer.sampler), {"sobol", "independent"});
       }},
      {"max_depth", "Longest path", "surface hits",
       "Shorter paths are faster and lose the light that would have come after more bounces: that error "
       "stays however long one renders.",
       false, [](Context c) { return std::to_string(c.scene.max_depth); },
       [](Context c) {
         Values values;
         for (const int depth : {2, 4, 8})
           if (depth < c.scene.max_depth)
             values.push_back({std::to_string(depth), {"-D", "max_depth=" + std::to_string(depth)}});
         return values;
       }},
      {"triangle_test", "Test of rays against triangles", "",
       "The watertight test leaves no gaps between triangles; precomputed transforms are another way to the "
       "same hits, with rare gaps at edges.",
       false, [](Context) { return std::string("watertight"); },
       [](Context c) {
         return has_triangles(c.scene) ? Values{{"precomputed", {"--triangle-test", "precomputed"}}}
                                       : Values{};
       }},
      {"precision", "Precision of arithmetic", "",
       "Double precision is slower; where its error is no smaller, single precision costs no accuracy.",
       false, [](Context) { return std::string("float"); },
       [](Context c) {
         return c.fp64 ? Values{{"double", {"--precision", "double"}}} : Values{};
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
