// Where photons from beyond the scene start beside infinite planes: see horizon.cl.
#include "lights/infinite_light.cl"
#include "scene/scene.cl"

// Whether the scene has both: the host puts the sphere into the records of its planes, which else hold none.
INLINE bool has_horizon(const Geometry *g) {
  return HAS(EFFECT_HORIZON) && g->plane_count > 0 && g->shapes[0].sphere.w > 0;
}

// Of the photons, those that start beyond the disc: sixteen of the 32 columns of cells by which photons are aimed.
#define HORIZON_FRACTION 0.5f

// A point of the plane across the light, in radii of the disc, of numbers from the unit square; *weight is
// the flux of its photons over that of a disc alone. Beyond the disc the density falls with the square of the
// distance up to `reach`, where all planes have come nearest to the disc, and with its cube from there on.
INLINE real2 horizon_place(real2 u, real reach, real *weight) {
  const real beyond = HORIZON_FRACTION;
  if (u.x >= beyond) {
    *weight = 1 / (1 - beyond);
    return disc_uniform((real2)((u.x - beyond) / (1 - beyond), u.y));
  }
  real octaves = log(reach), whole = 1 + octaves, t = u.x / beyond * whole;
  real radius = t < octaves ? exp(t) : reach / fmax(1 - (t - octaves), (real)1e-6f);
  *weight = 2 * whole * radius * radius * fmax(radius / reach, (real)1) / beyond;
  return radius * (real2)(cospi(2 * u.y), sinpi(2 * u.y));
}

// A photon of a directional light or the environment that travels along `direction`: it starts before all that it may
// meet. *weight as above, 0 where there is nothing to meet.
INLINE Ray horizon_ray(const Scene *scene, global const Emitter *emitter, real3 direction, real2 u,
                       real *weight) {
  real3 tangent, bitangent;
  orthonormal_basis(direction, &tangent, &bitangent);
  real radius = emitter->a.w;
  real2 d = radius * horizon_place(u, fmax((real)emitter->c.x, (real)1), weight);
  real3 point = convert_real3(emitter->a.xyz) + d.x * tangent + d.y * bitangent;
  real start = dot(d, d) <= radius * radius ? -radius : (real)INFINITY;
  for (uint i = 0; i < scene->geometry.plane_count; ++i) {
    global const Shape *plane = scene->geometry.shapes + i;
    real3 row = convert_real3(plane->to_local[2].xyz);
    real t = dot(row, plane_centre(plane) - point) / dot(row, direction);
    if (isfinite(t)) start = fmin(start, t - (real)0.01f * (radius + fabs(t)));
  }
  if (!isfinite(start)) *weight = 0;
  Ray ray = {point + (isfinite(start) ? start : 0) * direction, direction};
  return ray;
}

// A photon of a light from beyond the scene that travels along `direction`, drawn by numbers from the unit square. *weight
// is its flux over that of a disc alone.
INLINE Ray infinite_light_ray(const Scene *scene, global const Emitter *emitter, real3 direction, real2 u, real *weight) {
  *weight = 1;
  if (has_horizon(&scene->geometry)) return horizon_ray(scene, emitter, direction, u, weight);
  Ray ray = {infinite_light_origin(emitter, direction, u), direction};
  return ray;
}
