// Radiance from beyond the scene: a map of latitude and longitude, interpolated between texel centres.
//
// A texel is chosen by the whole numbers that it owns, then a point about its centre with the density of a tent. The
// sum of all tents is bilinear interpolation: the density of the points is that of the texels, interpolated as
// radiance is, and the two stay in proportion between the texels too.
#include "lights/horizon_emission.cl"
#include "lights/light_sample.cl"

typedef struct {
  real3 radiance;
  real density;  // of the points of the map, per area of the unit square
} EnvironmentValue;

// Where in the map, in [0, 1)^2, the unit vector `direction` lies: u is 1/2 towards -z and grows towards +x, v is 0
// straight down and 1 straight up. *sine is that of the angle to the vertical.
INLINE real2 environment_position(global const Emitter *emitter, real3 direction, real *sine) {
  *sine = sqrt(direction.x * direction.x + direction.z * direction.z);
  real u = atan2(direction.x, -direction.z) * (INV_PI / 2) + (real)0.5 + emitter->b.x;
  return (real2)(u - floor(u), atan2(*sine, -direction.y) * INV_PI);
}

// The inverse.
INLINE real3 environment_direction(global const Emitter *emitter, real2 position, real *sine) {
  real half_turns = 2 * (position.x - (real)0.5 - emitter->b.x);
  *sine = sinpi(position.y);
  return normalize((real3)(*sine * sinpi(half_turns), -cospi(position.y), -*sine * cospi(half_turns)));
}

INLINE EnvironmentValue environment_texel(const Scene *scene, global const Emitter *emitter, int column, int row) {
  int width = (int)emitter->shape, height = (int)emitter->first_area;
  column = column < 0 ? column + width : column >= width ? column - width : column;
  global const EnvironmentTexel *texel = scene->environment + (size_t)clamp(row, 0, height - 1) * width + column;
  EnvironmentValue value = {(real3)(texel->radiance[0], texel->radiance[1], texel->radiance[2]), texel->density};
  return value;
}

INLINE EnvironmentValue environment_mix(EnvironmentValue a, EnvironmentValue b, real t) {
  EnvironmentValue value = {(1 - t) * a.radiance + t * b.radiance, (1 - t) * a.density + t * b.density};
  return value;
}

// Radiance and density at a position of the map. Columns go around; beyond the last row lies the last row.
static EnvironmentValue environment_lookup(const Scene *scene, global const Emitter *emitter, real2 position) {
  real x = position.x * emitter->shape - (real)0.5, y = position.y * emitter->first_area - (real)0.5;
  real left = floor(x), low = floor(y);
  int column = (int)left, row = (int)low;
  EnvironmentValue below = environment_mix(environment_texel(scene, emitter, column, row),
                                           environment_texel(scene, emitter, column + 1, row), x - left);
  EnvironmentValue above = environment_mix(environment_texel(scene, emitter, column, row + 1),
                                           environment_texel(scene, emitter, column + 1, row + 1), x - left);
  return environment_mix(below, above, y - low);
}

// The density per solid angle that a density on the map is: d omega = 2 pi^2 sine du dv. Infinite at the poles.
INLINE real environment_pdf(real density, real sine) { return density / (2 * PI * PI * fmax(sine, (real)FLT_MIN)); }

// A number of density 1 - |x| in [-1, 1].
INLINE real tent_sample(real u) { return u < (real)0.5 ? sqrt(2 * u) - 1 : 1 - sqrt(2 - 2 * u); }

// The point of the map that `number`, of those that the environment owns, and u choose.
INLINE real2 environment_place(const Scene *scene, global const Emitter *emitter, ulong number, real2 u) {
  uint width = emitter->shape, height = emitter->first_area;
  uint texel = map_texel(scene->environment, width * height, number);
  real x = (texel % width + (real)0.5 + tent_sample(u.x)) / width;
  real y = (texel / width + (real)0.5 + tent_sample(u.y)) / height;
  // What the tents of the last rows lose beyond the poles comes back on this side.
  y = fabs(y);
  return (real2)(x - floor(x), y > 1 ? 2 - y : y);
}

// What a ray that leaves the scene finds along `direction`, and *pdf, the density per solid angle with which
// environment_sample draws that direction.
INLINE real3 environment_radiance(const Scene *scene, global const Emitter *emitter, real3 direction, real *pdf) {
  real sine;
  real2 position = environment_position(emitter, direction, &sine);
  EnvironmentValue value = environment_lookup(scene, emitter, position);
  *pdf = emitter->probability * environment_pdf(value.density, sine);
  return value.radiance;
}

// A direction in proportion to its radiance.
INLINE LightSample environment_sample(const Scene *scene, global const Emitter *emitter, real3 position, real4 random) {
  LightSample sample = {(real3)(0, 0, 1), INFINITY, (real3)(0, 0, 0), 0, 0};
  ulong number = owned_number(scene, emitter, random.x, random.w);
  real2 place = environment_place(scene, emitter, number, random.yz);
  EnvironmentValue value = environment_lookup(scene, emitter, place);
  real sine;
  sample.direction = environment_direction(emitter, place, &sine);
  sample.pdf = emitter->probability * environment_pdf(value.density, sine);
  if (sample.pdf > 0) sample.weight = value.radiance / sample.pdf;
  return sample;
}

// A photon: direction in proportion to radiance, from the disc before the scene, or from before its infinite planes.
INLINE Ray environment_emit(const Scene *scene, global const Emitter *emitter, real4 choice, real2 u, real3 *flux) {
  ulong number = owned_number(scene, emitter, choice.x, choice.w);
  real2 place = environment_place(scene, emitter, number, choice.yz);
  EnvironmentValue value = environment_lookup(scene, emitter, place);
  real sine, weight;
  Ray ray = infinite_light_ray(scene, emitter, -environment_direction(emitter, place, &sine), u, &weight);
  real pdf = environment_pdf(value.density, sine);
  *flux = pdf > 0 ? value.radiance * weight / (pdf * emitter->radiance.x) : (real3)(0, 0, 0);
  return ray;
}
