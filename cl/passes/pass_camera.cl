// Camera paths of SPPM: from the lens by mirrors, glass and rough lobes to the first diffuse surface, or to where the
// medium interacts with them first.
#include "core/work_group.cl"
#include "film/light_passes.cl"
#include "lights/direct.cl"
#include "lights/horizon.cl"
#include "paths/camera_path.cl"
#include "photons/first_diffuse_vertices.cl"
#include "photons/grid.cl"
#include "photons/kernel_area.cl"
#include "photons/visible_point.cl"

// The ray with which path number `sample` of pixel (x, y) begins. `low_discrepancy`: as PathSampler.sobol is not 0.
INLINE Ray path_ray(const Params *params, uint x, uint y, uint sample, bool low_discrepancy) {
  uint samples = params->visible_points;
  PathSampler sampler = path_sampler(params->seed, params->pass, y * params->width + x, sample, samples, low_discrepancy);
  real4 film = path_random4_soa(&sampler, DIM_FILM);
  real place_x = film.x, place_y = film.y;
  if (!low_discrepancy) {  // independent numbers are spread over strata of the pixel
    real2 place = camera_stratum(sample, samples, film.xy);
    place_x = place.x, place_y = place.y;
  }
  return camera_ray(&params->camera, params->width, params->height, x + place_x, y + place_y, film.z, film.w);
}

// What becomes of a camera path: its visible point.
typedef struct {
  const Params *params;
  const PathSampler *sampler;
  uint sample;       // of the pixel's visible points
  bool shadow_rays;  // bring direct light
  bool beyond;       // past a diffuse surface: there counts what photons do not carry, see horizon.cl
  VisiblePoint point;
  real3 segment;     // of a visible point in the medium
} VisiblePath;

// Whether the medium scatters or absorbs the path before its hit: then the visible point lies there.
INLINE bool visible_in_medium(const Scene *scene, CameraPath *path, VisiblePath *visible, Hit hit,
                              volatile global Counters *counters) {
  real distance, begin, length;
  real3 before = path->throughput, throughput = before, wi = path->ray.direction;
  real4 random = path_random_at(visible->sampler, path->bounce, DIM_MEDIUM);
  bool interacts = medium_flight(&scene->medium, hit.t, random.xy, &throughput, &distance);
  path->throughput = throughput;
  if (!interacts) return false;
  if (path->bounce == path->max_depth) return true;
  real3 position = path->ray.origin + distance * wi;
  visible->point.normal = IN_MEDIUM | diffuse_vertex_mark(path->prefix);
  path->prefix = prefix_after(path->prefix, false);
  if (visible->shadow_rays) {
    uint rays = path->rays;
    real3 found = direct_light_medium(scene, position, wi, throughput * scene->medium.scattering,
                                      path_random_at(visible->sampler, path->bounce, DIM_LIGHT), false, &rays, counters);
    path->rays = rays;
    radiance_add(&path->radiance, path->prefix, found);
  }
  real3 weight = medium_segment(&scene->medium, before, hit.t, distance, visible->params->segment, &begin, &length);
  visible->segment = length * wi;
  vstore3(path->ray.origin + begin * wi, 0, visible->point.position);
  vstore3(weight, 0, visible->point.weight);
  return true;
}

// Adds the emission of the surface where photons do not bring it, weighted against light sampling.
INLINE void visible_emission(const Scene *scene, CameraPath *path, const VisiblePath *visible, Hit hit,
                             const Surface *surface, global const Material *material) {
  real3 emission = surface_emission(scene, material, surface, path->ray.direction);
  if (HAS(EFFECT_ROUGH) && path->bsdf_pdf > 0 && max_component(emission) > 0)
    emission *= emission_weight(scene, path->ray, hit, surface, material, path->bsdf_pdf);
  if (!path->counted && !visible->beyond) radiance_add(&path->radiance, path->prefix, path->throughput * emission);
}

