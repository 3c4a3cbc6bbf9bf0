// Camera paths of SPPM: from the lens by mirrors, glass and rough lobes to the first diffuse surface, or to where the
// medium interacts with them first.
#include "film/light_passes.cl"
#include "lights/direct.cl"
#include "lights/horizon.cl"
#include "paths/camera_path.cl"
#include "photons/first_diffuse_vertices.cl"
#include "photons/kernel_area.cl"
#include "photons/visible_point.cl"
#include "paths/lambert_vertex.cl"

// What becomes of a camera path: its visible point.
typedef struct {
  const Params *params;
  PathSampler sampler;
  uint index;        // in the chunk
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
  real4 random = path_random_at(&visible->sampler, path->bounce, DIM_MEDIUM);
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
                                      path_random_at(&visible->sampler, path->bounce, DIM_LIGHT), false, &rays, counters);
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

// Whether several infinite planes send each other light to the horizon, so that paths go on from diffuse surfaces.
INLINE bool beside_horizon(const Scene *scene, const Params *params) {
  return params->plane_count > 1 && has_horizon(&scene->geometry);
}

// Whether the emission at a hit counts less than in full, since light sampling finds it too.
INLINE bool weighs_emission(const Scene *scene, real bsdf_pdf, Hit hit) {
  if (!HAS(EFFECT_ROUGH) || !(bsdf_pdf > 0)) return false;
  global const Material *material = scene->materials + geometry_material(&scene->geometry, hit);
  return max_component(convert_real3(material->emission.xyz)) > 0;
}

