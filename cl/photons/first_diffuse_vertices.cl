// Camera paths that have come to a Lambert vertex, in a batch: their visible points, and direct light there,
// by loops over them which PoCL's compiler turns into vector code (see vector.cl and photon_stream.cl).
#include "photons/kernel_area.cl"
#include "lights/direct.cl"
#include "photons/grid.cl"
#include "photons/photon_stream.cl"
#include "paths/lambert_vertex.cl"
#include "sampling/sobol.cl"
#include "shapes/ray_components.cl"
#include "traversal/ray_stream.cl"
#include "traversal/triangle_packet.cl"

// Light passes ask for more than a first diffuse vertex keeps.
#define DIFFUSE_VERTICES_BATCHED VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_LAMBERT) | OUTPUT_LIGHT_PASSES)

#if DIFFUSE_VERTICES_BATCHED && defined(STREAM_BRUTE_FORCE)
#define SHADOWS_BY_BRUTE_FORCE
#endif

// A path as it comes to a diffuse surface.
typedef struct {
  Ray ray;
  Hit hit;
  real3 throughput, radiance;
  bool counted;  // whether the emission there is, by path_splitting.cl
  uint bounce;   // of the vertex
  uint pixel, sample;
} DiffuseArrival;

// As lists of components.cl: what the path carries; its visible point (position and error as in Surface, the geometric normal
// on the path's side, facing_normal(), its weight, zero where there is none); and light there, as in LightCandidate, whose
// ray is then the path's.
#define ARRIVAL_COMPONENTS(ROW, x) \
  ROW(x, VECTOR, real, throughput, throughput, ALWAYS) \
  ROW(x, VECTOR, real, radiance, radiance, ALWAYS) \
  ROW(x, SCALAR, uint, counted, counted, ALWAYS) \
  ROW(x, SCALAR, uint, bounce, bounce, ALWAYS) \
  ROW(x, SCALAR, uint, pixel, pixel, ALWAYS) \
  ROW(x, SCALAR, uint, sample, sample, ALWAYS)
#define POINT_COMPONENTS(ROW, x) \
  ROW(x, VECTOR, real, position, position, ALWAYS) \
  ROW(x, SCALAR, real, error, error, ALWAYS) \
  ROW(x, VECTOR, real, side, side, ALWAYS) \
  ROW(x, VECTOR, real, facing, facing, ALWAYS) \
  ROW(x, VECTOR, real, weight, weight, ALWAYS)
#define LIGHT_COMPONENTS(ROW, x) \
  ROW(x, SCALAR, real, distance, distance, ALWAYS) \
  ROW(x, VECTOR, real, reflected, reflected, ALWAYS)

// The visible point of a path.
typedef struct {
  real3 position, side, facing, weight;
  real error;
} DiffusePoint;

// The last ray of each path and its hit, what the path carries, and what is found out about its end. What loops over them read is
// set up to stream_padded() of their number; rays beyond are masked where packets of sixteen are read.
typedef struct {
  RAY_COMPONENTS(COMPONENT_FIELD, )
  HIT_COMPONENTS(COMPONENT_FIELD, )
  ARRIVAL_COMPONENTS(COMPONENT_FIELD, )
  POINT_COMPONENTS(COMPONENT_FIELD, )
  uint normal[STREAM_CAPACITY];
  uint non_finite[STREAM_CAPACITY];  // 1 where its texture is no number
  uint emitter[STREAM_CAPACITY];
  real random[4][STREAM_CAPACITY];  // by which it is chosen, and the place on it
  LIGHT_COMPONENTS(COMPONENT_FIELD, )
} DiffuseVertices;

INLINE PathSampler diffuse_vertex_sampler(const Params *params, const DiffuseVertices *r, uint i, uint sobol) {
  return path_sampler(params->seed, params->pass, r->pixel[i], r->sample[i], params->visible_points, sobol);
}