// The visible point at a diffuse surface, and direct light there. Returns whether the path goes on from there, by `next`:
// see horizon.cl.
INLINE bool visible_at_surface(const Scene *scene, CameraPath *path, const Boundary *boundary, VisiblePath *visible,
                               Hit hit, const LitPoint *at, global const SppmPixel *pixels,
                               volatile global Counters *counters) {
  const Params *params = visible->params;
  const PathSampler *sampler = visible->sampler;
  const Surface *surface = at->surface;
  real3 wi = at->wi, weight = path->throughput * at->bsdf->color * INV_PI;
  if (!(max_component(weight) > 0)) return false;
  bool far = is_far(&scene->geometry, hit, surface->position);
  bool counts = !visible->beyond || (far && passes_sphere(&scene->geometry, surface->position, -wi));
  bool several = params->plane_count > 1 && has_horizon(&scene->geometry);
  bool goes_on = several && (!counts || random_at(path->stream, path->bounce, DIM_CHANNEL).y < (real)0.5f);
  real3 side = dot3(surface->geometric_normal, wi) < 0 ? surface->geometric_normal : -surface->geometric_normal;
  visible->point.normal = normal_pack(side) | diffuse_vertex_mark(path->prefix);
  real radius;
  uint rays = path->rays;
  if (probe_wanted(params, pixels, sampler->pixel, visible->sample, &radius))
    visible->point.normal |= kernel_area_probe(scene, hit, surface->position, side, radius * radius,
                                               path_random_at(sampler, path->bounce, DIM_KERNEL_AREA), &rays, counters);
  path->prefix = prefix_after(path->prefix, false);
  real4 chosen = path_random_at(sampler, path->bounce, DIM_LIGHT);
  bool lit_here = visible->shadow_rays || (far && lit_from_beyond(scene, chosen));
  real3 found = (real3)(0, 0, 0);
  if (counts && lit_here && !media_covered(scene, &boundary->media))
    found = direct_light(scene, at, weight, chosen, false, &rays, counters);
  path->rays = rays;
  radiance_add(&path->radiance, path->prefix, found);
  // Half of the paths end where they count, for what photons bring; the others go on.
  real times = several && counts ? 2 : 1;
  path->throughput *= times;
  if (!goes_on) {
    vstore3(surface->position, 0, visible->point.position);
    vstore3(weight * times, 0, visible->point.weight);
  }
  return goes_on;
}

INLINE void visible_store(const Params *params, uint index, const CameraPath *path, VisiblePath *visible,
                          global VisiblePoint *visible_points) {
  vstore3(path->radiance.sum, 0, visible->point.radiance);
  visible_points[index] = visible->point;
  if (HAS(OUTPUT_LIGHT_PASSES)) {
    global VisibleLightPasses *layers = visible_layers(visible_points, params) + index;
    for (uint i = 0; i < LIGHT_PASS_COUNT; ++i) vstore3(path->radiance.layer[i], 0, layers->radiance[i]);
  }
  if (HAS(EFFECT_MEDIUM)) vstore3(visible->segment, 0, visible_segments(visible_points, params)[index].offset);
}

