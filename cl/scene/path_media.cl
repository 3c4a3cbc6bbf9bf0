// The media along a path where dielectrics touch, overlap, or hold the camera or emitters (EFFECT_NESTED).
//
// Camera paths, photons and looks along unlikely lobes keep one PathMedia each: media_closest() finds what comes next,
// media_arrive() what that is where several surfaces lie at one place, media_bsdf() the index there, media_depart() where
// the path goes on. Where the scene calls for none of it, Interior tells what a path is in by the last surface alone.
#include "scene/contact.cl"

// A path in the gap of no width between a dielectric and an opaque surface in contact: what it meets next.
#define CONTACT_NONE 0u
#define CONTACT_FLOOR 1u  // the opaque surface
#define CONTACT_COVER 2u  // the face of the dielectric

typedef struct {
  MediumStack stack;  // where the path is
  uint contact;       // CONTACT_*; what follows is of use in a gap alone
  MediumStack covered;  // beyond the cover
  uint floor, cover;    // primitives, as in Hit
  real floor_u, floor_v, cover_u, cover_v;
} PathMedia;

INLINE bool nested(const Scene *scene) { return HAS(EFFECT_NESTED) && scene->nested != 0; }

INLINE PathMedia media_outside(void) {
  PathMedia media;
  media.stack = medium_stack_none();
  media.contact = CONTACT_NONE;
  return media;
}

INLINE Interior interior_of_stack(const Scene *scene, const MediumStack *stack) {
  uint top = medium_stack_top(stack);
  return top == MEDIUM_OUTSIDE ? interior_none() : interior_of(scene->materials + top);
}

// The dielectrics that hold a point: those that a ray from there leaves more often than it enters them. The ray follows the
// normals of open surfaces, behind which all counts as inside. Of a sphere or a revolved curve the nearest hit alone is
// known; it is an exit from inside, and only from there.
OUTLINE MediumStack media_around(const Scene *scene, real3 point, uint *diagnostics) {
  Ray ray = {point, unit3(scene->inside_direction)};
  HitFilter filter = {scene->materials, true};
  HitList list;
  geometry_hits(&scene->geometry, ray, INFINITY, &filter, &list);
  if (list.full) *diagnostics |= DIAGNOSTIC_MEDIA_FULL;
  uint material[HIT_LIST_CAPACITY];
  int exits[HIT_LIST_CAPACITY];
  uint count = 0;
  for (uint i = 0; i < list.count; ++i) {
    Surface surface;
    geometry_surface(&scene->geometry, ray, list.hit[i], &surface);
    bool leaves = dot3(surface.geometric_normal, ray.direction) > 0;
    bool shape = (list.primitive[i] & HIT_SHAPE) != 0;
    uint k = 0;
    while (k < count && material[k] != surface.material) ++k;
    if (k == count) {
      material[k] = surface.material;
      exits[k] = 0;
      ++count;
    }
    exits[k] += leaves ? 1 : shape ? 0 : -1;
  }
  MediumStack stack = medium_stack_none();
  for (uint k = 0; k < count; ++k)
    if (exits[k] > 0) medium_stack_enter(&stack, material[k], diagnostics);
  return stack;
}

// The media of a path that starts at the camera.
INLINE PathMedia media_at_camera(const Scene *scene, Ray ray, uint *diagnostics) {
  PathMedia media = media_outside();
  if (nested(scene) && (scene->nested & NESTED_CAMERA)) media.stack = media_around(scene, ray.origin, diagnostics);
  return media;
}