// The visible point at a diffuse surface, and direct light there. Returns whether the path goes on from there, by `next`:
// see horizon.cl.
INLINE bool visible_at_surface(const Scene *scene, CameraPath *path, const Boundary *boundary, VisiblePath *visible,
                               Hit hit, const LitPoint *at, global const SppmPixel *pixels,
                               volatile global Counters *counters) {
  const Params *params = visible->params;
  const PathSampler *sampler = &visible->sampler;
  const Surface *surface = at->surface;
  real3 wi = at->wi, weight = path->throughput * at->bsdf->color * INV_PI;
  if (!(max_component(weight) > 0)) return false;
  bool far = is_far(&scene->geometry, hit, surface->position);
  bool counts = !visible->beyond || (far && passes_sphere(&scene->geometry, surface->position, -wi));
  bool several = beside_horizon(scene, params);
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

INLINE void visible_store(const CameraPath *path, VisiblePath *visible, global VisiblePoint *visible_points) {
  const Params *params = visible->params;
  uint index = visible->index;
  vstore3(path->radiance.sum, 0, visible->point.radiance);
  visible_points[index] = visible->point;
  if (HAS(OUTPUT_LIGHT_PASSES)) {
    global VisibleLightPasses *layers = visible_layers(visible_points, params) + index;
    for (uint i = 0; i < LIGHT_PASS_COUNT; ++i) vstore3(path->radiance.layer[i], 0, layers->radiance[i]);
  }
  if (HAS(EFFECT_MEDIUM)) vstore3(visible->segment, 0, visible_segments(visible_points, params)[index].offset);
}

// Whether some paths to diffuse surfaces are in no batch.
#define SOME_DIFFUSE_ALONE \
  (!DIFFUSE_VERTICES_BATCHED || \
   HAS(EFFECTS_NOT_BATCHED(SCALAR_EVENTS) | EFFECT_TEXTURES | EFFECTS_OF_LIGHTS(SURFACE)))

// The path number `index` of the chunk, at the lens. `first` is where its primary hit is kept, if that has been found.
INLINE CameraPath visible_path_begin(const Scene *scene, const Params *params, uint index, global const PrimaryHit *first,
                                     Boundary *boundary, VisiblePath *visible, volatile global Counters *counters) {
  bool shadow_rays = HAS(EFFECT_SHADOW_RAYS) && params->shadow_rays != 0;
  VisiblePath begun = {params, chunk_sampler(params, params->visible_points, index), index, index % params->visible_points,
                       shadow_rays, false, {{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}}, (real3)(0, 0, 0)};
  *visible = begun;
  uint pixel = begun.sampler.pixel;
  Ray ray = PRIMARY_HITS_FOUND
                ? first_ray(first)
                : path_ray(params, pixel % params->width, pixel / params->width, begun.sample, params->sobol != 0);
  return camera_path_begin(scene, boundary, ray, begun.sampler.stream, params->max_depth, counters);
}

// What a step of the path leads to.
#define VISIBLE_ENDS 0u
#define VISIBLE_GOES_ON 1u
#define VISIBLE_LAMBERT 2u  // to a Lambert vertex that a batch holds

// Takes the path past its hit, if there is one: emission met on the way is exact; direct light at the visible point comes by a
// shadow ray where the program was built for that, else from photons. There the emission that rough lobes reflect is found
// by shadow rays too, weighted against the rays that meet it; that of delta lights, which no ray meets, in either case.
INLINE uint visible_path_step(const Scene *scene, CameraPath *path, Boundary *boundary, VisiblePath *visible, Hit hit,
                              global VisiblePoint *visible_points, global const SppmPixel *pixels,
                              volatile global Counters *counters) {
  const Params *params = visible->params;
  bool did_hit = hit.primitive != HIT_NONE;
  bool delta_lights = HAS(EFFECTS_OF_LIGHTS(DELTA)) && params->delta_lights > 0;
  if (HAS(EFFECT_MEDIUM) && medium_along(scene, path->ray, hit, did_hit, path->interior) &&
      visible_in_medium(scene, path, visible, hit, counters))
    return VISIBLE_ENDS;
  if (!did_hit) {
    if (!visible->beyond) camera_path_escape(scene, path);
    return VISIBLE_ENDS;
  }
  if (DIFFUSE_VERTICES_BATCHED && !beside_horizon(scene, params) &&
      is_outside(scene, path->interior, &boundary->media) && meets_lambert(scene, path->ray, hit) &&
      !weighs_emission(scene, path->bsdf_pdf, hit))
    return VISIBLE_LAMBERT;
  Surface surface;
  global const Material *material = camera_path_arrive(scene, path, boundary, &hit, &surface, counters);
  visible_emission(scene, path, visible, hit, &surface, material);
  if (path->bounce == params->max_depth) return VISIBLE_ENDS;

  real4 random = path_random_at(&visible->sampler, path->bounce, DIM_BSDF);
  Bsdf bsdf = camera_path_bsdf(scene, path, boundary, material, &surface, random.z, counters);
  if (SOME_DIFFUSE_ALONE && is_diffuse(bsdf.kind)) {
    LitPoint at = camera_path_lit_point(path, &bsdf, &surface);
    bool goes_on = visible_at_surface(scene, path, boundary, visible, hit, &at, pixels, counters);
    if (HAS(EFFECTS_OF_MATERIALS(SCATTERS)))
      visible_lobes(visible_points, params)[visible->index] = visible_lobe(&bsdf, at.wi, at.n);
    if (!goes_on) return VISIBLE_ENDS;
    BsdfSample next = diffuse_sample(&bsdf, &surface, path->ray.direction, at.n, random);
    if (!camera_path_depart(scene, path, boundary, material, &surface, next, random.w)) return VISIBLE_ENDS;
    path->bsdf_pdf = 0;
    visible->point.normal = 0;
    visible->beyond = true;
    return VISIBLE_GOES_ON;
  }
  path->prefix = prefix_after(path->prefix, bsdf_is_specular(&bsdf));
  bool weigh_lights = (visible->shadow_rays || delta_lights) && bsdf_is_rough(&bsdf) && !visible->beyond;
  if (weigh_lights && !media_covered(scene, &boundary->media))
    camera_path_light_rough(scene, path, boundary, &bsdf, &surface,
                            path_random_at(&visible->sampler, path->bounce, DIM_LIGHT), counters);
  BsdfSample next = bsdf_sample(&bsdf, &surface, path->ray.direction, random, true);
  path->bsdf_pdf = weigh_lights ? next.pdf : 0;
  return camera_path_depart(scene, path, boundary, material, &surface, next, random.w) ? VISIBLE_GOES_ON : VISIBLE_ENDS;
}