// One visible point for each of visible_points samples of each pixel of the chunk, at index
// (pixel of the film - first_pixel) * visible_points + sample. Emission met on the way is exact; direct light at the point
// comes by a shadow ray where the program was built for that, else from photons. There the emission that rough
// lobes reflect is found by shadow rays too, weighted against the rays that meet it; that of delta lights, which no ray
// meets, in either case. Returns the number of rays traced.
//
// Where first diffuse vertices are found in a batch, a path that comes to one is added to `diffuse_vertices` in place of
// that.
OUTLINE uint visible_path(const Scene *scene, const Params *params, uint index, global VisiblePoint *visible_points,
                          volatile global Counters *counters, global const SppmPixel *pixels,
                          DiffuseVertices *diffuse_vertices, uint *diffuse_vertex_count) {
  PathSampler sampler = chunk_sampler(params, params->visible_points, index);
  // Where the visible point will be.
  global const PrimaryHit *first = (global const PrimaryHit *)visible_points + index;
  Ray ray = PRIMARY_HITS_FOUND ? first_ray(first)
                               : path_ray(params, sampler.pixel % params->width, sampler.pixel / params->width,
                                          index % params->visible_points, params->sobol != 0);
  Boundary boundary;
  CameraPath path = camera_path_begin(scene, &boundary, ray, sampler.stream, params->max_depth, counters);
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  bool delta_lights = HAS(EFFECTS_OF_LIGHTS(DELTA)) && params->delta_lights > 0;
  VisiblePath visible = {params, &sampler, index % params->visible_points, shadow_rays, false,
                         {{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}}, (real3)(0, 0, 0)};
  for (; path.bounce <= params->max_depth; ++path.bounce) {
    Hit hit;
    bool did_hit = camera_path_trace(scene, &path, &boundary, first, &hit, counters);
    if (HAS(EFFECT_MEDIUM) && medium_along(scene, path.ray, hit, did_hit, path.interior) &&
        visible_in_medium(scene, &path, &visible, hit, counters))
      break;
    if (!did_hit) {
      if (!visible.beyond) camera_path_escape(scene, &path);
      break;
    }
#if DIFFUSE_VERTICES_BATCHED
    if (is_diffuse(scene->materials[geometry_material(&scene->geometry, hit)].kind)) {
      DiffuseArrival arrival = {path.ray,    hit,         path.throughput, path.radiance.sum,
                                path.counted, path.bounce, sampler.pixel,   index % params->visible_points};
      diffuse_vertices_put(diffuse_vertices, (*diffuse_vertex_count)++, &arrival);
      return path.rays;
    }
#endif
    Surface surface;
    global const Material *material = camera_path_arrive(scene, &path, &boundary, &hit, &surface, counters);
    visible_emission(scene, &path, &visible, hit, &surface, material);
    if (path.bounce == params->max_depth) break;

    real4 random = path_random_at(&sampler, path.bounce, DIM_BSDF);
    Bsdf bsdf = camera_path_bsdf(scene, &path, &boundary, material, &surface, random.z, counters);
    if (!DIFFUSE_VERTICES_BATCHED && is_diffuse(bsdf.kind)) {
      LitPoint at = camera_path_lit_point(&path, &bsdf, &surface);
      bool goes_on = visible_at_surface(scene, &path, &boundary, &visible, hit, &at, pixels, counters);
      if (HAS(EFFECTS_OF_MATERIALS(SCATTERS)))
        visible_lobes(visible_points, params)[index] = visible_lobe(&bsdf, at.wi, at.n);
      if (!goes_on) break;
      BsdfSample next = diffuse_sample(&bsdf, &surface, path.ray.direction, at.n, random);
      if (!camera_path_depart(scene, &path, &boundary, material, &surface, next, random.w)) break;
      path.bsdf_pdf = 0;
      visible.point.normal = 0;
      visible.beyond = true;
      continue;
    }
    path.prefix = prefix_after(path.prefix, bsdf_is_specular(&bsdf));
    bool weigh_lights = (shadow_rays || delta_lights) && bsdf_is_rough(&bsdf) && !visible.beyond;
    if (weigh_lights && !media_covered(scene, &boundary.media))
      camera_path_light_rough(scene, &path, &boundary, &bsdf, &surface, path_random_at(&sampler, path.bounce, DIM_LIGHT),
                              counters);
    BsdfSample next = bsdf_sample(&bsdf, &surface, path.ray.direction, random, true);
    path.bsdf_pdf = weigh_lights ? next.pdf : 0;
    if (!camera_path_depart(scene, &path, &boundary, material, &surface, next, random.w)) break;
  }
  visible_store(params, index, &path, &visible, visible_points);
  return path.rays;
}

#if DIFFUSE_VERTICES_BATCHED
// Paths [first, end) of the chunk. Returns the number of rays.
OUTLINE uint visible_paths(const Scene *scene, const Params *params, uint first, uint end,
                           global VisiblePoint *visible_points, volatile global Counters *counters,
                           global const SppmPixel *pixels) {
  DiffuseVertices diffuse_vertices;
  uint count = 0, rays = 0, others[STREAM_CAPACITY], other_count = 0, samples = params->visible_points;
  uint of_film = params->first_pixel + first / samples, pixel = picture_pixel(params, of_film), sample = first % samples;
  for (uint index = first; index < end; ++index) {
    bool receives = false;
    if (PRIMARY_HITS_FOUND) {
      // Most paths end at what they meet first. Lists without branches, since where they do is as good as random.
      global const PrimaryHit *found = (global const PrimaryHit *)visible_points + index;
      Hit hit = hit_none(INFINITY);
      if (primary_hit(found, &hit))
        receives = is_diffuse(scene->materials[geometry_material(&scene->geometry, hit)].kind);
      DiffuseArrival arrival = {first_ray(found), hit, (real3)(1, 1, 1), (real3)(0, 0, 0), false, 0, pixel, sample};
      diffuse_vertices_put(&diffuse_vertices, count, &arrival);
    }
    others[other_count] = index;
    count += receives ? 1u : 0u;
    other_count += receives ? 0u : 1u;
    sample = sample + 1 == samples ? 0 : sample + 1;
    of_film += sample == 0 ? 1u : 0u;
    pixel = picture_pixel(params, of_film);
  }
  rays += count;
  for (uint i = 0; i < other_count; ++i)
    rays += visible_path(scene, params, others[i], visible_points, counters, pixels, &diffuse_vertices, &count);
  return rays + diffuse_vertices_finish(scene, params, count, &diffuse_vertices, visible_points, pixels, counters);
}
#endif

