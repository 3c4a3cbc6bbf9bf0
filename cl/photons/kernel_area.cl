// How much of a kernel lies on surfaces. Photons are counted in a ball, and their number is divided by the area of a disc
// of its radius: beyond an edge, in a corner and beside a slit that disc holds no surface, so that the estimate is too dark
// there ("boundary bias"; Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001, section 7.4). So visible points
// probe a place of their disc, and a pixel divides by the mean of what its last hundred probes found. That mean is common
// to many passes, so that what it is off by is not in their spread; and dividing by it is right but for its variance over its
// square: with a hundred probes at a straight edge, 1%.
#include "core/film_pixels.cl"
#include "photons/kernel_area_mean.cl"
#include "photons/grid.cl"
#include "scene/path_media.cl"
#include "photons/walls.cl"
#include "sampling/warp.cl"

// A quarter of the probes is of the disc of half the radius, which only the error estimate asks for.
#define KERNEL_AREA_FRACTION_OF_HALF 0.25f

// Surfaces that keep no photons, as glass, are passed by, up to this many.
#define KERNEL_AREA_MOST_HITS 4u

// Whether visible point number `sample` of the pixel is to probe, and of which radius.
INLINE bool probe_wanted(const Params *params, global const SppmPixel *pixels, uint pixel, uint sample, real *radius) {
  global const SppmPixel *state = pixels + film_pixel(params, pixel);
  bool in_turn = sample == params->pass % params->visible_points;
  if (!params->coverage || !kernel_area_wanted(state->coverage, pixel, params->pass, in_turn)) return false;
  *radius = params->indirect_radius * sqrt(params->radius2 > 0 ? params->radius2 : state->radius2_hi);
  return true;
}

// Whether the primitive of a visible point's hit goes on at a place beside it: no ray need tell.
INLINE bool kernel_area_goes_on(const Geometry *g, Hit hit, real3 offset) {
  if (!(hit.primitive & HIT_SHAPE)) return HAS(EFFECT_TRIANGLES) ? triangle_holds(g->blocks, hit, offset) : false;
  return HAS(EFFECT_PLANES) ? g->shapes[hit.primitive & ~HIT_SHAPE].type == SHAPE_PLANE : false;
}

// The nearest surface before hit->t that keeps photons. Of several that lie at one place it finds that one, where a ray
// that is moved past glass would pass it by.
OUTLINE bool kernel_area_closest(const Scene *scene, Ray ray, Hit *hit) {
  HitFilter filter = {scene->materials, false};
  HitList list;
  geometry_hits(&scene->geometry, ray, hit->t, &filter, &list);
  bool found = false;
  for (uint i = 0; i < list.count; ++i) {
    if (!(list.hit[i].t < hit->t)) continue;
    Surface surface;
    geometry_surface(&scene->geometry, ray, list.hit[i], &surface);
    global const Material *material = scene->materials + surface.material;
    Bsdf bsdf = bsdf_at(material, scene->textures, scene->texels, surface.uv);
    if (!keeps_photons(&bsdf, material)) continue;
    *hit = list.hit[i];
    found = true;
  }
  return found;
}

// The probe of a visible point at `position`, where the hit `here` is, on a surface whose normal `n` is on its side, for a
// ball of that radius: what lies first of surfaces that keep photons, along the chord that is the ball's normal at the
// place; but the primitive of `here` wherever that goes on. Surface that leans away by as much as photons must not does
// not count (GATHER_NORMAL_COSINE). Beside walls it is what lies first of what no wall parts from the visible point.
OUTLINE uint kernel_area_probe(const Scene *scene, Hit here, real3 position, real3 n, real radius2, real4 random,
                            uint *rays, volatile global Counters *counters) {
  uint probe = KERNEL_AREA_PROBED;
  if (random.w < KERNEL_AREA_FRACTION_OF_HALF) {
    radius2 /= 4;
    probe |= KERNEL_AREA_OF_HALF;
  }
  real3 tangent, bitangent;
  orthonormal_basis(n, &tangent, &bitangent);
  real2 place = sqrt(radius2) * disc_uniform(random.xy);
  real half_chord = sqrt(fmax(radius2 - dot(place, place), (real)0)), left = 2 * half_chord;
  real3 offset = place.x * tangent + place.y * bitangent;
  NearWalls near;
  bool walled = HAS(EFFECT_WALLS) && walls_listed(scene->walls, position, n, sqrt(radius2), &near);
  if (kernel_area_goes_on(&scene->geometry, here, offset) && !(walled && walls_between(&near, position + offset, n)))
    return probe | 1u << KERNEL_AREA_SHIFT;
  Ray ray = {position + offset + half_chord * n, -n};
  for (uint i = 0; i < KERNEL_AREA_MOST_HITS; ++i) {
    Hit hit = hit_none(left);
    ++*rays;
    bool did_hit = nested(scene) ? kernel_area_closest(scene, ray, &hit) : geometry_closest(&scene->geometry, ray, &hit);
    count_diagnostics(hit.diagnostics, counters);
    if (!did_hit) return probe;
    Surface surface;
    geometry_surface(&scene->geometry, ray, hit, &surface);
    global const Material *material = scene->materials + surface.material;
    Bsdf bsdf = bsdf_at(material, scene->textures, scene->texels, surface.uv);
    if (keeps_photons(&bsdf, material)) {
      real cosine = fabs(dot(surface.geometric_normal, n));
      bool leans = !(cosine > GATHER_NORMAL_COSINE);
      real3 side = dot(surface.geometric_normal, n) < 0 ? -surface.geometric_normal : surface.geometric_normal;
      if (leans && !walled) return probe;
      if (!leans && !(walled && walls_between(&near, surface.position, side)))
        return probe | min((uint)(1 / cosine + random.z), 2u) << KERNEL_AREA_SHIFT;
    }
    left -= hit.t;
    ray.origin = offset_origin(surface.position, surface.error, surface.geometric_normal, ray.direction);
  }
  return probe;
}
