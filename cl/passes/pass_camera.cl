// Camera paths of SPPM: from the lens by mirrors, glass and rough lobes to the first diffuse surface, or to where the
// medium interacts with them first.
#include "paths/camera.cl"
#include "photons/kernel_area.cl"
#include "lights/direct.cl"
#include "photons/grid.cl"
#include "lights/horizon.cl"
#include "film/light_passes.cl"
#include "photons/first_diffuse_vertices.cl"
#include "sampling/roulette.cl"
#include "paths/path_splitting.cl"
#include "photons/visible_point.cl"
#include "core/work_group.cl"
#include "traversal/primary_hits.cl"

// The ray with which path number `sample` of pixel (x, y) begins. `even`: as PathSampler.sobol is not 0.
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

// One visible point for each of visible_points samples of each pixel of the chunk, at index
// (pixel - first_pixel) * visible_points + sample. Emission met on the way is exact; direct light at the point
// comes by a shadow ray where the program was built for that, else from photons. There the emission that rough
// lobes reflect is found by shadow rays too, weighted against the rays that meet it; that of delta lights, which no ray
// meets, in either case. Returns the number of rays traced.
//
// Where first diffuse vertices are found in a batch, a path that comes to one is added to `first diffuse vertices` in place of that.
OUTLINE uint camera_path(const Scene *scene, const Params *params, uint index, global VisiblePoint *visible_points,
                         volatile global Counters *counters, global const SppmPixel *pixels, DiffuseVertices *diffuse_vertices,
                         uint *diffuse_vertex_count) {
  PathSampler sampler = chunk_sampler(params, params->visible_points, index);
  RandomStream stream = sampler.stream;
  // Where the visible point will be.
  global const PrimaryHit *first = (global const PrimaryHit *)visible_points + index;
  Ray ray = PRIMARY_HITS_FOUND ? first_ray(first)
                             : path_ray(params, sampler.pixel % params->width, sampler.pixel / params->width,
                                        index % params->visible_points, params->sobol != 0);

  VisiblePoint point = {{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
  real3 throughput = (real3)(1, 1, 1);
  Radiance radiance = radiance_none();
  uint prefix = PREFIX_NO_DIFFUSE;
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  uint rays = 0;
  real bsdf_pdf = 0;  // of the last direction; 0 where no shadow ray could find what it does
  bool counted = false;  // the emission ahead is, by path_splitting.cl
  bool beyond = false;  // past a diffuse surface: there counts what photons do not carry, see horizon.cl
  real3 segment = (real3)(0, 0, 0);  // of a visible point in the medium
  Interior interior = interior_none();
  Boundary boundary;
  boundary_at_camera(scene, &boundary, ray, &interior, counters);
  for (uint bounce = 0; bounce <= params->max_depth; ++bounce) {
    Hit hit = hit_none(INFINITY);
    ++rays;
    bool did_hit = PRIMARY_HITS_FOUND && bounce == 0 ? primary_hit(first, &hit)
                                              : media_closest(scene, &boundary.media, ray, &hit);
    count_diagnostics(hit.diagnostics, counters);
    if (HAS(EFFECT_MEDIUM) && medium_along(scene, ray, hit, did_hit, interior)) {
      real distance, begin, length;
      real3 before = throughput;
      if (medium_flight(&scene->medium, hit.t, path_random_at(&sampler, bounce, DIM_MEDIUM).xy, &throughput, &distance)) {
        if (bounce == params->max_depth) break;
        real3 position = ray.origin + distance * ray.direction;
        point.normal = IN_MEDIUM | diffuse_vertex_mark(prefix);
        prefix = prefix_after(prefix, false);
        if (shadow_rays)
          radiance_add(&radiance, prefix,
                       direct_light_medium(scene, position, ray.direction, throughput * scene->medium.scattering,
                                           path_random_at(&sampler, bounce, DIM_LIGHT), false, &rays, counters));
        real3 weight = medium_segment(&scene->medium, before, hit.t, distance, params->segment, &begin, &length);
        segment = length * ray.direction;
        vstore3(ray.origin + begin * ray.direction, 0, point.position);
        vstore3(weight, 0, point.weight);
        break;
      }
    }
    if (!did_hit) {
      if (HAS(EFFECT_ENVIRONMENT) && !counted && !beyond)
        radiance_add(&radiance, prefix, throughput * escaped_radiance(scene, ray.direction, bsdf_pdf));
      break;
    }
#if DIFFUSE_VERTICES_BATCHED
    if (is_lambert(scene->materials[geometry_material(&scene->geometry, hit)].kind)) {
      diffuse_vertices_put(diffuse_vertices, (*diffuse_vertex_count)++, sampler.pixel, index % params->visible_points, ray, hit, throughput,
                    radiance.sum, bounce, counted);
      return rays;
    }
#endif
    Surface surface;
    geometry_surface(&scene->geometry, ray, hit, &surface);
    boundary_arrive(scene, &boundary, ray, &hit, &surface, &interior, counters);
    global const Material *material = scene->materials + surface.material;
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) {
      if (!nested(scene)) interior = interior_before(interior, material, &surface, ray.direction);
      throughput *= interior_transmittance(interior, hit.t);
    }
    real3 emission = emission_at(material, &surface, ray.direction);
    if (HAS(EFFECT_ROUGH) && bsdf_pdf > 0 && max_component(emission) > 0)
      emission *= emission_weight(scene, ray, hit, &surface, material, bsdf_pdf);
    if (!counted && !beyond) radiance_add(&radiance, prefix, throughput * emission);
    if (bounce == params->max_depth) break;

    Bsdf bsdf = bsdf_at(material, scene->textures, scene->texels, surface.uv);
    if (HAS(EFFECT_TEXTURES)) make_finite(&bsdf.color, counters);
    boundary_bsdf(scene, &boundary, material, &surface, ray.direction, random_at(stream, bounce, DIM_CHANNEL).x, &bsdf,
                  &throughput);
    real4 random = path_random_at(&sampler, bounce, DIM_BSDF);
    if (HAS(EFFECTS_OF_MATERIALS(TRANSMITS | LAYERED)))
      counted = split_at_dielectric(scene, &bsdf, &surface, ray, random.z, throughput, interior, &boundary, prefix, stream,
                           bounce, params->max_depth, counted, &radiance, &rays, counters);
    if (is_layered(bsdf.kind)) choose_lobe(&bsdf, ray.direction, facing_normal(&surface, ray.direction), random.z);
    if (!DIFFUSE_VERTICES_BATCHED && is_lambert(bsdf.kind)) {
      real3 n = facing_normal(&surface, ray.direction);
      real3 weight = throughput * bsdf.color * INV_PI;
      if (!(max_component(weight) > 0)) break;
      bool far = is_far(&scene->geometry, hit, surface.position);
      bool counts = !beyond || (far && passes_sphere(&scene->geometry, surface.position, -ray.direction));
      bool several = params->plane_count > 1 && has_horizon(&scene->geometry);
      bool goes_on = several && (!counts || random_at(stream, bounce, DIM_CHANNEL).y < (real)0.5f);
      real3 side = dot3(surface.geometric_normal, ray.direction) < 0 ? surface.geometric_normal : -surface.geometric_normal;
      point.normal = normal_pack(side) | diffuse_vertex_mark(prefix);
      real radius;
      if (probe_wanted(params, pixels, sampler.pixel, index % params->visible_points, &radius))
        point.normal |= kernel_area_probe(scene, hit, surface.position, side, radius * radius,
                                       path_random_at(&sampler, bounce, DIM_KERNEL_AREA), &rays, counters);
      prefix = prefix_after(prefix, false);
      real4 chosen = path_random_at(&sampler, bounce, DIM_LIGHT);
      bool lit_here = shadow_rays || (far && lit_from_beyond(scene, chosen));
      if (counts && lit_here && !media_covered(scene, &boundary.media))
        radiance_add(&radiance, prefix,
                     direct_light(scene, &bsdf, &surface, interior, ray.direction, n, weight, chosen, false, &rays,
                                  counters));
      // Half of the paths end where they count, for what photons bring; the others go on.
      real times = several && counts ? 2 : 1;
      weight *= times;
      if (goes_on) {
        BsdfSample next = diffuse_sample(&bsdf, &surface, ray.direction, n, random);
        throughput *= times * next.weight;
        if (!path_survives(&throughput, bounce, random.w)) break;
        ray.origin = boundary_depart(scene, &boundary, &surface, ray.direction, next.direction);
        if (nested(scene)) interior = interior_of_stack(scene, &boundary.media.stack);
        ray.direction = next.direction;
        bsdf_pdf = 0;
        point.normal = 0;
        beyond = true;
        continue;
      }
      vstore3(surface.position, 0, point.position);
      vstore3(weight, 0, point.weight);
      break;
    }

    prefix = prefix_after(prefix, bsdf_is_specular(&bsdf));
    bool delta_lights = HAS(EFFECT_DELTA_LIGHTS) && params->delta_lights > 0;
    bool weigh_lights = (shadow_rays || delta_lights) && bsdf_is_rough(&bsdf) && !beyond;
    if (weigh_lights && !media_covered(scene, &boundary.media)) {
      real3 n = facing_normal(&surface, ray.direction);
      radiance_add(&radiance, prefix,
                   direct_light_rough(scene, &bsdf, &surface, interior, boundary_behind(scene, &boundary), ray.direction, n, throughput,
                                      path_random_at(&sampler, bounce, DIM_LIGHT), &rays, counters));
    }
    BsdfSample next = bsdf_sample(&bsdf, &surface, ray.direction, random, true);
    bsdf_pdf = weigh_lights ? next.pdf : 0;
    throughput *= next.weight;
    if (!path_survives(&throughput, bounce, random.w)) break;
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) interior = interior_after(interior, material, &surface, next.direction);
    ray.origin = boundary_depart(scene, &boundary, &surface, ray.direction, next.direction);
    if (nested(scene)) interior = interior_of_stack(scene, &boundary.media.stack);
    ray.direction = next.direction;
  }
  vstore3(radiance.sum, 0, point.radiance);
  visible_points[index] = point;
  if (HAS(OUTPUT_LIGHT_PASSES)) {
    global VisibleLightPasses *layers = visible_layers(visible_points, params) + index;
    for (uint i = 0; i < LIGHT_PASS_COUNT; ++i) vstore3(radiance.layer[i], 0, layers->radiance[i]);
  }
  if (HAS(EFFECT_MEDIUM)) vstore3(segment, 0, visible_segments(visible_points, params)[index].offset);
  return rays;
}

