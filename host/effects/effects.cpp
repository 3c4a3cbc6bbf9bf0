#include "effects/effects.hpp"

#include <algorithm>
#include <sstream>

#include "base/error.hpp"
#include "base/spelling.hpp"
#include "effects/walls_reason.hpp"
#include "scene/dielectrics.hpp"
#include "scene/object_triangles.hpp"
#include "shared/effects.h"

namespace causticl {
namespace {

using Shape = Object::Shape;
using Kind = MaterialSpec::Kind;

/// Names what calls for an effect: the first object that `wanted` accepts, by `describe`, and how many more.
template <typename Predicate, typename Describe>
std::string first_object(const Scene& scene, const Predicate& wanted, const Describe& describe) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(), wanted);
  if (found == scene.objects.end()) return "";
  const auto more = std::count_if(found + 1, scene.objects.end(), wanted);
  return describe(*found) + (more ? " and " + std::to_string(more) + " more" : "");
}

const char* shape_name(Shape shape) {
  static constexpr const char* names[] = {"sphere", "plane", "rectangle", "disk", "box", "mesh", "curve"};
  return names[static_cast<int>(shape)];
}

std::string by_shape(const Scene& scene, std::initializer_list<Shape> shapes) {
  const auto wanted = [&](const Object& object) {
    return std::find(shapes.begin(), shapes.end(), object.shape) != shapes.end();
  };
  return first_object(scene, wanted, [](const Object& object) {
    return object.is_disc_light ? "light_pos of " + object.pointer
                                : std::string(shape_name(object.shape)) + " " + object.pointer;
  });
}

/// `what` is the key of the material that calls for the effect.
template <typename Predicate>
std::string by_material(const Scene& scene, const char* what, const Predicate& wanted) {
  const auto material = [&](const Object& object) -> const MaterialSpec& {
    return scene.materials[static_cast<std::size_t>(object.material)];
  };
  return first_object(
      scene, [&](const Object& object) { return wanted(material(object)); },
      [&](const Object& object) {
        const std::string& pointer = material(object).pointer;
        const bool inline_material = pointer.rfind(object.pointer, 0) == 0;
        return std::string(what) + " of " + pointer + (inline_material ? "" : " on " + object.pointer);
      });
}

std::string by_kind(const Scene& scene, Kind kind, const char* what) {
  return by_material(scene, what, [&](const MaterialSpec& material) { return material.kind == kind; });
}

std::string environment_reason(const Scene& scene) {
  return scene.environment && is_lit(*scene.environment) ? "environment " + scene.environment->pointer : "";
}

std::string delta_lights_reason(const Scene& scene) {
  const auto found = std::find_if(scene.lights.begin(), scene.lights.end(),
                                  [](const DeltaLight& light) { return is_lit(light); });
  return found == scene.lights.end() ? "" : "light " + found->pointer;
}

/// Shadow rays want something to go to: infinite planes, which are never sampled, do not count.
std::string shadow_rays_reason(const Scene& scene) {
  if (scene.renderer.direct_light != DirectLight::shadow_rays) return "";
  const auto wanted = [&](const Object& object) {
    return object.shape != Shape::plane && is_lit(scene, object);
  };
  const std::string key = "/renderer/direct_light with the ";
  std::string surface =
      first_object(scene, wanted, [&](const Object& object) { return key + "emitter " + object.pointer; });
  if (!surface.empty()) return surface;
  const std::string delta_light = delta_lights_reason(scene), environment = environment_reason(scene);
  if (!delta_light.empty()) return key + delta_light;
  return environment.empty() ? "" : key + environment;
}

/// Planes that light from beyond the scene reaches to the horizon.
std::string horizon_reason(const Scene& scene) {
  return has_infinite_light(scene) ? by_shape(scene, {Shape::plane}) : "";
}

/// Light becomes a caustic by what is not diffuse.
std::string aimed_photons_reason(const Scene& scene) {
  if (!aims_photons(scene)) return "";
  return by_material(scene, "type",
                     [](const MaterialSpec& material) { return material.kind != Kind::diffuse; });
}

std::string motion_reason(const Scene& scene) {
  if (!has_motion(scene)) return "";
  return first_object(
      scene, [](const Object& object) { return length(object.motion) > 0; },
      [](const Object& object) { return "motion of " + object.pointer; });
}

std::string smooth_reason(const Scene& scene) {
  return first_object(
      scene,
      [&](const Object& object) {
        return object.shape == Shape::mesh && object.smooth &&
               !scene.meshes[static_cast<std::size_t>(object.mesh)].normal_index.empty();
      },
      [](const Object& object) { return "normals of mesh " + object.pointer; });
}

std::string slivers_reason(const Scene& scene) {
  return first_object(
      scene, [&](const Object& object) { return has_slivers(scene, object); },
      [](const Object& object) {
        return "triangles of " + std::string(shape_name(object.shape)) + " " + object.pointer;
      });
}

bool fills(const MediumSpec& medium) {
  return max_component(medium.absorption) > 0 || max_component(medium.scattering) > 0;
}

}  // namespace

