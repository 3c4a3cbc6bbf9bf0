// Path tracing: light sampling and BSDF sampling combined by the power heuristic.
#include "core/work_group.cl"
#include "film/film.cl"
#include "paths/camera_path.cl"

// The ray with which the path of this pass through pixel (x, y) begins, whose number among the pixel's is 0, as
// primary_hits.cl asks for both integrators. `low_discrepancy`: as PathSampler.sobol is not 0. Of
// independent numbers four consecutive samples stratify a pixel 2 x 2; each pixel begins with a stratum of its own, so that
// a count that four does not divide shifts nothing.
INLINE Ray path_ray(const Params *params, uint x, uint y, uint sample, bool low_discrepancy) {
  uint pixel = y * params->width + x;
  PathSampler sampler = path_sampler(params->seed, params->pass, pixel, sample, 1u, low_discrepancy);
  real4 film = path_random4_soa(&sampler, DIM_FILM);
  real place_x = film.x, place_y = film.y;
  if (!low_discrepancy) {
    real2 place = camera_stratum((params->pass + (pixel * 0x9e3779b9u >> 30)) % 4u, 4u, film.xy);
    place_x = place.x, place_y = place.y;
  }
  return camera_ray(&params->camera, params->width, params->height, x + place_x, y + place_y, film.z, film.w);
}

// Whether the medium scatters or absorbs the path before its hit: then *alive tells whether it goes on.
INLINE bool path_in_medium(const Scene *scene, CameraPath *path, const PathSampler *sampler, Hit hit, bool *alive,
                           volatile global Counters *counters) {
  real distance;
  real3 throughput = path->throughput;
  bool interacts = medium_flight(&scene->medium, hit.t, path_random_at(sampler, path->bounce, DIM_MEDIUM).xy, &throughput,
                                 &distance);
  path->throughput = throughput;
  if (!interacts) return false;
  *alive = false;
  if (path->bounce == path->max_depth) return true;
  real3 position = path->ray.origin + distance * path->ray.direction;
  path->throughput *= scene->medium.scattering;
  path->prefix = prefix_after(path->prefix, false);
  if (scene->emitter_count > 0) {
    uint rays = path->rays;
    real3 found = direct_light_medium(scene, position, path->ray.direction, path->throughput,
                                      path_random_at(sampler, path->bounce, DIM_LIGHT), true, &rays, counters);
    path->rays = rays;
    radiance_add(&path->radiance, path->prefix, found);
  }
  real4 random = path_random_at(sampler, path->bounce, DIM_BSDF);
  throughput = path->throughput;
  *alive = path_survives(&throughput, path->bounce, random.w);
  path->throughput = throughput;
  real3 direction = phase_sample(scene->medium.g, path->ray.direction, random.xy);
  path->bsdf_pdf = phase_density(scene->medium.g, dot(path->ray.direction, direction));
  path->ray.origin = position;
  path->ray.direction = direction;
  return true;
}

// Adds the emission of the surface, weighted against light sampling.
INLINE void path_emission(const Scene *scene, CameraPath *path, Hit hit, const Surface *surface,
                          global const Material *material) {
  real3 emission = surface_emission(scene, material, surface, path->ray.direction);
  if (!(max_component(emission) > 0) || path->counted) return;
  real weight = 1;
  if (path->bsdf_pdf > 0) weight = emission_weight(scene, path->ray, hit, surface, material, path->bsdf_pdf);
  radiance_add(&path->radiance, path->prefix, path->throughput * emission * weight);
}

// Adds the direct light that the surface sends on, of one emitter.
INLINE void path_direct_light(const Scene *scene, CameraPath *path, const Boundary *boundary, const Bsdf *bsdf,
                              const Surface *surface, const PathSampler *sampler, volatile global Counters *counters) {
  if (scene->emitter_count == 0 || media_covered(scene, &boundary->media)) return;
  if (is_diffuse(bsdf->kind) && max_component(bsdf->color) > 0) {
    LitPoint point = camera_path_lit_point(path, bsdf, surface);
    uint rays = path->rays;
    real3 found = direct_light(scene, &point, path->throughput * bsdf->color * INV_PI,
                               path_random_at(sampler, path->bounce, DIM_LIGHT), true, &rays, counters);
    path->rays = rays;
    radiance_add(&path->radiance, path->prefix, found);
  }
  if (bsdf_is_rough(bsdf))
    camera_path_light_rough(scene, path, boundary, bsdf, surface, path_random_at(sampler, path->bounce, DIM_LIGHT),
                            counters);
}

