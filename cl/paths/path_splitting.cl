// Emission that a camera path would see by the unlikely lobe of smooth glass or coated diffuse: the
// highlights of emitters, and skies, in glass balls and on coated surfaces. Left to chance, one path in
// twenty-five brings all of it, and pictures sparkle for thousands of passes. So at its first vertices, as
// long as all of them were smooth, the path looks along the lobe that it is unlikely to take, and what that
// shows counts by the lobe's probability; from there on the look follows the likely lobes, to the first
// surface that is no perfect mirror or glass. The path itself then counts no emission that a look has
// counted: what it meets after such a lobe by likely ones alone. Every way to an emitter is so counted once,
// by the look at its last unlikely lobe or, where the path does not look, by the path.
#include "lights/direct.cl"
#include "film/light_passes.cl"

// Vertices of a path at which it looks. With 0 all is left to chance.
#ifndef SPLITTING_VERTICES
#define SPLITTING_VERTICES 4u
#endif

// A vertex of a camera path, as it stands before the path goes on from there.
typedef struct {
  const Surface *surface;
  const Boundary *boundary;
  Ray ray;          // by which the path came
  real3 throughput;
  Interior interior;
  uint prefix, bounce, max_depth;
  RandomStream stream;
} PathVertex;

// Adds what lies at the end of the lobe of `lobe` that lobe_number draws at a vertex, and of the likely lobes from there on.
// `branch_throughput` is the path's throughput times the probability of that lobe.
OUTLINE void trace_unlikely_branch(const Scene *scene, const PathVertex *from, const Bsdf *lobe, real lobe_number,
                                   real3 branch_throughput, Radiance *radiance, uint *rays,
                                   volatile global Counters *counters) {
  Bsdf bsdf = *lobe;
  Surface surface = *from->surface;
  Boundary boundary;
  if (nested(scene)) boundary = *from->boundary;
  Ray ray = from->ray;
  Interior interior = from->interior;
  uint bounce = from->bounce;
  for (;;) {
    BsdfSample next = bsdf_sample(&bsdf, &surface, ray.direction, (real4)(0, 0, lobe_number, 0), true);
    branch_throughput *= next.weight;
    if (!(max_component(branch_throughput) > 0)) return;
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM))
      interior = interior_after(interior, scene->materials + surface.material, &surface, next.direction);
    ray.origin = boundary_depart(scene, &boundary, &surface, ray.direction, next.direction);
    ray.direction = next.direction;
    ++bounce;
    Hit hit = hit_none(INFINITY);
    ++*rays;
    bool did_hit = media_closest(scene, &boundary.media, ray, &hit);
    count_diagnostics(hit.diagnostics, counters);
    if (!did_hit) {
      if (HAS(EFFECTS_OF_LIGHTS(BACKGROUND)))
        radiance_add(radiance, PREFIX_NO_DIFFUSE, branch_throughput * escaped_radiance(scene, ray.direction, 0));
      return;
    }
    geometry_surface(&scene->geometry, ray, hit, &surface);
    boundary_arrive(scene, &boundary, ray, &hit, &surface, &interior, counters);
    global const Material *material = scene->materials + surface.material;
    if (HAS(EFFECT_ABSORPTION | EFFECT_MEDIUM)) {
      if (!nested(scene)) interior = interior_before(interior, material, &surface, ray.direction);
      branch_throughput *= interior_transmittance(interior, hit.t);
    }
    radiance_add(radiance, PREFIX_NO_DIFFUSE, branch_throughput * emission_at(material, &surface, ray.direction));
    if (bounce == from->max_depth) return;
    bsdf = bsdf_at(material, scene->textures, scene->texels, surface.uv);
    if (HAS(EFFECT_TEXTURES)) make_finite(&bsdf.color, counters);
    // Which decides whether a lobe is smooth.
    boundary_bsdf(scene, &boundary, material, &surface, ray.direction, random_at(from->stream, bounce, DIM_CHANNEL).x, &bsdf,
                  &branch_throughput);
    if (!bsdf_is_specular(&bsdf) || is_layered(bsdf.kind)) return;
    // What absorbing glass reflects to and fro is not worth following for long.
    real survival = fmin(1000 * max_component(branch_throughput), (real)1);
    if (random_at(from->stream, bounce, DIM_BRANCH).x >= survival) return;
    branch_throughput /= survival;
    if (transmits(bsdf.kind)) {
      real reflectance = lobe_reflectance(&bsdf, &surface, ray.direction, facing_normal(&surface, ray.direction));
      lobe_number = reflectance < (real)0.5f ? 1 : 0;
      branch_throughput *= fmax(reflectance, 1 - reflectance);
    }
  }
}

// Looks along the unlikely lobe at a vertex of a camera path, before the path chooses its own by `lobe_number`.
// `counted` is whether looks have counted the emission that the path has ahead, as it comes to the vertex; returns
// whether they have as it leaves. After a vertex of coated diffuse that became Lambert it is of no meaning.
INLINE bool split_at_dielectric(const Scene *scene, const PathVertex *at, const Bsdf *bsdf, real lobe_number, bool counted,
                                Radiance *radiance, uint *rays, volatile global Counters *counters) {
  bool through = transmits(bsdf->kind) && !bsdf_is_rough(bsdf), layered = is_layered(bsdf->kind) && !bsdf_is_rough(bsdf);
  if (!through && !layered) return counted && bsdf_is_specular(bsdf);
  // In a medium the look would be a path of its own, which may be scattered.
  bool looks = scene->emission_met && at->prefix == PREFIX_NO_DIFFUSE && at->bounce < SPLITTING_VERTICES;
  if (HAS(EFFECT_MEDIUM) && max_component(scene->medium.extinction) > 0) looks = false;
  // The boundary of coated diffuse is looked along, likely or not, and weighs what it reflects.
  real probability = 1, toward = 0;
  bool taken = true;
  Bsdf lobe = *bsdf;
  if (layered) lobe.color = (real3)(1, 1, 1);
  if (through) {
    real3 d = at->ray.direction;
    real reflectance = lobe_reflectance(bsdf, at->surface, d, facing_normal(at->surface, d));
    bool reflects = reflectance < (real)0.5f;
    probability = fmin(reflectance, 1 - reflectance);
    toward = reflects ? 0 : 1;
    taken = (lobe_number < reflectance) == reflects;
  }
  if (looks && probability > 0)
    trace_unlikely_branch(scene, at, &lobe, toward, at->throughput * probability, radiance, rays, counters);
  return taken ? looks : counted;
}
