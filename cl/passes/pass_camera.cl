// Camera paths of SPPM, one for each visible point.
#include "core/work_group.cl"
#include "photons/visible_stream.cl"

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

#if !DIFFUSE_VERTICES_BATCHED
// One visible point for each of visible_points samples of each pixel of the chunk, at index
// (pixel of the film - first_pixel) * visible_points + sample. Returns the number of rays traced.
OUTLINE uint visible_path(const Scene *scene, const Params *params, uint index, global VisiblePoint *visible_points,
                          volatile global Counters *counters, global const SppmPixel *pixels) {
  global const PrimaryHit *first = (global const PrimaryHit *)visible_points + index;  // where the visible point will be
  Boundary boundary;
  VisiblePath visible;
  CameraPath path = visible_path_begin(scene, params, index, first, &boundary, &visible, counters);
  for (;; ++path.bounce) {
    Hit hit;
    camera_path_trace(scene, &path, &boundary, first, &hit, counters);
    if (visible_path_step(scene, &path, &boundary, &visible, hit, visible_points, pixels, counters) == VISIBLE_ENDS) break;
  }
  visible_store(&path, &visible, visible_points);
  return path.rays;
}
#endif

// Traces the camera paths of a chunk. Where they end in a batch, one item of a work-group traces those of all.
kernel void trace_camera(SCENE_PARAMETERS, global VisiblePoint *visible_points, volatile global Counters *counters,
                         Params params, global const SppmPixel *pixels, global const WallGrid *walls) {
  uint index = get_global_id(0), rays = 0, paths = params.pixel_count * params.visible_points;
#if DIFFUSE_VERTICES_BATCHED
  uint end;
  if (!group_share(paths, VISIBLE_PATHS_AN_ITEM, &index, &end)) return;
  SCENE_INIT(params);
  if (HAS(EFFECT_WALLS)) scene.walls = walls;
  count_rays(visible_paths(&scene, &params, index, end, visible_points, counters, pixels), counters);
#else
  local uint group_rays[LARGEST_WORK_GROUP];
  if (index < paths) {
    SCENE_INIT(params);
    if (HAS(EFFECT_WALLS)) scene.walls = walls;
    rays = visible_path(&scene, &params, index, visible_points, counters, pixels);
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