// Radiance along one camera path. Paths scatter at most max_depth times. `first` is where its primary hit is kept, if it has
// been found.
OUTLINE void path_radiance(const Scene *scene, Ray ray, global const PrimaryHit *first, const PathSampler *sampler,
                           uint max_depth, Radiance *result, uint *rays, volatile global Counters *counters) {
  Boundary boundary;
  CameraPath path = camera_path_begin(scene, &boundary, ray, sampler->stream, max_depth, counters);
  for (; path.bounce <= max_depth; ++path.bounce) {
    Hit hit;
    bool did_hit = camera_path_trace(scene, &path, &boundary, first, &hit, counters), alive;
    if (HAS(EFFECT_MEDIUM) && medium_along(scene, path.ray, hit, did_hit, path.interior) &&
        path_in_medium(scene, &path, sampler, hit, &alive, counters)) {
      if (!alive) break;
      continue;
    }
    if (!did_hit) {
      camera_path_escape(scene, &path);
      break;
    }
    Surface surface;
    global const Material *material = camera_path_arrive(scene, &path, &boundary, &hit, &surface, counters);
    path_emission(scene, &path, hit, &surface, material);
    if (path.bounce == max_depth) break;

    real4 random = path_random_at(sampler, path.bounce, DIM_BSDF);
    Bsdf bsdf = camera_path_bsdf(scene, &path, &boundary, material, &surface, random.z, counters);
    path.counted = path.counted && bsdf_is_specular(&bsdf);
    path.prefix = prefix_after(path.prefix, bsdf_is_specular(&bsdf));
    path_direct_light(scene, &path, &boundary, &bsdf, &surface, sampler, counters);
    BsdfSample next = bsdf_sample(&bsdf, &surface, path.ray.direction, random, true);
    path.bsdf_pdf = next.pdf;
    if (!camera_path_depart(scene, &path, &boundary, material, &surface, next, random.w)) break;
  }
  *result = path.radiance;
  *rays += path.rays;
}

// Adds sample number params.pass of a pixel, which is path `index` of the chunk, to the film; *rays is the number of rays
// traced.
INLINE void sample_pixel(const Scene *scene, const Params *params, uint index, global FilmPixel *film,
                         global const PrimaryHit *primary_hits, uint *rays, volatile global Counters *counters) {
  uint of_film = params->first_pixel + index, pixel = picture_pixel(params, of_film);
  PathSampler sampler = chunk_sampler(params, 1u, index);
  global const PrimaryHit *first = primary_hits + index;
  Ray ray = PRIMARY_HITS_FOUND ? first_ray(first)
                             : path_ray(params, pixel % params->width, pixel / params->width, 0, params->sobol != 0);
  Radiance radiance;
  path_radiance(scene, ray, first, &sampler, params->max_depth, &radiance, rays, counters);
  film_add_radiance(film, of_film, film_pixels(params), &radiance, 0, params->pass, counters);
}

// One sample of each pixel of the chunk. `primary_hits` holds what its paths meet first where the program is built for
// that.
kernel void trace_paths(SCENE_PARAMETERS, global FilmPixel *film, volatile global Counters *counters, Params params,
                        global const PrimaryHit *primary_hits) {
  local uint group_rays[LARGEST_WORK_GROUP];
  uint i = get_global_id(0), rays = 0;
  if (i < params.pixel_count) {
    SCENE_INIT(params);
    sample_pixel(&scene, &params, i, film, primary_hits, &rays, counters);
  }
  group_count_rays(rays, group_rays, counters);
}

#ifdef CAMERA_PACKETS
// What the paths of trace_paths meet first: see pass_camera.cl.
kernel void primary_hits(SCENE_PARAMETERS, global PrimaryHit *hits, volatile global Counters *counters, Params params,
                       uint packets) {
  uint index = get_global_id(0) / PACKET_RAYS;
  if (get_global_id(0) % PACKET_RAYS != 0 || index >= packets) return;
  GEOMETRY_INIT(params.plane_count)
  primary_hits_of(&geometry, &params, 1u, index, hits, counters);
}
#endif
