#include "scene/scene.hpp"

#include <algorithm>

#include "scene/integrators.hpp"
#include "scene/light_kind.hpp"
#include "scene/object_triangles.hpp"

namespace causticl {

float emission_of(const Scene& scene, const Object& object) {
  return static_cast<float>(
      max_component(scene.materials[static_cast<std::size_t>(object.material)].emission));
}

bool is_lit(const LightSpec& light) {
  const std::vector<float>& rgba = light.map.rgba;
  for (std::size_t i = 0; i < rgba.size(); ++i)
    if (i % 4 != 3 && rgba[i] > 0) return true;
  return rgba.empty() && static_cast<float>(max_component(light.intensity)) > 0;
}

bool is_lit(const Scene& scene, const Object& object) {
  if (!(emission_of(scene, object) > 0)) return false;
  bool is_made_of_triangles = false;
  const bool has_none = visit_triangles(scene, object, [&](const TriangleCorner(&corners)[3], bool) {
    is_made_of_triangles = true;
    return !(triangle_area(corners) > 0);
  });
  return !has_none || !is_made_of_triangles;
}

double indirect_radius(const RendererSpec& renderer) { return renderer.indirect_radius.value_or(1.0); }

namespace {

/// Whether a light of one of the families or properties gives light.
bool has_lit(const Scene& scene, unsigned wanted) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const LightSpec& light) {
    return has_property(light.kind, wanted) && is_lit(light);
  });
}

}  // namespace

bool has_light(const Scene& scene) { return has_visible_light(scene) || has_lit(scene, ~0u); }

bool has_visible_light(const Scene& scene) {
  return has_lit(scene, BACKGROUND) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& object) { return is_lit(scene, object); });
}

bool has_infinite_light(const Scene& scene) { return has_lit(scene, BEYOND_SCENE); }

bool aims_photons(const Scene& scene) {
  return traces_photons(scene.renderer.integrator) &&
         scene.renderer.aimed_photons.value_or(has_infinite_light(scene));
}

bool has_motion(const Scene& scene) {
  return scene.camera.shutter[1] > scene.camera.shutter[0] &&
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& object) { return length(object.motion) > 0; });
}

}  // namespace causticl
