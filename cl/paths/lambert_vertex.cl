// Lambert vertices: where a path outside of all bodies comes to a Lambert surface of a plain shape. Most paths end or scatter
// at such, whatever else the scene calls for, and what happens there takes neither loops nor arithmetic of whole vectors: a
// batch holds them, while others go one by one.
#include "lights/light.cl"
#include "scene/path_media.cl"

// Whether the surface at a hit is one.
INLINE bool meets_lambert(const Scene *scene, Hit hit) {
  if (hit.primitive == HIT_NONE) return false;
  if ((hit.primitive & HIT_SHAPE) && !is_plain(scene->geometry.shapes + (hit.primitive & ~HIT_SHAPE))) return false;
  global const Material *material = scene->materials + geometry_material(&scene->geometry, hit);
  if (HAS(EFFECTS_OF_LIGHTS(SURFACE)) && has_own_light(material)) return false;
  return material->kind == MATERIAL_DIFFUSE;
}

// Whether a path is outside of all bodies and on none.
INLINE bool is_outside(const Scene *scene, Interior interior, const PathMedia *media) {
  if (nested(scene)) return media->stack.count == 0 && media->contact == CONTACT_NONE;
  return !HAS(EFFECT_ABSORPTION) || !interior.glass;
}