// The media of a photon that starts at an emitter. A face of a dielectric in contact with that is the first thing that it
// meets.
INLINE PathMedia media_at_emitter(const Scene *scene, uint emitter, Ray ray, uint *diagnostics) {
  PathMedia media = media_outside();
  if (!nested(scene) || !scene->emitters[emitter].in_dielectric) return media;
  media.stack = media_around(scene, ray.origin, diagnostics);
  real3 d = ray.direction;
  real error = STORED_GAMMA(16) * max_component(abs3(ray.origin)), t_max;
  Ray probe = contact_ray(ray.origin, d, d, error, &t_max);
  HitFilter filter = {scene->materials, false};
  HitList list;
  geometry_hits(&scene->geometry, probe, t_max, &filter, &list);
  bool covered = false;
  uint top = 0;
  MediumStack gap = medium_stack_none();
  media.floor = HIT_NONE;
  for (uint i = 0; i < list.count; ++i) {
    Surface surface;
    geometry_surface(&scene->geometry, probe, list.hit[i], &surface);
    real3 n = surface.geometric_normal;
    real apart = fabs(dot3(n, sub3(surface.position, ray.origin)));
    if (!(apart <= 2 * error_along(fmax(error, surface.error), n))) continue;
    if (!is_dielectric(scene, &surface)) {
      Hit floor = list.hit[i];
      media.floor = floor.primitive, media.floor_u = floor.u, media.floor_v = floor.v;
      continue;
    }
    if (!(dot3(n, d) < 0)) continue;
    if (!covered) media.covered = gap = media_around(scene, ray_at(ray.origin, t_max, d), diagnostics);
    if (!covered || surface.material >= top) {
      top = surface.material;
      media.cover = list.hit[i].primitive, media.cover_u = list.hit[i].u, media.cover_v = list.hit[i].v;
    }
    covered = true;
    medium_stack_leave(&gap, surface.material);
  }
  if (!covered) return media;
  media.contact = CONTACT_COVER;
  media.stack = gap;
  return media;
}

// geometry_closest() for a path. In a gap what it meets next is known, and no way off.
INLINE bool media_closest(const Scene *scene, const PathMedia *media, Ray ray, Hit *hit) {
  if (!nested(scene) || media->contact == CONTACT_NONE) return geometry_closest(&scene->geometry, ray, hit);
  bool floor = media->contact == CONTACT_FLOOR;
  hit->t = 0;
  hit->primitive = floor ? media->floor : media->cover;
  hit->u = floor ? media->floor_u : media->cover_u;
  hit->v = floor ? media->floor_v : media->cover_v;
  return hit->primitive != HIT_NONE;
}

// What a path meets at `hit`; see contact_meet().
INLINE Interface media_arrive(const Scene *scene, const PathMedia *media, Ray ray, Hit *hit, Surface *surface,
                              uint *diagnostics) {
  if (media->contact == CONTACT_NONE) return contact_meet(scene, ray, &media->stack, hit, surface, diagnostics);
  Interface interface;
  interface.before = media->stack;
  interface.behind = media->covered;
  interface.crosses = media->contact == CONTACT_COVER;
  interface.floor = false;
  return interface;
}

// Whether a path stands on an opaque surface that a dielectric covers, so that no light comes there straight.
INLINE bool media_covered(const Scene *scene, const PathMedia *media) {
  return nested(scene) && media->contact == CONTACT_FLOOR;
}

// Makes `bsdf` that of the boundary: its index is the ratio of those of the media that meet there. Of dispersive ones one
// channel of `carried` goes on. A boundary within the body that fills both sides is none.
INLINE void media_bsdf(const Scene *scene, const Interface *interface, const Surface *surface, real3 direction,
                       real random, Bsdf *bsdf, real3 *throughput) {
  uint before = medium_stack_top(&interface->before), behind = medium_stack_top(&interface->behind);
  real3 w = (real3)(0, 0, 0);
  real index_before = 1, index_behind = 1, dispersion_before = 0, dispersion_behind = 0;
  if (before != MEDIUM_OUTSIDE) {
    index_before = scene->materials[before].color.w;
    if (HAS(EFFECT_DISPERSION)) dispersion_before = scene->materials[before].absorption.w;
  }
  if (behind != MEDIUM_OUTSIDE) {
    index_behind = scene->materials[behind].color.w;
    if (HAS(EFFECT_DISPERSION)) dispersion_behind = scene->materials[behind].absorption.w;
  }
  if (HAS(EFFECT_DISPERSION) && before != behind && (dispersion_before > 0 || dispersion_behind > 0)) {
    uint channel = choose_channel(random, throughput);
    w = scene->inverse_wavelength2;
    real inverse = channel == 0 ? w.x : channel == 1 ? w.y : w.z;
    index_before += dispersion_before * inverse;
    index_behind += dispersion_behind * inverse;
  }
  bool entering = dot3(surface->geometric_normal, direction) < 0;
  bsdf->ior = entering ? index_behind / index_before : index_before / index_behind;
  if (before == behind) {
    bsdf->ior = 1;
    bsdf->color = (real3)(1, 1, 1);
    bsdf->alpha = 0;
  } else if (HAS(EFFECT_ROUGH)) {
    bsdf->alpha = lobe_alpha(scene->materials[surface->material].alpha, bsdf->ior);
  }
}

