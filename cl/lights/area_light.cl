// Emissive surfaces: points on them, light that arrives from them, photons that leave them.
#include "lights/light_sample.cl"

// Density per area of points that emitter_point draws on this radiance, choice of emitter included.
INLINE real emitter_area_pdf(const Scene *scene, real3 radiance, bool two_sided) {
  return max_component(radiance) * (two_sided ? 2 : 1) * scene->emitter_density;
}

// A point on an emitter with its outward unit normal, *error as in Surface and *pdf per area given the emitter.
INLINE real3 emitter_point(const Scene *scene, global const Emitter *emitter, real u, real v, real3 *normal,
                           real *error, real *pdf) {
  global const float *row = (global const float *)emitter;
  real3 a = (real3)(row[0], row[1], row[2]), b = (real3)(row[4], row[5], row[6]), c = (real3)(row[8], row[9], row[10]);
  uint type = emitter->type;
  // Scaled first: the product of long or short edges leaves the range of a float.
  real3 across = cross3(quotient3(b, max_component(abs3(b))), quotient3(c, max_component(abs3(c))));
  across = unit3(scaled3(unit_scale(max_component(abs3(across))), across));
  real2 d = triangle_uniform((real2)(u, v));
  real dx = d.x, dy = d.y, x = across.x, y = across.y, z = across.z;
  if (type == EMITTER_DISK) {
    d = disc_uniform((real2)(u, v));
    dx = d.x, dy = d.y;
  }
  bool sphere = HAS(EFFECT_SPHERES) && type == EMITTER_SPHERE;
  if (sphere) {
    real3 outward = sphere_uniform((real2)(u, v));
    x = outward.x, y = outward.y, z = outward.z;
  }
  *normal = (real3)(x, y, z);
  real3 point = choose3(sphere, add3(a, scaled3(row[3], *normal)), add3(add3(a, scaled3(dx, b)), scaled3(dy, c)));
  *pdf = 1 / (real)row[15];
  if (HAS(EFFECTS_OF_OWN_POINTS) && type == EMITTER_SHAPE)
    point = shape_draw_point(scene->geometry.shapes + emitter->shape, scene->geometry.curves, u, v, normal, pdf);
  real3 size = add3(add3(add3(abs3(a), abs3(b)), abs3(c)), abs3(point));
  *error = STORED_GAMMA(8) * (max_component(size) + row[3]);
  return point;
}

// A sphere seen from outside is sampled in its cone of directions (Shirley, Wang, Zimmerman 1996), all else by area.
INLINE LightSample area_light_sample(const Scene *scene, global const Emitter *emitter, real3 position, real4 random) {
  global const float *row = (global const float *)emitter, *power = (global const float *)&emitter->radiance;
  real3 radiance = (real3)(power[0], power[1], power[2]);
  real probability = emitter->probability;
  real3 to_centre = sub3((real3)(row[0], row[1], row[2]), position);
  real radius = row[3], centre_distance2 = dot3(to_centre, to_centre);
  bool outside = HAS(EFFECT_SPHERES) && emitter->type == EMITTER_SPHERE &&
                 centre_distance2 > radius * radius * (real)1.0002f;
  real x, y, z, distance, pdf, margin;  // scalars alone leave the branches: see vector.cl
  bool edge_on = false;
  if (!outside) {
    LightPoint point;
    real3 normal;
    point.position = emitter_point(scene, emitter, random.y, random.z, &normal, &point.error, &point.area_pdf);
    point.normal = normal;
    LightSample flat = light_from_point(emitter, position, point, &edge_on);
    x = flat.direction.x, y = flat.direction.y, z = flat.direction.z;
    distance = flat.distance, pdf = flat.pdf, margin = flat.margin;
  } else {
    real sine2 = radius * radius / centre_distance2;
    real one_minus_cos = sine2 / (1 + sqrt(1 - sine2));
    real3 drawn = cone_uniform_by(random.y, random.z, quotient3(to_centre, sqrt(centre_distance2)), one_minus_cos);
    x = drawn.x, y = drawn.y, z = drawn.z;
    real along = dot3(to_centre, drawn);
    real3 miss = sub3(to_centre, scaled3(along, drawn));
    real half_chord = sqrt(max((real)0, radius * radius - dot3(miss, miss)));
    distance = along - half_chord;
    pdf = probability / (2 * PI * one_minus_cos);
    // An error of the distance between centre and ray moves the hit by radius / half_chord times as much.
    real rounding = GAMMA(16) * (max_component(abs3(position)) + max_component(abs3(to_centre)) + radius);
    margin = (real)1e-5f * distance + radius * rounding / max(half_chord, rounding);
  }
  LightSample sample = {(real3)(x, y, z), distance, quotient3(radiance, pdf > 0 ? pdf : 1), pdf, margin};
  sample.weight = choose3(pdf > 0 && !edge_on, sample.weight, (real3)(0, 0, 0));
  return sample;
}

// The density per solid angle with which area_light_sample at `origin` draws the direction in which the surface was hit,
// the choice of emitter included. Zero for an infinite plane, which is never drawn.
INLINE real area_light_pdf(const Scene *scene, real3 origin, real3 direction, Hit hit, const Surface *surface,
                           global const Material *material) {
  real3 radiance = convert_real3(material->emission.xyz);
  bool two_sided = (material->flags & MATERIAL_TWO_SIDED) != 0;
  real area_pdf = emitter_area_pdf(scene, radiance, two_sided);
  if (hit.primitive != HIT_NONE && (hit.primitive & HIT_SHAPE)) {
    global const Shape *shape = scene->geometry.shapes + (hit.primitive & ~HIT_SHAPE);
    if (HAS(EFFECT_PLANES) && shape->type == SHAPE_PLANE) return 0;
    if (HAS(EFFECT_SPHERES) && shape->type == SHAPE_SPHERE) {
      real3 to_centre = convert_real3(shape->sphere.xyz) - origin;
      real radius = shape->sphere.w, distance2 = dot3(to_centre, to_centre);
      if (distance2 > radius * radius * (real)1.0002f) {
        real sine2 = radius * radius / distance2;
        return area_pdf * 4 * PI * radius * radius / (2 * PI * (sine2 / (1 + sqrt(1 - sine2))));
      }
    }
    if (HAS(EFFECTS_OF_OWN_POINTS)) area_pdf *= shape_unevenness(shape, scene->geometry.curves, hit, surface);
  }
  real cosine = fabs(dot3(direction, surface->geometric_normal));
  return cosine > 0 ? area_pdf * hit.t * hit.t / cosine : 0;
}

// A photon: point by area, direction by cosine, which u and v draw.
INLINE Ray area_light_emit(const Scene *scene, global const Emitter *emitter, real4 choice, real u, real v, real3 *flux) {
  global const float *power = (global const float *)&emitter->radiance;
  real3 normal, radiance = (real3)(power[0], power[1], power[2]);
  real error, area_pdf;
  real3 point = emitter_point(scene, emitter, choice.y, choice.z, &normal, &error, &area_pdf);
  normal = scaled3(emitter->two_sided != 0 && choice.w < (real)0.5f ? -1 : 1, normal);
  Ray ray;
  ray.direction = hemisphere_cosine_by(u, v, normal);
  ray.origin = offset_origin(point, error, normal, ray.direction);
  real weight = area_pdf > 0 ? 1 : 0, whole = max_component(radiance) * area_pdf * power[3];
  *flux = quotient3(scaled3(weight, radiance), area_pdf > 0 ? whole : 1);
  return ray;
}
