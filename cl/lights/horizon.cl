// Light from beyond the scene where infinite planes reach to the horizon.
//
// Photons start on a disc before a sphere around all that is bounded, and half of them beyond it. Their density falls with
// the distance, in the end with its third power, as what a far part of a plane sends to the sphere does. Surfaces beyond
// the sphere, which are planes, are called far. A photon that a far diffuse surface scatters goes on towards the sphere, so
// that its flux, which grew as the density fell, becomes that of others again. So photons carry all light but that which
// - comes to a far surface straight from beyond the scene: visible points there take it by a shadow ray;
// - goes from one far surface to another and passes the sphere by, which takes two planes. There half of the camera paths
//   go on from their visible point, and count again at the next far surface whose light passes the sphere by on its way to
//   them. So each path of light counts once: where the camera path has come past the last such way, seen from the camera.
#include "lights/light.cl"

// The mark of photons of sun and sky until they meet something: PhotonState.mark.
#define FROM_BEYOND 0x20000000u

// Whether what is met at `position` is far.
INLINE bool is_far(const Geometry *g, Hit hit, real3 position) {
  if (!has_horizon(g) || !(hit.primitive & HIT_SHAPE)) return false;
  global const Shape *shape = g->shapes + (hit.primitive & ~HIT_SHAPE);
  return shape->type == SHAPE_PLANE && length(position - convert_real3(shape->sphere.xyz)) > shape->sphere.w;
}

// One minus the cosine of the cone in which the sphere is seen from a far point, and the unit vector to its middle.
INLINE real horizon_cone(const Geometry *g, real3 position, real3 *axis) {
  real3 to_centre = convert_real3(g->shapes[0].sphere.xyz) - position;
  real distance = length(to_centre), sine = fmin(g->shapes[0].sphere.w / distance, (real)1);
  *axis = to_centre / distance;
  return sine * sine / (1 + sqrt(1 - sine * sine));
}

// diffuse_sample() at a far point: uniform in the cone of the sphere.
INLINE BsdfSample horizon_sample(const Geometry *g, const Bsdf *bsdf, const Surface *surface, real3 wi, real3 n,
                                 real4 random) {
  real3 axis;
  real one_minus_cosine = horizon_cone(g, surface->position, &axis);
  BsdfSample sample;
  sample.direction = cone_uniform_by(random.x, random.y, axis, one_minus_cosine);
  sample.pdf = 1 / (2 * PI * one_minus_cosine);
  real cosine = dot3(sample.direction, n);
  bool same_side =
      cosine > 0 && dot3(sample.direction, surface->geometric_normal) * dot3(wi, surface->geometric_normal) < 0;
  sample.weight = same_side ? bsdf->color * (cosine * INV_PI / sample.pdf) : (real3)(0, 0, 0);
  if (HAS(EFFECT_PLASTIC) && bsdf->coated) sample.weight *= fresnel_transmittance(cosine, bsdf->ior);
  if (HAS(EFFECTS_OF_MATERIALS(SCATTERS))) sample.weight *= over_lambert(bsdf, wi, sample.direction, n);
  return sample;
}

// Whether light that leaves a far point along `direction` passes the sphere by, so that no photon carries it.
INLINE bool passes_sphere(const Geometry *g, real3 position, real3 direction) {
  real3 axis, chord;
  real one_minus_cosine = horizon_cone(g, position, &axis);
  chord = direction - axis;
  return dot(chord, chord) > 2 * one_minus_cosine;
}

// Whether the emitter chosen by these numbers is one that is beyond the scene.
INLINE bool lit_from_beyond(const Scene *scene, real4 random) {
  return light_is(scene->emitters + emitter_choose(scene, random.x, random.w), LIGHTS_WITH(BEYOND_SCENE));
}
