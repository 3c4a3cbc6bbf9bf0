#include "effects/effect_reasons.hpp"

#include <algorithm>

#include "effects/walls_reason.hpp"
#include "scene/dielectrics.hpp"
#include "scene/light_kind.hpp"
#include "scene/material_kind.hpp"
#include "scene/shape_kind.hpp"

namespace causticl {
namespace {

/// Names what calls for an effect: the first object that `wanted` accepts, by `describe`, and how many more.
template <typename Predicate, typename Describe>
std::string first_object(const Scene& scene, const Predicate& wanted, const Describe& describe) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(), wanted);
  if (found == scene.objects.end()) return "";
  const auto more = std::count_if(found + 1, scene.objects.end(), wanted);
  return describe(*found) + (more ? " and " + std::to_string(more) + " more" : "");
}

std::string by_shape(const Scene& scene, EffectBit effect) {
  return first_object(
      scene, [&](const Object& object) { return effect_of(object.shape) == effect; },
      [](const Object& object) {
        return object.is_disc_light ? "light_pos of " + object.pointer
                                    : std::string(name_of(object.shape)) + " " + object.pointer;
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

std::string by_kind(const Scene& scene, unsigned effect) {
  const auto wanted = [&](const MaterialSpec& material) { return effect_of(material.kind) == effect; };
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(), wanted);
  return found == scene.materials.end() ? "" : by_material(scene, name_of(found->kind), wanted);
}

/// The first light that gives light and that `wanted` accepts.
template <typename Predicate>
std::string by_light(const Scene& scene, const Predicate& wanted) {
  const auto found = std::find_if(scene.lights.begin(), scene.lights.end(), [&](const LightSpec& light) {
    return wanted(row_of(light.kind)) && is_lit(light);
  });
  return found == scene.lights.end() ? "" : row_of(found->kind).text + (" " + found->pointer);
}

bool fills(const MediumSpec& medium) {
  return max_component(medium.absorption) > 0 || max_component(medium.scattering) > 0;
}

}  // namespace

// Effects that stand for primitives are called for by shapes: see effect_of(). The others have functions
// below.
#define DEFINE_REASON_OF_SHAPES(name)                            \
  template <>                                                    \
  std::string effect_reason<EFFECT_##name>(const Scene& scene) { \
    return by_shape(scene, EFFECT_##name);                       \
  }
#define REASON_OF_TRIANGLE_LEAVES(name) DEFINE_REASON_OF_SHAPES(name)
#define REASON_OF_SHAPE_LEAVES(name) DEFINE_REASON_OF_SHAPES(name)
#define REASON_OF_UNBOUNDED(name) DEFINE_REASON_OF_SHAPES(name)
#define REASON_OF_NO_GEOMETRY(name)
#define REASON_OF_ROW(x, name, bit, key, programs, scalar, geometry, text) REASON_OF_##geometry(name)
EFFECT_TABLE(REASON_OF_ROW, )

template <>
std::string effect_reason<EFFECT_TEXTURES>(const Scene& scene) {
  return by_material(scene, "texture",
                     [](const MaterialSpec& material) { return material.color_texture >= 0; });
}

template <>
std::string effect_reason<EFFECT_LENS>(const Scene& scene) {
  return scene.camera.aperture > 0 ? "/camera/aperture" : "";
}

/// Shadow rays want something to go to: infinite planes, which are never sampled, do not count.
template <>
std::string effect_reason<EFFECT_SHADOW_RAYS>(const Scene& scene) {
  if (scene.renderer.direct_light != DirectLight::shadow_rays) return "";
  const auto wanted = [&](const Object& object) { return !is_infinite(object) && is_lit(scene, object); };
  const std::string key = "/renderer/direct_light with the ";
  std::string surface =
      first_object(scene, wanted, [&](const Object& object) { return key + "emitter " + object.pointer; });
  if (!surface.empty()) return surface;
  const std::string light = by_light(scene, [](const LightRow&) { return true; });
  return light.empty() ? "" : key + light;
}

template <>
std::string effect_reason<EFFECT_ROUGH>(const Scene& scene) {
  return by_material(scene, "roughness", [](const MaterialSpec& material) { return material.roughness > 0; });
}

template <>
std::string effect_reason<EFFECT_ABSORPTION>(const Scene& scene) {
  return by_material(scene, "absorption",
                     [](const MaterialSpec& material) { return max_component(material.absorption) > 0; });
}

template <>
std::string effect_reason<EFFECT_DISPERSION>(const Scene& scene) {
  return by_material(scene, "cauchy", [](const MaterialSpec& material) { return material.dispersion > 0; });
}

template <>
std::string effect_reason<EFFECT_MOTION>(const Scene& scene) {
  if (!has_motion(scene)) return "";
  return first_object(
      scene, [](const Object& object) { return length(object.motion) > 0; },
      [](const Object& object) { return "motion of " + object.pointer; });
}

template <>
std::string effect_reason<EFFECT_MEDIUM>(const Scene& scene) {
  return fills(scene.medium) ? "/medium" : "";
}

template <>
std::string effect_reason<EFFECT_GUIDED_PHOTONS>(const Scene& scene) {
  return scene.renderer.guided_photons.value_or(false) ? "/renderer/guided_photons" : "";
}

/// Light becomes a caustic by what is not diffuse.
template <>
std::string effect_reason<EFFECT_AIMED_PHOTONS>(const Scene& scene) {
  if (!aims_photons(scene)) return "";
  return by_material(scene, "type", [](const MaterialSpec& material) {
    return !has_property(material.kind, DIFFUSE_FAMILIES);
  });
}

template <>
std::string effect_reason<EFFECT_SMOOTH>(const Scene& scene) {
  return first_object(
      scene,
      [&](const Object& object) {
        return object.mesh >= 0 && object.smooth &&
               !scene.meshes[static_cast<std::size_t>(object.mesh)].normal_index.empty();
      },
      [](const Object& object) { return "normals of mesh " + object.pointer; });
}

template <>
std::string effect_reason<EFFECT_SLIVERS>(const Scene& scene) {
  return first_object(
      scene, [&](const Object& object) { return has_slivers(scene, object); },
      [](const Object& object) {
        return "triangles of " + std::string(name_of(object.shape)) + " " + object.pointer;
      });
}

template <>
std::string effect_reason<EFFECT_NESTED>(const Scene& scene) {
  return find_dielectrics(scene).reason;
}

template <>
std::string effect_reason<EFFECT_WALLS>(const Scene& scene) {
  return walls_reason(scene);
}

/// Planes that light from beyond the scene reaches to the horizon.
template <>
std::string effect_reason<EFFECT_HORIZON>(const Scene& scene) {
  return has_infinite_light(scene) ? by_shape(scene, EFFECT_PLANES) : "";
}

#define REASON_OF_LIGHT(x, name, ...)                                                            \
  template <>                                                                                    \
  std::string effect_reason<EFFECT_##name>(const Scene& scene) {                                 \
    return by_light(scene, [](const LightRow& light) { return light.effect == EFFECT_##name; }); \
  }
LIGHT_EFFECTS(REASON_OF_LIGHT, )

#define REASON_OF_MATERIAL(x, name, ...)                         \
  template <>                                                    \
  std::string effect_reason<EFFECT_##name>(const Scene& scene) { \
    return by_kind(scene, EFFECT_##name);                        \
  }
MATERIAL_EFFECTS(REASON_OF_MATERIAL, )

}  // namespace causticl
