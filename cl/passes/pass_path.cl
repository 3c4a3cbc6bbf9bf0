// Path tracing: light sampling and BSDF sampling combined by the power heuristic.
#include "paths/camera.cl"
#include "lights/direct.cl"
#include "film/film.cl"
#include "sampling/roulette.cl"
#include "paths/path_splitting.cl"
#include "core/work_group.cl"
#include "traversal/primary_hits.cl"

// The ray with which the path of this pass through pixel (x, y) begins, whose number among the pixel's is 0, as
// primary_hits.cl asks for both integrators. `even`: as PathSampler.sobol is not 0. Of
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

// Radiance along one camera path. Paths scatter at most params.max_depth times. `first` is where its primary hit is kept,
// if it has been found.
OUTLINE void path_radiance(const Scene *scene, Ray ray, global const PrimaryHit *first, const PathSampler *sampler,
                           uint max_depth, Radiance *result, uint *rays, volatile global Counters *counters) {
  RandomStream stream = sampler->stream;
  real3 throughput = (real3)(1, 1, 1);
  Radiance radiance = radiance_none();
  uint prefix = PREFIX_NO_DIFFUSE;
  real bsdf_pdf = 0;  // of the last direction; 0 after the camera and specular surfaces
  bool counted = false;  // the emission ahead is, by path_splitting.cl
  Interior interior = interior_none();
  Boundary boundary;
  boundary_at_camera(scene, &boundary, ray, &interior, counters);
  for (uint bounce = 0; bounce <= max_depth; ++bounce) {
    Hit hit = hit_none(INFINITY);
    ++*rays;
    bool did_hit = PRIMARY_HITS_FOUND && bounce == 0 ? primary_hit(first, &hit)
                                              : media_closest(scene, &boundary.media, ray, &hit);
    count_diagnostics(hit.diagnostics, counters);
    if (HAS(EFFECT_MEDIUM) && medium_along(scene, ray, hit, did_hit, interior)) {
      real distance;
      if (medium_flight(&scene->medium, hit.t, path_random_at(sampler, bounce, DIM_MEDIUM).xy, &throughput, &distance)) {
        if (bounce == max_depth) break;
        real3 position = ray.origin + distance * ray.direction;
        throughput *= scene->medium.scattering;
        prefix = prefix_after(prefix, false);
        if (scene->emitter_count > 0)
          radiance_add(&radiance, prefix,
                       direct_light_medium(scene, position, ray.direction, throughput,
                                           path_random_at(sampler, bounce, DIM_LIGHT), true, rays, counters));
        real4 random = path_random_at(sampler, bounce, DIM_BSDF);
        if (!path_survives(&throughput, bounce, random.w)) break;
        real3 direction = phase_sample(scene->medium.g, ray.direction, random.xy);
        bsdf_pdf = phase_density(scene->medium.g, dot(ray.direction, direction));
        ray.origin = position;
        ray.direction = direction;
        continue;
      }
    }
    if (!did_hit) {
      if (HAS(EFFECT_ENVIRONMENT) && !counted)
        radiance_add(&radiance, prefix, throughput * escaped_radiance(scene, ray.direction, bsdf_pdf));
      break;
    }
    Surface surface;
    geometry_surface(&scene->geometry, ray, hit, &surface);
    boundary_arrive(scene, &boundary, ray, &hit, &surface, &interior, counters);
    global const Material *material = scene->materials + surface.material;
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) {
      if (!nested(scene)) interior = interior_before(interior, material, &surface, ray.direction);
      throughput *= interior_transmittance(interior, hit.t);
    }

    real3 emission = emission_at(material, &surface, ray.direction);
    if (max_component(emission) > 0 && !counted) {
      real weight = 1;
      if (bsdf_pdf > 0) weight = emission_weight(scene, ray, hit, &surface, material, bsdf_pdf);
      radiance_add(&radiance, prefix, throughput * emission * weight);
    }
    if (bounce == max_depth) break;

    Bsdf bsdf = bsdf_at(material, scene->textures, scene->texels, surface.uv);
    if (HAS(EFFECT_TEXTURES)) make_finite(&bsdf.color, counters);
    boundary_bsdf(scene, &boundary, material, &surface, ray.direction, random_at(stream, bounce, DIM_CHANNEL).x, &bsdf,
                  &throughput);
    real4 random = path_random_at(sampler, bounce, DIM_BSDF);
    if (HAS(EFFECTS_OF_MATERIALS(TRANSMITS | LAYERED)))
      counted = split_at_dielectric(scene, &bsdf, &surface, ray, random.z, throughput, interior, &boundary, prefix, stream,
                           bounce, max_depth, counted, &radiance, rays, counters);
    if (is_layered(bsdf.kind)) choose_lobe(&bsdf, ray.direction, facing_normal(&surface, ray.direction), random.z);
    counted = counted && bsdf_is_specular(&bsdf);
    prefix = prefix_after(prefix, bsdf_is_specular(&bsdf));
    bool covered = media_covered(scene, &boundary.media);
    if (is_lambert(bsdf.kind) && scene->emitter_count > 0 && max_component(bsdf.color) > 0 && !covered) {
      real3 n = facing_normal(&surface, ray.direction);
      radiance_add(&radiance, prefix,
                   direct_light(scene, &bsdf, &surface, interior, ray.direction, n, throughput * bsdf.color * INV_PI,
                                path_random_at(sampler, bounce, DIM_LIGHT), true, rays, counters));
    }
    if (bsdf_is_rough(&bsdf) && scene->emitter_count > 0 && !covered) {
      real3 n = facing_normal(&surface, ray.direction);
      radiance_add(&radiance, prefix,
                   direct_light_rough(scene, &bsdf, &surface, interior, boundary_behind(scene, &boundary), ray.direction, n, throughput,
                                      path_random_at(sampler, bounce, DIM_LIGHT), rays, counters));
    }
    BsdfSample next = bsdf_sample(&bsdf, &surface, ray.direction, random, true);
    throughput *= next.weight;
    if (!path_survives(&throughput, bounce, random.w)) break;
    bsdf_pdf = next.pdf;
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) interior = interior_after(interior, material, &surface, next.direction);
    ray.origin = boundary_depart(scene, &boundary, &surface, ray.direction, next.direction);
    if (nested(scene)) interior = interior_of_stack(scene, &boundary.media.stack);
    ray.direction = next.direction;
  }
  *result = radiance;
}

// Adds sample number params.pass of a pixel, which is path `index` of the chunk, to the film; *rays is the number of rays
// traced.
INLINE void sample_pixel(const Scene *scene, const Params *params, uint index, global FilmPixel *film,
                         global const PrimaryHit *primary_hits, uint *rays, volatile global Counters *counters) {
  uint pixel = params->first_pixel + index;
  PathSampler sampler = chunk_sampler(params, 1u, index);
  global const PrimaryHit *first = primary_hits + index;
  Ray ray = PRIMARY_HITS_FOUND ? first_ray(first)
                             : path_ray(params, pixel % params->width, pixel / params->width, 0, params->sobol != 0);
  Radiance radiance;
  path_radiance(scene, ray, first, &sampler, params->max_depth, &radiance, rays, counters);
  film_add_radiance(film, pixel, params->width * params->height, &radiance, 0, params->pass, counters);
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