INLINE Ray diffuse_vertex_ray(const DiffuseVertices *state, uint i) {
  Ray ray;
  RAY_COMPONENTS(LOAD_ENTRY, ray)
  return ray;
}

INLINE Hit diffuse_vertex_hit(const DiffuseVertices *state, uint i) {
  Hit hit;
  HIT_COMPONENTS(LOAD_ENTRY, hit)
  hit.diagnostics = 0;
  return hit;
}

// Makes path i one that arrives so.
INLINE void diffuse_vertices_put(DiffuseVertices *state, uint i, const DiffuseArrival *at) {
  RAY_COMPONENTS(STORE_ENTRY, at->ray)
  HIT_COMPONENTS(STORE_ENTRY, at->hit)
  ARRIVAL_COMPONENTS(STORE_ENTRY, (*at))
}

// Makes path i that before it once more.
INLINE void diffuse_vertices_repeat(DiffuseVertices *state, uint i) {
  RAY_COMPONENTS(MOVE_ENTRY, i - 1)
  HIT_COMPONENTS(MOVE_ENTRY, i - 1)
  ARRIVAL_COMPONENTS(MOVE_ENTRY, i - 1)
}

INLINE DiffusePoint diffuse_vertex_get_point(const DiffuseVertices *state, uint i) {
  DiffusePoint point;
  POINT_COMPONENTS(LOAD_ENTRY, point)
  return point;
}

INLINE void diffuse_vertex_put_point(DiffuseVertices *state, uint i, DiffusePoint point) {
  POINT_COMPONENTS(STORE_ENTRY, point)
}

// The light, and its ray in place of the path's.
INLINE void diffuse_vertex_put_light(DiffuseVertices *state, uint i, LightCandidate light) {
  RAY_COMPONENTS(STORE_ENTRY, light.shadow)
  LIGHT_COMPONENTS(STORE_ENTRY, light)
}

INLINE bool diffuse_vertex_reflects(const DiffuseVertices *r, uint i) {
  return max(r->weight[0][i], max(r->weight[1][i], r->weight[2][i])) > 0;
}

// What visible_at_surface() does at a diffuse surface, for path i: the visible point, its emission, and the numbers that draw its light.
INLINE void diffuse_vertex_point(const Scene *scene, const Params *params, DiffuseVertices *r, uint i, uint sobol) {
  Ray ray = diffuse_vertex_ray(r, i);
  Hit hit = diffuse_vertex_hit(r, i);
  Surface surface;
  geometry_surface_soa(&scene->geometry, ray, hit, &surface);
  global const Material *material = scene->materials + surface.material;
  real3 throughput = (real3)(r->throughput[0][i], r->throughput[1][i], r->throughput[2][i]);
  real3 emission = mul3(throughput, emission_at(material, &surface, ray.direction));
  bool counted = r->counted[i] != 0;
  r->radiance[0][i] += counted ? 0 : emission.x;
  r->radiance[1][i] += counted ? 0 : emission.y;
  r->radiance[2][i] += counted ? 0 : emission.z;

  Bsdf bsdf = lambert_untextured(material);
  if (HAS(EFFECT_TEXTURES)) {
    bsdf_texture_soa(material, scene->textures, scene->texels, surface.uv, &bsdf);
    bool finite = isfinite(bsdf.color.x + bsdf.color.y + bsdf.color.z);
    r->non_finite[i] = finite || r->bounce[i] == params->max_depth ? 0u : 1u;
    bsdf.color = choose3(finite, bsdf.color, (real3)(0, 0, 0));
  }
  real3 weight = scaled3(INV_PI, mul3(throughput, bsdf.color));
  weight = choose3(r->bounce[i] != params->max_depth && max_component(weight) > 0, weight, (real3)(0, 0, 0));
  real3 g = surface.geometric_normal;
  g = scaled3(dot3(g, ray.direction) < 0 ? 1 : -1, g);
  DiffusePoint point = {surface.position, g, facing_normal(&surface, ray.direction), weight, surface.error};
  diffuse_vertex_put_point(r, i, point);
  r->normal[i] = normal_pack(g);
  PathSampler sampler = diffuse_vertex_sampler(params, r, i, sobol);
  real4 random = path_random4_soa(&sampler, dimension_at(r->bounce[i], DIM_LIGHT));
  r->random[0][i] = random.x, r->random[1][i] = random.y, r->random[2][i] = random.z, r->random[3][i] = random.w;
}