// Whether the face of the cover is what a path in the gap comes to along `direction`: not beside an edge of it.
INLINE bool cover_ahead(const Scene *scene, const PathMedia *media, real3 position, real3 direction) {
  if (media->cover == HIT_NONE) return false;
  Ray ray = {position, direction};
  Hit hit = {0, media->cover, media->cover_u, media->cover_v, 0};
  Surface surface;
  geometry_surface(&scene->geometry, ray, hit, &surface);
  return dot3(surface.geometric_normal, direction) < 0;
}

// Takes a path that met `surface` at `hit` along `wi` on in the direction `wo`; returns its origin.
INLINE real3 media_depart(const Scene *scene, const Interface *interface, const Surface *surface, Hit hit,
                          real3 wi, real3 wo, PathMedia *media) {
  real3 g = surface->geometric_normal;
  bool through = dot3(wi, g) * dot3(wo, g) > 0;
  uint from = media->contact;
  media->contact = CONTACT_NONE;
  if (from == CONTACT_FLOOR) {
    if (cover_ahead(scene, media, surface->position, wo)) media->contact = CONTACT_COVER;
  } else if (from == CONTACT_COVER) {
    if (through) media->stack = media->covered;
    else media->contact = media->floor == HIT_NONE ? CONTACT_NONE : CONTACT_FLOOR;
  } else if (!interface->crosses) {
    // An opaque surface, of which the path stays on its side.
  } else if (!through) {
    media->stack = interface->before;
  } else {
    media->stack = interface->behind;
    real3 n = interface->floor_normal;
    if (interface->floor && dot3(wi, n) * dot3(wo, n) > 0) {
      media->contact = CONTACT_FLOOR;
      media->covered = interface->before;
      Hit floor = interface->floor_hit;
      media->floor = floor.primitive, media->floor_u = floor.u, media->floor_v = floor.v;
      media->cover = hit.primitive, media->cover_u = hit.u, media->cover_v = hit.v;
    }
  }
  if (media->contact != CONTACT_NONE) return surface->position;
  return offset_origin(surface->position, surface->error, g, wo);
}

// Where a camera path is: its media and what it meets at its vertex. With the functions below all camera paths do the same
// whether dielectrics are nested or not.
typedef struct {
  PathMedia media;
  Interface interface;  // at the last vertex
  Hit hit;
} Boundary;

// `interior` becomes that of the first segment.
INLINE void boundary_at_camera(const Scene *scene, Boundary *boundary, Ray ray, Interior *interior,
                               volatile global Counters *counters) {
  if (!nested(scene)) return;
  uint diagnostics = 0;
  boundary->media = media_at_camera(scene, ray, &diagnostics);
  *interior = interior_of_stack(scene, &boundary->media.stack);
  count_diagnostics(diagnostics, counters);
}

// `interior` becomes that of the segment that ends here.
INLINE void boundary_arrive(const Scene *scene, Boundary *boundary, Ray ray, Hit *hit, Surface *surface,
                            Interior *interior, volatile global Counters *counters) {
  if (!nested(scene)) return;
  uint diagnostics = 0;
  boundary->interface = media_arrive(scene, &boundary->media, ray, hit, surface, &diagnostics);
  boundary->hit = *hit;
  *interior = interior_of_stack(scene, &boundary->interface.before);
  count_diagnostics(diagnostics, counters);
}

// Completes a Bsdf at glass: by dispersion, and by what lies on the other side.
INLINE void boundary_bsdf(const Scene *scene, const Boundary *boundary, global const Material *material,
                          const Surface *surface, real3 direction, real random, Bsdf *bsdf, real3 *throughput) {
  if (nested(scene)) {
    if (boundary->interface.crosses)
      media_bsdf(scene, &boundary->interface, surface, direction, random, bsdf, throughput);
  } else if (HAS(EFFECT_DISPERSION)) {
    disperse(bsdf, material, scene->inverse_wavelength2, random, throughput);
  }
}

// What light from beyond the boundary comes through, for direct_light_rough().
INLINE Interior boundary_behind(const Scene *scene, const Boundary *boundary) {
  return nested(scene) ? interior_of_stack(scene, &boundary->interface.behind) : interior_none();
}

// The origin of the ray that leaves the vertex in the direction `wo`.
INLINE real3 boundary_depart(const Scene *scene, Boundary *boundary, const Surface *surface, real3 wi,
                             real3 wo) {
  if (!nested(scene)) return offset_origin(surface->position, surface->error, surface->geometric_normal, wo);
  return media_depart(scene, &boundary->interface, surface, boundary->hit, wi, wo, &boundary->media);
}