// Traces the camera paths of a chunk. Where they end in a batch, one item of a work-group traces those of all.
kernel void trace_camera(SCENE_PARAMETERS, global VisiblePoint *visible_points, volatile global Counters *counters,
                         Params params, global const SppmPixel *pixels, global const WallGrid *walls) {
  uint index = get_global_id(0), rays = 0, paths = params.pixel_count * params.visible_points;
#if DIFFUSE_VERTICES_BATCHED
  if (get_local_id(0) != 0 || index >= paths) return;
  SCENE_INIT(params);
  if (HAS(EFFECT_WALLS)) scene.walls = walls;
  uint end = min(index + (uint)get_local_size(0), paths);
  for (; index < end; index += STREAM_CAPACITY)
    rays += visible_paths(&scene, &params, index, min(index + STREAM_CAPACITY, end), visible_points, counters, pixels);
  count_rays(rays, counters);
#else
  local uint group_rays[LARGEST_WORK_GROUP];
  if (index < paths) {
    SCENE_INIT(params);
    if (HAS(EFFECT_WALLS)) scene.walls = walls;
    rays = visible_path(&scene, &params, index, visible_points, counters, pixels, 0, 0);
  }
  group_count_rays(rays, group_rays, counters);
#endif
}

// distances[i] = how far it is from visible point i to what lies around it, along a random ray: infinite where it meets
// nothing, negative where there is no visible point. For choosing the first radius.
kernel void surroundings(SCENE_PARAMETERS, global const VisiblePoint *visible_points, volatile global Counters *counters,
                         Params params, global float *distances) {
  uint i = get_global_id(0);
  if (i >= params.pixel_count * params.visible_points) return;
  SCENE_INIT(params);
  VisiblePoint point = visible_points[i];
  distances[i] = -1;
  if (!(point.weight[0] + point.weight[1] + point.weight[2] > 0)) return;
  RandomStream stream = {params.seed, params.pass, i, 0, 0};
  real4 random = random4(stream, DIM_KERNEL_AREA);
  real3 position = vload3(0, point.position), n = (real3)(0, 0, 1), direction = sphere_uniform(random.xy);
  Ray ray = {position, direction};
  if (!(HAS(EFFECT_MEDIUM) && (point.normal & IN_MEDIUM))) {
    n = normalize(convert_real3(normal_unpack(point.normal)));
    ray.direction = hemisphere_cosine_by(random.x, random.y, n);
    // The normal is coarse, and the point's error is not known.
    ray.origin = position + (real)1e-5f * max_component(fabs(position)) * n;
  }
  Hit hit = hit_none(INFINITY);
  bool did_hit = geometry_closest(&scene.geometry, ray, &hit);
  count_diagnostics(hit.diagnostics, counters);
  distances[i] = did_hit ? (float)hit.t : INFINITY;
}

#ifdef CAMERA_PACKETS
// What the paths of trace_camera meet first. Every sixteenth item traces a packet, so that work-groups stay small pieces
// of the whole.
kernel void primary_hits(SCENE_PARAMETERS, global PrimaryHit *hits, volatile global Counters *counters, Params params,
                       uint packets) {
  uint index = get_global_id(0) / PACKET_RAYS;
  if (get_global_id(0) % PACKET_RAYS != 0 || index >= packets) return;
  GEOMETRY_INIT(params.plane_count)
  primary_hits_of(&geometry, &params, params.visible_points, index, hits, counters);
}
#endif
