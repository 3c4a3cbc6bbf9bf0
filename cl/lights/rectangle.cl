// A rectangle whose radiance is an image, constant over each texel. Points are drawn in proportion to the largest channel
// of what they emit: a texel by the whole numbers that it owns, then a point of it.
#include "lights/area_light.cl"

// Where the rectangle's texel of a column and a row, from the corner `a`, lies among those of all maps.
INLINE global const EnvironmentTexel *rectangle_texel(const Scene *scene, global const Emitter *emitter, uint column, uint row) {
  return scene->environment + emitter->shape + (size_t)row * (uint)emitter->b.w + column;
}

// The density per area with which points of the texel are drawn, given the emitter.
INLINE real rectangle_area_pdf(global const Emitter *emitter, global const EnvironmentTexel *texel) {
  return texel->density / emitter->radiance.w;
}

// The texel at a place of the unit square.
INLINE global const EnvironmentTexel *rectangle_at(const Scene *scene, global const Emitter *emitter, real2 uv) {
  uint width = (uint)emitter->b.w, height = (uint)emitter->c.w;
  uint column = min((uint)fmax(uv.x * width, (real)0), width - 1), row = min((uint)fmax(uv.y * height, (real)0), height - 1);
  return rectangle_texel(scene, emitter, column, row);
}

INLINE real3 texel_radiance(global const EnvironmentTexel *texel) {
  return (real3)(texel->radiance[0], texel->radiance[1], texel->radiance[2]);
}

// The point that `number`, of those that the emitter owns, and u choose, and the *radiance there.
INLINE LightPoint rectangle_point(const Scene *scene, global const Emitter *emitter, ulong number, real2 u, real3 *radiance) {
  uint width = (uint)emitter->b.w, height = (uint)emitter->c.w;
  uint chosen = map_texel(scene->environment + emitter->shape, width * height, number);
  global const EnvironmentTexel *texel = scene->environment + emitter->shape + chosen;
  real3 a = convert_real3(emitter->a.xyz), b = convert_real3(emitter->b.xyz), c = convert_real3(emitter->c.xyz);
  real x = (chosen % width + u.x) / width, y = (chosen / width + u.y) / height;
  LightPoint point;
  point.position = add3(a, add3(scaled3(x, b), scaled3(y, c)));
  // Scaled first: the product of long or short edges leaves the range of a float.
  point.normal = unit3(cross3(quotient3(b, max_component(abs3(b))), quotient3(c, max_component(abs3(c)))));
  point.error = STORED_GAMMA(8) * max_component(add3(add3(abs3(a), abs3(b)), add3(abs3(c), abs3(point.position))));
  point.area_pdf = rectangle_area_pdf(emitter, texel);
  *radiance = texel_radiance(texel);
  return point;
}

INLINE LightSample rectangle_sample(const Scene *scene, global const Emitter *emitter, real3 position, real4 random) {
  real3 radiance;
  ulong number = owned_number(scene, emitter, random.x, random.w);
  LightPoint point = rectangle_point(scene, emitter, number, random.yz, &radiance);
  bool edge_on;
  LightSample sample = light_from_point(emitter, position, point, &edge_on);
  sample.weight = sample.pdf > 0 && !edge_on ? quotient3(radiance, sample.pdf) : (real3)(0, 0, 0);
  return sample;
}

// A photon: a point in proportion to what it emits, direction by cosine.
INLINE Ray rectangle_emit(const Scene *scene, global const Emitter *emitter, real4 choice, real2 u, real3 *flux) {
  real3 radiance;
  ulong number = owned_number(scene, emitter, choice.x, choice.w);
  LightPoint point = rectangle_point(scene, emitter, number, choice.yz, &radiance);
  real3 normal = emitter->two_sided != 0 && choice.w < (real)0.5f ? negated3(point.normal) : point.normal;
  Ray ray;
  ray.direction = hemisphere_cosine_by(u.x, u.y, normal);
  ray.origin = offset_origin(point.position, point.error, normal, ray.direction);
  real whole = emitter->radiance.x * emitter->radiance.w * point.area_pdf;
  *flux = whole > 0 ? quotient3(radiance, whole) : (real3)(0, 0, 0);
  return ray;
}

// Radiance of the side that emits, at a place of the unit square.
INLINE real3 rectangle_emission(const Scene *scene, global const Emitter *emitter, const Surface *surface) {
  return texel_radiance(rectangle_at(scene, emitter, surface->uv));
}

INLINE real rectangle_pdf(const Scene *scene, global const Emitter *emitter, real3 direction, Hit hit,
                          const Surface *surface) {
  real area_pdf = emitter->probability * rectangle_area_pdf(emitter, rectangle_at(scene, emitter, surface->uv));
  real cosine = fabs(dot3(direction, surface->geometric_normal));
  return cosine > 0 ? area_pdf * hit.t * hit.t / cosine : 0;
}
