// Lambert vertices: where a path outside of all bodies comes to a Lambert surface of a plain shape. Most paths end or scatter
// at such, whatever else the scene calls for, and what happens there takes neither loops nor arithmetic of whole vectors: a
// batch holds them, while others go one by one.
#include "lights/horizon.cl"
#include "scene/path_media.cl"

// Whether what a ray meets at `hit` is surely not far (horizon.cl): unless it comes from very far, the place by the ray alone
// is wrong by less.
INLINE bool is_near(const Geometry *g, Ray ray, Hit hit) {
  if (!has_horizon(g) || !(hit.primitive & HIT_SHAPE)) return true;
  real3 from_centre = sub3(ray_at(ray.origin, hit.t, ray.direction), convert_real3(g->shapes[0].sphere.xyz));
  real radius = (real)0.99f * g->shapes[0].sphere.w;
  return hit.t < 10000 * radius && dot3(from_centre, from_centre) < radius * radius;
}

// Whether the surface that `ray` meets at `hit` is one.
INLINE bool meets_lambert(const Scene *scene, Ray ray, Hit hit) {
  if (hit.primitive == HIT_NONE || !is_near(&scene->geometry, ray, hit)) return false;
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