#if DIFFUSE_VERTICES_BATCHED
// Paths [first, end) of the chunk. Returns the number of rays.
OUTLINE uint camera_paths(const Scene *scene, const Params *params, uint first, uint end,
                          global VisiblePoint *visible_points, volatile global Counters *counters, global const SppmPixel *pixels) {
  DiffuseVertices diffuse_vertices;
  uint count = 0, rays = 0, others[STREAM_CAPACITY], other_count = 0, samples = params->visible_points;
  uint pixel = params->first_pixel + first / samples, sample = first % samples;
  for (uint index = first; index < end; ++index) {
    bool receives = false;
    if (PRIMARY_HITS_FOUND) {
      // Most paths end at what they meet first. Lists without branches, since where they do is as good as random.
      global const PrimaryHit *found = (global const PrimaryHit *)visible_points + index;
      Hit hit = hit_none(INFINITY);
      if (primary_hit(found, &hit))
        receives = is_lambert(scene->materials[geometry_material(&scene->geometry, hit)].kind);
      diffuse_vertices_put(&diffuse_vertices, count, pixel, sample, first_ray(found), hit, (real3)(1, 1, 1), (real3)(0, 0, 0), 0, false);
    }
    others[other_count] = index;
    count += receives ? 1u : 0u;
    other_count += receives ? 0u : 1u;
    sample = sample + 1 == samples ? 0 : sample + 1;
    pixel += sample == 0 ? 1u : 0u;
  }
  rays += count;
  for (uint i = 0; i < other_count; ++i)
    rays += camera_path(scene, params, others[i], visible_points, counters, pixels, &diffuse_vertices, &count);
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
    rays += camera_paths(&scene, &params, index, min(index + STREAM_CAPACITY, end), visible_points, counters, pixels);
  count_rays(rays, counters);
#else
  local uint group_rays[LARGEST_WORK_GROUP];
  if (index < paths) {
    SCENE_INIT(params);
    if (HAS(EFFECT_WALLS)) scene.walls = walls;
    rays = camera_path(&scene, &params, index, visible_points, counters, pixels, 0, 0);
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