OUTLINE void diffuse_vertices_find_points(const Scene *from, const Params *settings, uint count, DiffuseVertices *r) {
  const Scene scene = *from;
  const Params params = *settings;
  if (params.sobol != 0) {
#if DIFFUSE_VERTICES_BATCHED
#pragma clang loop vectorize(assume_safety)
#endif
    for (uint i = 0; i < count; ++i) diffuse_vertex_point(&scene, &params, r, i, 1);
  } else {
#if DIFFUSE_VERTICES_BATCHED
#pragma clang loop vectorize(assume_safety)
#endif
    for (uint i = 0; i < count; ++i) diffuse_vertex_point(&scene, &params, r, i, 0);
  }
}

// Light from the emitter chosen for the visible point of path i, whose shadow ray takes the place of the path's.
INLINE void diffuse_vertex_light(const Scene *scene, DiffuseVertices *r, uint i) {
  DiffusePoint at = diffuse_vertex_get_point(r, i);
  Surface surface;
  surface.position = at.position;
  surface.geometric_normal = at.side;
  surface.error = at.error;
  real4 random = (real4)(r->random[0][i], r->random[1][i], r->random[2][i], r->random[3][i]);
  Bsdf bsdf;
  bsdf.kind = MATERIAL_DIFFUSE, bsdf.coated = false;  // no more is asked for
  LitPoint point = {&bsdf, &surface, interior_none(), diffuse_vertex_ray(r, i).direction, at.facing, true};
  LightCandidate light = sample_light_unoccluded(scene, r->emitter[i], &point, at.weight, random, false);
  diffuse_vertex_put_light(r, i, light);
}

OUTLINE void diffuse_vertices_sample_lights(const Scene *from, uint count, DiffuseVertices *r) {
  const Scene scene = *from;
#if DIFFUSE_VERTICES_BATCHED && VECTORISED(EFFECTS_NOT_BATCHED(SCALAR_LIGHT_SAMPLES))
#pragma clang loop vectorize(assume_safety)
#endif
  for (uint i = 0; i < count; ++i) diffuse_vertex_light(&scene, r, i);
}

// Whether light comes to the visible point of path i unless something is in the way.
INLINE bool diffuse_vertex_has_shadow_ray(const DiffuseVertices *r, uint i) {
  return max(r->reflected[0][i], max(r->reflected[1][i], r->reflected[2][i])) > 0;
}

// Leaves light alone that is positive and that nothing is in the way of. `count` paths are padded to `padded`. Returns the
// number of rays.
OUTLINE uint diffuse_vertices_occlusion(const Scene *scene, uint count, uint padded, DiffuseVertices *r,
                                        volatile global Counters *counters) {
  const Geometry *g = &scene->geometry;
  uint rays = 0;
  for (uint i = 0; i < padded; ++i) {
    bool asks = i < count && diffuse_vertex_has_shadow_ray(r, i);
    rays += asks ? 1u : 0u;
    r->t[i] = asks ? r->distance[i] : -INFINITY;
    r->primitive[i] = HIT_NONE;
  }
  RayArrays shadows = RAY_ARRAYS(r);
  if (HAS(EFFECT_PLANES)) planes_closest_all(g->shapes, g->plane_count, padded, &shadows);
#ifdef SHADOWS_BY_BRUTE_FORCE
  uint cut_short = brute_force_closest(g->nodes, g->blocks, g->shapes, g->curves, g->plane_count, count, &shadows);
  if (cut_short > 0) atomic_add(&counters->traversal_bound, cut_short);
#else
  uint diagnostics = 0;
  for (uint i = 0; i < count; ++i) {
    if (r->t[i] > 0 && r->primitive[i] == HIT_NONE &&
        bounded_occluded(g, diffuse_vertex_ray(r, i), r->t[i], &diagnostics))
      r->primitive[i] = 0;
    count_diagnostics(diagnostics, counters);
    diagnostics = 0;
  }
#endif
  for (uint i = 0; i < count; ++i) {
    bool arrives = diffuse_vertex_has_shadow_ray(r, i) && r->primitive[i] == HIT_NONE;
    for (uint k = 0; k < 3; ++k) r->reflected[k][i] = arrives ? r->reflected[k][i] : 0;
  }
  return rays;
}