Effects find_effects(const Scene& scene) {
  return {
      {EFFECT_TRIANGLES, "triangles", "triangles",
       by_shape(scene, {Shape::mesh, Shape::rectangle, Shape::box})},
      {EFFECT_SPHERES, "spheres", "spheres", by_shape(scene, {Shape::sphere})},
      {EFFECT_PLANES, "planes", "infinite planes", by_shape(scene, {Shape::plane})},
      {EFFECT_DISKS, "disks", "disks", by_shape(scene, {Shape::disk})},
      {EFFECT_BEZIER, "curves", "revolved curves", by_shape(scene, {Shape::bezier})},
      {EFFECT_TEXTURES, "textures", "textures",
       by_material(scene, "texture",
                   [](const MaterialSpec& material) { return material.color_texture >= 0; })},
      {EFFECT_MIRROR, "mirror", "mirrors", by_kind(scene, Kind::mirror, "mirror")},
      {EFFECT_GLASS, "glass", "glass", by_kind(scene, Kind::glass, "glass")},
      {EFFECT_LENS, "lens", "depth of field", scene.camera.aperture > 0 ? "/camera/aperture" : ""},
      {EFFECT_SHADOW_RAYS, "shadow_rays", "direct light by shadow rays", shadow_rays_reason(scene)},
      {EFFECT_ROUGH, "rough", "rough lobes",
       by_material(scene, "roughness", [](const MaterialSpec& material) { return material.roughness > 0; })},
      {EFFECT_CONDUCTOR, "conductor", "conductors", by_kind(scene, Kind::conductor, "conductor")},
      {EFFECT_PLASTIC, "plastic", "plastic", by_kind(scene, Kind::plastic, "plastic")},
      {EFFECT_ENVIRONMENT, "environment", "light from beyond the scene", environment_reason(scene)},
      {EFFECT_DELTA_LIGHTS, "delta_lights", "point, spot and directional lights", delta_lights_reason(scene)},
      {EFFECT_ABSORPTION, "absorption", "absorption in glass",
       by_material(scene, "absorption",
                   [](const MaterialSpec& material) { return max_component(material.absorption) > 0; })},
      {EFFECT_DISPERSION, "dispersion", "dispersion",
       by_material(scene, "cauchy", [](const MaterialSpec& material) { return material.dispersion > 0; })},
      {EFFECT_MOTION, "motion", "motion blur", motion_reason(scene)},
      {EFFECT_MEDIUM, "medium", "medium", fills(scene.medium) ? "/medium" : ""},
      {EFFECT_GUIDED_PHOTONS, "guided_photons", "photons guided to what the camera sees",
       scene.renderer.guided_photons.value_or(false) ? "/renderer/guided_photons" : ""},
      {EFFECT_AIMED_PHOTONS, "aimed_photons", "photons aimed at what focuses them",
       aimed_photons_reason(scene)},
      {EFFECT_SMOOTH, "smooth", "shading normals", smooth_reason(scene)},
      {EFFECT_SLIVERS, "needles", "thin triangles", slivers_reason(scene)},
      {EFFECT_NESTED, "nested", "dielectrics that touch or hold something", find_dielectrics(scene).reason},
      {EFFECT_WALLS, "walls", "walls between photons and visible points", walls_reason(scene)},
      {EFFECT_HORIZON, "horizon", "light from beyond the scene on infinite planes", horizon_reason(scene)},
  };
}

unsigned effect_bits(const Effects& effects) {
  unsigned bits = 0;
  for (const auto& effect : effects)
    if (!effect.reason.empty()) bits |= effect.bit;
  return bits;
}

std::string effect_keys(const Effects& effects, unsigned bits) {
  std::string text;
  for (const auto& effect : effects)
    if (effect.bit & bits) text += (text.empty() ? "" : ", ") + effect.key;
  return text;
}

unsigned chosen_effects(const Effects& effects, const std::string& choice) {
  if (choice == "auto") return effect_bits(effects);
  if (choice == "all") return EFFECT_ALL;
  unsigned bits = 0;
  std::istringstream list(choice);
  for (std::string key; std::getline(list, key, ',');) {
    const auto found =
        std::find_if(effects.begin(), effects.end(), [&](const Effect& effect) { return effect.key == key; });
    if (found == effects.end()) {
      std::vector<std::string> keys{"auto", "all"};
      for (const auto& effect : effects) keys.push_back(effect.key);
      throw UserError("--effects: no effect is called '" + key + "'; expected auto, all, or a list of " +
                      effect_keys(effects, EFFECT_ALL) + did_you_mean(key, keys));
    }
    bits |= found->bit;
  }
  for (const auto& effect : effects)
    if (!effect.reason.empty() && !(effect.bit & bits))
      throw UserError("--effects " + choice + ": the scene calls for " + effect.key + " (" + effect.reason +
                      "); expected a list with " + effect_keys(effects, effect_bits(effects)));
  return bits;
}

}  // namespace causticl
