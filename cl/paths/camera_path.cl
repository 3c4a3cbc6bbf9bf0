// A camera path: what it carries from vertex to vertex, and the steps that all integrators take alike.
//
//   camera_path_begin()      at the lens
//   camera_path_trace()      to the next hit
//   camera_path_arrive()     the surface there, and what glass or the medium absorbed on the way
//   camera_path_bsdf()       how the surface scatters: one lobe of it
//   camera_path_lit_point()  for direct light there
//   camera_path_depart()     along the direction that was sampled
//
// Functions that are not inlined get copies of what they change: else the compiler keeps the whole path in memory.
#include "paths/camera.cl"
#include "paths/path_splitting.cl"
#include "sampling/roulette.cl"
#include "traversal/primary_hits.cl"

typedef struct {
  RandomStream stream;
  uint bounce, max_depth;
  uint rays;        // that were traced
  Ray ray;
  real3 throughput;
  Radiance radiance;
  uint prefix;      // PREFIX_* of light_passes.cl
  real bsdf_pdf;    // of the last direction; 0 where light sampling cannot find what it does
  bool counted;     // the emission ahead is, by path_splitting.cl
  Interior interior;
} CameraPath;

// `boundary` is where the path is among dielectrics, here and below.
INLINE CameraPath camera_path_begin(const Scene *scene, Boundary *boundary, Ray ray, RandomStream stream, uint max_depth,
                                    volatile global Counters *counters) {
  CameraPath path;
  path.stream = stream;
  path.bounce = 0, path.max_depth = max_depth;
  path.rays = 0;
  path.ray = ray;
  path.throughput = (real3)(1, 1, 1);
  path.radiance = radiance_none();
  path.prefix = PREFIX_NO_DIFFUSE;
  path.bsdf_pdf = 0;
  path.counted = false;
  Interior interior = interior_none();
  boundary_at_camera(scene, boundary, ray, &interior, counters);
  path.interior = interior;
  return path;
}

// Whether the path hits anything, and what. `first` is where its primary hit is kept, if that has been found.
INLINE bool camera_path_trace(const Scene *scene, CameraPath *path, const Boundary *boundary,
                              global const PrimaryHit *first, Hit *hit, volatile global Counters *counters) {
  *hit = hit_none(INFINITY);
  ++path->rays;
  bool did_hit = PRIMARY_HITS_FOUND && path->bounce == 0
                     ? primary_hit(first, hit)
                     : media_closest(scene, &boundary->media, path->ray, hit);
  count_diagnostics(hit->diagnostics, counters);
  return did_hit;
}

// Adds the light from beyond the scene that a path into the open finds.
INLINE void camera_path_escape(const Scene *scene, CameraPath *path) {
  if (HAS(EFFECTS_OF_LIGHTS(BACKGROUND)) && !path->counted)
    radiance_add(&path->radiance, path->prefix,
                 path->throughput * escaped_radiance(scene, path->ray.direction, path->bsdf_pdf));
}

// The surface at the hit. Returns its material.
INLINE global const Material *camera_path_arrive(const Scene *scene, CameraPath *path, Boundary *boundary, Hit *hit,
                                                 Surface *surface, volatile global Counters *counters) {
  geometry_surface(&scene->geometry, path->ray, *hit, surface);
  Interior interior = path->interior;
  boundary_arrive(scene, boundary, path->ray, hit, surface, &interior, counters);
  path->interior = interior;
  global const Material *material = scene->materials + surface->material;
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) {
    if (!nested(scene)) path->interior = interior_before(path->interior, material, surface, path->ray.direction);
    path->throughput *= interior_transmittance(path->interior, hit->t);
  }
  return material;
}

// How the surface scatters, after the path was split there: of a layered material one lobe, chosen by `random`.
INLINE Bsdf camera_path_bsdf(const Scene *scene, CameraPath *path, const Boundary *boundary,
                             global const Material *material, const Surface *surface, real random,
                             volatile global Counters *counters) {
  real3 wi = path->ray.direction, throughput = path->throughput;
  Bsdf bsdf = bsdf_at(material, scene->textures, scene->texels, surface->uv);
  if (HAS(EFFECT_TEXTURES)) make_finite(&bsdf.color, counters);
  boundary_bsdf(scene, boundary, material, surface, wi, random_at(path->stream, path->bounce, DIM_CHANNEL).x,
                &bsdf, &throughput);
  path->throughput = throughput;
  if (HAS(EFFECTS_OF_MATERIALS(TRANSMITS | LAYERED))) {
    PathVertex vertex = {surface,        boundary,     path->ray,    throughput,      path->interior,
                         path->prefix,   path->bounce, path->max_depth, path->stream};
    Radiance radiance = path->radiance;
    uint rays = path->rays;
    path->counted = split_at_dielectric(scene, &vertex, &bsdf, random, path->counted, &radiance, &rays, counters);
    path->radiance = radiance, path->rays = rays;
  }
  if (is_layered(bsdf.kind)) choose_lobe(&bsdf, wi, facing_normal(surface, wi), random);
  return bsdf;
}

INLINE LitPoint camera_path_lit_point(const CameraPath *path, const Bsdf *bsdf, const Surface *surface) {
  LitPoint point = {bsdf, surface, path->interior, path->ray.direction, facing_normal(surface, path->ray.direction), false};
  return point;
}

// Adds what a rough lobe turns to the path of the light from one emitter, which `random` chooses.
INLINE void camera_path_light_rough(const Scene *scene, CameraPath *path, const Boundary *boundary, const Bsdf *bsdf,
                                    const Surface *surface, real4 random, volatile global Counters *counters) {
  LitPoint point = camera_path_lit_point(path, bsdf, surface);
  uint rays = path->rays;
  real3 found = direct_light_rough(scene, &point, boundary_behind(scene, boundary), path->throughput, random, &rays,
                                   counters);
  path->rays = rays;
  radiance_add(&path->radiance, path->prefix, found);
}

// Whether the path goes on along `next` after Russian roulette by `random`, and its ray from there.
INLINE bool camera_path_depart(const Scene *scene, CameraPath *path, Boundary *boundary, global const Material *material,
                               const Surface *surface, BsdfSample next, real random) {
  real3 throughput = path->throughput * next.weight;
  if (!path_survives(&throughput, path->bounce, random)) return false;
  path->throughput = throughput;
  if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM))
    path->interior = interior_after(path->interior, material, surface, next.direction);
  path->ray.origin = boundary_depart(scene, boundary, surface, path->ray.direction, next.direction);
  if (nested(scene)) path->interior = interior_of_stack(scene, &boundary->media.stack);
  path->ray.direction = next.direction;
  return true;
}