// Probes the disc of the visible points that are to (kernel_area.cl). Returns the number of rays.
OUTLINE uint diffuse_vertices_probe(const Scene *scene, const Params *params, uint count, DiffuseVertices *r,
                             global const SppmPixel *pixels, volatile global Counters *counters) {
  uint rays = 0;
  for (uint i = 0; i < count; ++i) {
    real radius;
    if (!diffuse_vertex_reflects(r, i) || !probe_wanted(params, pixels, r->pixel[i], r->sample[i], &radius)) continue;
    PathSampler sampler = diffuse_vertex_sampler(params, r, i, params->sobol);
    Hit hit = {0, r->primitive[i], r->u[i], r->v[i], 0};
    r->normal[i] |= kernel_area_probe(scene, hit, (real3)(r->position[0][i], r->position[1][i], r->position[2][i]),
                                   (real3)(r->side[0][i], r->side[1][i], r->side[2][i]), radius * radius,
                                   path_random_at(&sampler, r->bounce[i], DIM_KERNEL_AREA), &rays, counters);
  }
  return rays;
}

OUTLINE void diffuse_vertices_store(const Params *params, uint count, const DiffuseVertices *r, bool lit, global VisiblePoint *points) {
  for (uint i = 0; i < count; ++i) {
    VisiblePoint point = {{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
    bool reflects = diffuse_vertex_reflects(r, i);
    point.normal = reflects ? r->normal[i] : 0;
    for (uint k = 0; k < 3; ++k) {
      point.position[k] = reflects ? r->position[k][i] : 0;
      point.weight[k] = r->weight[k][i];
      point.radiance[k] = r->radiance[k][i] + (lit ? r->reflected[k][i] : 0);
    }
    points[(film_pixel(params, r->pixel[i]) - params->first_pixel) * params->visible_points + r->sample[i]] = point;
  }
}

// Finds the visible points of `count` paths and stores them. Returns the number of rays.
OUTLINE uint diffuse_vertices_finish(const Scene *scene, const Params *params, uint count, DiffuseVertices *r,
                              global VisiblePoint *points, global const SppmPixel *pixels,
                              volatile global Counters *counters) {
  if (count == 0) return 0;
  uint padded = stream_padded(count);
  for (uint i = count; i < padded; ++i) diffuse_vertices_repeat(r, i);
  diffuse_vertices_find_points(scene, params, padded, r);
  if (HAS(EFFECT_TEXTURES)) {
    uint non_finite = 0;
    for (uint i = 0; i < count; ++i) non_finite += r->non_finite[i];
    if (non_finite > 0) atomic_add(&counters->non_finite, non_finite);
  }
  uint rays = diffuse_vertices_probe(scene, params, count, r, pixels, counters);
  bool lit = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  if (lit) {
    for (uint i = 0; i < padded; ++i) r->emitter[i] = emitter_choose(scene, r->random[0][i], r->random[3][i]);
    diffuse_vertices_sample_lights(scene, padded, r);
    rays += diffuse_vertices_occlusion(scene, count, padded, r, counters);
  }
  diffuse_vertices_store(params, count, r, lit, points);
  return rays;
}
