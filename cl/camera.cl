// Primary rays through a thin lens, for both camera forms of the scene format.
#include "ray.cl"
#include "effects.h"
#include "sobol.cl"
#include "types.h"
#include "warp.cl"

// The stratum of a pixel that sample `index` of `count` lies in, and a uniform point of it. A square count is
// split into equal squares, any other leaves the pixel whole.
INLINE real2 camera_stratum(uint index, uint count, real2 u) {
  uint side = (uint)(sqrt((float)count) + 0.5f);
  if (side * side != count) return u;
  return ((real2)(index % side, index / side % side) + u) / side;
}

// The numbers of path `index` of the chunk, where every pixel has `samples` of them.
INLINE PathSampler chunk_sampler(const Params *params, uint samples, uint index) {
  return path_sampler(params->seed, params->pass, params->first_pixel + index / samples, index % samples, samples,
                      params->sobol);
}

// Where in its pixel a path begins, from the numbers of DIM_FILM: independent ones are spread over `strata`
// strata, of which this is number `stratum`.
INLINE real2 place_in_pixel(const PathSampler *sampler, real4 film, uint stratum, uint strata) {
  return sampler->sobol != 0 ? film.xy : camera_stratum(stratum, strata, film.xy);
}

// The ray through the film position (x, y) in pixels from the top left; `lens` is uniform in the unit square.
// It starts on the image plane, plane_distance along D, as scenes of the base format rely on.
INLINE Ray camera_ray(const Camera *camera, uint width, uint height, real2 film, real2 lens) {
  real u = film.x / width, v = 1 - film.y / height;
  real3 d = convert_real3(camera->axis.xyz) + convert_real3(camera->right.xyz) * (u - (real)0.5f) +
            convert_real3(camera->up.xyz) * (v - (real)0.5f);
  Ray ray;
  ray.origin = convert_real3(camera->origin.xyz) + d * camera->origin.w;
  ray.direction = normalize(d);
  if (HAS(EFFECT_LENS) && camera->right.w > 0) {
    real2 r = camera->right.w * disc_uniform(lens);
    real3 offset = r.x * convert_real3(camera->lens_right.xyz) + r.y * convert_real3(camera->lens_up.xyz);
    real3 focus = (camera->up.w != 0 ? d : normalize(d)) * camera->axis.w;
    ray.origin += offset;
    ray.direction = normalize(focus - offset);
  }
  return ray;
}
