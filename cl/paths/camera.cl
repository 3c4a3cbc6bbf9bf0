// Primary rays through a thin lens, for both camera forms of the scene format.
#include "shapes/ray.cl"
#include "core/film_pixels.cl"
#include "shared/effects.h"
#include "sampling/sobol.cl"
#include "shared/types.h"
#include "sampling/warp.cl"

// The stratum of a pixel that sample `index` of `count` lies in, and a uniform point of it. A square count is
// split into equal squares, any other leaves the pixel whole.
INLINE real2 camera_stratum(uint index, uint count, real2 u) {
  uint side = (uint)(sqrt((float)count) + 0.5f);
  if (side * side != count) return u;
  return ((real2)(index % side, index / side % side) + u) / side;
}

// The numbers of path `index` of the chunk, where every pixel has `samples` of them.
INLINE PathSampler chunk_sampler(const Params *params, uint samples, uint index) {
  return path_sampler(params->seed, params->pass, picture_pixel(params, params->first_pixel + index / samples),
                      index % samples, samples, params->sobol);
}

// The ray through the film position (x, y) in pixels from the top left; `lens_u` and `lens_v` are uniform.
// It starts on the image plane, plane_distance along D, as scenes of the base format rely on.
INLINE Ray camera_ray(const Camera *camera, uint width, uint height, real x, real y, real lens_u, real lens_v) {
  const float *origin = (const float *)&camera->origin, *axis = (const float *)&camera->axis;
  const float *right = (const float *)&camera->right, *up = (const float *)&camera->up;
  real u = x / width - (real)0.5f, v = 1 - y / height - (real)0.5f;
  real3 d = add3(add3((real3)(axis[0], axis[1], axis[2]), scaled3(u, (real3)(right[0], right[1], right[2]))),
                 scaled3(v, (real3)(up[0], up[1], up[2])));
  Ray ray;
  ray.origin = add3((real3)(origin[0], origin[1], origin[2]), scaled3(origin[3], d));
  ray.direction = unit3(d);
  if (HAS(EFFECT_LENS)) {
    const float *across = (const float *)&camera->lens_right, *along = (const float *)&camera->lens_up;
    real aperture = right[3];
    real2 place = disc_uniform((real2)(lens_u, lens_v));
    real3 offset = add3(scaled3(aperture * place.x, (real3)(across[0], across[1], across[2])),
                        scaled3(aperture * place.y, (real3)(along[0], along[1], along[2])));
    real3 focus = scaled3(axis[3], choose3(up[3] != 0, d, ray.direction));
    ray.origin = add3(ray.origin, offset);
    ray.direction = choose3(aperture > 0, unit3(sub3(focus, offset)), ray.direction);
  }
  return ray;
}
