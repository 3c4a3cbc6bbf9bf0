#include "effects.hpp"

#include <algorithm>

#include "effects.h"

namespace causticl {
namespace {

using Shape = Object::Shape;

/// Names the first object that `wanted` accepts, or nothing.
template <typename Predicate>
std::string first_object(const Scene& scene, const char* what, Predicate wanted) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(), wanted);
  return found == scene.objects.end() ? "" : std::string(what) + " " + found->pointer;
}

std::string by_shape(const Scene& scene, std::initializer_list<Shape> shapes, const char* what) {
  return first_object(scene, what, [&](const Object& object) {
    return std::find(shapes.begin(), shapes.end(), object.shape) != shapes.end();
  });
}

std::string by_material(const Scene& scene, MaterialSpec::Kind kind, const char* what) {
  return first_object(scene, what,
                      [&](const Object& object) { return scene.materials[object.material].kind == kind; });
}

std::string shadow_rays_reason(const Scene& scene) {
  if (scene.renderer.direct_light != DirectLight::shadow_rays) return "";
  return first_object(scene, "emission of", [&](const Object& object) {
    return object.shape != Shape::plane && max_component(scene.materials[object.material].emission) > 0;
  });
}

}  // namespace

Effects find_effects(const Scene& scene) {
  return {
      {EFFECT_TRIANGLES, "triangles",
       by_shape(scene, {Shape::mesh, Shape::rectangle, Shape::box}, "triangles of")},
      {EFFECT_SPHERES, "spheres", by_shape(scene, {Shape::sphere}, "sphere")},
      {EFFECT_PLANES, "planes", by_shape(scene, {Shape::plane}, "plane")},
      {EFFECT_DISKS, "disks", by_shape(scene, {Shape::disk}, "disk")},
      {EFFECT_BEZIER, "revolved curves", by_shape(scene, {Shape::bezier}, "revolved curve")},
      {EFFECT_TEXTURES, "textures",
       first_object(
           scene, "texture of",
           [&](const Object& object) { return scene.materials[object.material].color_texture >= 0; })},
      {EFFECT_MIRROR, "mirrors", by_material(scene, MaterialSpec::Kind::mirror, "mirror")},
      {EFFECT_GLASS, "glass", by_material(scene, MaterialSpec::Kind::glass, "glass")},
      {EFFECT_LENS, "depth of field", scene.camera.aperture > 0 ? "camera aperture" : ""},
      {EFFECT_SHADOW_RAYS, "direct light by shadow rays", shadow_rays_reason(scene)},
      {EFFECT_ROUGH, "rough lobes",
       first_object(scene, "roughness of",
                    [&](const Object& object) { return scene.materials[object.material].roughness > 0; })},
      {EFFECT_CONDUCTOR, "conductors", by_material(scene, MaterialSpec::Kind::conductor, "conductor")},
      {EFFECT_PLASTIC, "plastic", by_material(scene, MaterialSpec::Kind::plastic, "plastic")},
  };
}

unsigned effect_bits(const Effects& effects) {
  unsigned bits = 0;
  for (const auto& effect : effects)
    if (!effect.reason.empty()) bits |= effect.bit;
  return bits;
}

}  // namespace causticl
