// Surfaces that lie at one place: faces that two bodies share, a glass that stands on a table.
//
// A ray is moved past all of them when it leaves, and which of them a search finds first is chance. So where a path meets
// a dielectric, or is in one, all surfaces within the rounding errors of the hit are found, and what the path meets there
// follows from all of them together:
//   faces of dielectrics alone are one boundary, between the medium before all of them and the one behind;
//   an opaque surface lies behind the faces of the bodies that the path leaves there, at the end of a gap of no width, and
//   before the faces of bodies that it would enter.
// So the picture does not depend on the order of objects, liquids wet the glass that they touch, and glass that stands on
// something opaque keeps its face and its total reflection, as in the limit of a gap that vanishes.
#include "traversal/hit_list.cl"
#include "media/medium_stack.cl"
#include "scene/scene.cl"

// What a path meets at one place.
typedef struct {
  MediumStack before, behind;  // the media on the side that it comes from, and beyond the boundary
  bool crosses;    // it meets the boundary of a dielectric
  bool floor;      // behind that an opaque surface lies in contact, where `floor_hit` is
  Hit floor_hit;
  real3 floor_normal;  // geometric
} Interface;

INLINE bool is_dielectric(const Scene *scene, const Surface *surface) {
  global const Material *material = scene->materials + surface->material;
  if (!bounds_body(material->kind)) return false;
  if (!HAS(EFFECT_TEXTURES) || !(material->flags & MATERIAL_ALPHA_DIFFUSE)) return true;
  return bounds_body(bsdf_at(material, scene->textures, scene->texels, surface->uv).kind);
}

// The bound of a surface's error along a normal.
INLINE real error_along(real error, real3 n) { return error * (fabs(n.x) + fabs(n.y) + fabs(n.z)); }

// The ray along `direction` through a little before `position` to as far behind, which is where *t_max ends. At grazing
// incidence surfaces that are apart by their errors are met far from each other; below a cosine of 0.02 not all are found.
INLINE Ray contact_ray(real3 position, real3 direction, real3 n, real error, real *t_max) {
  real reach = 8 * error_along(error, n) / fmax(fabs(dot3(direction, n)), (real)0.02f);
  Ray ray = {ray_at(position, -reach, direction), direction};
  *t_max = 2 * reach;
  return ray;
}

// The dielectrics whose faces lie at one place, and how a path in one direction crosses them.
typedef struct {
  uint count;
  uint material[HIT_LIST_CAPACITY];
  uint crossing[HIT_LIST_CAPACITY];  // CROSSING_* bits
  Hit hit[HIT_LIST_CAPACITY];        // of one of its faces
} ContactFaces;

#define CROSSING_ENTERS 1u
#define CROSSING_LEAVES 2u

INLINE void contact_add(ContactFaces *faces, uint material, uint crossing, Hit hit) {
  uint i = 0;
  while (i < faces->count && faces->material[i] != material) ++i;
  if (i == HIT_LIST_CAPACITY) return;
  if (i == faces->count) {
    faces->material[i] = material;
    faces->crossing[i] = 0;
    faces->hit[i] = hit;
    ++faces->count;
  }
  faces->crossing[i] |= crossing;
}

INLINE uint crossing_of(real3 geometric_normal, real3 direction) {
  return dot3(geometric_normal, direction) < 0 ? CROSSING_ENTERS : CROSSING_LEAVES;
}

// Finds the faces of dielectrics in contact with the surface that `ray` has met at `hit`, that one included, and the
// opaque surface there, if any. Widens surface->error, so that a ray that leaves it clears them all.
OUTLINE void contact_find(const Scene *scene, Ray ray, Hit hit, Surface *surface, ContactFaces *faces,
                          Interface *interface) {
  real3 n = surface->geometric_normal;
  real own = error_along(surface->error, n), farthest = 0, t_max;
  Ray probe = contact_ray(surface->position, ray.direction, n, surface->error, &t_max);
  HitFilter filter = {scene->materials, false};
  HitList list;
  list.count = 0;
  real3 p = surface->position, low = scene->contact_low, high = scene->contact_high;
  bool near = p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
  if (near) geometry_hits(&scene->geometry, probe, t_max, &filter, &list);
  faces->count = 0;
  interface->floor = !is_dielectric(scene, surface);
  interface->floor_hit = hit;
  interface->floor_normal = n;
  if (!interface->floor) contact_add(faces, surface->material, crossing_of(n, ray.direction), hit);
  for (uint i = 0; i < list.count; ++i) {
    Surface other;
    geometry_surface(&scene->geometry, probe, list.hit[i], &other);
    real apart = fabs(dot3(n, sub3(other.position, surface->position)));
    real error = error_along(other.error, other.geometric_normal);
    // A ray that leaves either may pass the other by where they are so near: both places are known to their errors, and
    // the ray is moved off by one of them.
    if (!(apart <= 2 * (own + error))) continue;
    farthest = fmax(farthest, apart + error);
    if (is_dielectric(scene, &other)) {
      contact_add(faces, other.material, crossing_of(other.geometric_normal, ray.direction), list.hit[i]);
    } else if (!interface->floor) {
      interface->floor = true;
      interface->floor_hit = list.hit[i];
      interface->floor_normal = other.geometric_normal;
    }
  }
  surface->error *= 1 + farthest / fmax(own, (real)FLT_MIN);
}

// The medium behind the faces of `faces`, of which those that the path enters count only without a floor. A body that is
// left without having been entered held the path all along: its surface is open.
INLINE bool contact_media(const ContactFaces *faces, Interface *interface, uint *diagnostics) {
  bool crosses = false;
  for (uint i = 0; i < faces->count; ++i)
    if (faces->crossing[i] == CROSSING_LEAVES && !medium_stack_holds(&interface->before, faces->material[i])) {
      *diagnostics |= DIAGNOSTIC_MEDIA_LEFT;
      medium_stack_enter(&interface->before, faces->material[i], diagnostics);
    }
  interface->behind = interface->before;
  for (uint i = 0; i < faces->count; ++i) {
    if (faces->crossing[i] == CROSSING_LEAVES) {
      crosses = true;
      medium_stack_leave(&interface->behind, faces->material[i]);
    } else if (!interface->floor) {
      crosses = true;
      if (faces->crossing[i] == CROSSING_ENTERS) medium_stack_enter(&interface->behind, faces->material[i], diagnostics);
    }
  }
  return crosses;
}

// The body whose face it is, of those that fill the place on either side: the one that would fill both.
INLINE uint boundary_material(const Interface *interface) {
  uint before = medium_stack_top(&interface->before), behind = medium_stack_top(&interface->behind);
  return before == MEDIUM_OUTSIDE ? behind : behind == MEDIUM_OUTSIDE ? before : max(before, behind);
}

// What a path in the media `before` meets where `ray` has met `surface` at `hit`: takes the face of the boundary in their
// place, or the opaque surface.
INLINE Interface contact_meet(const Scene *scene, Ray ray, const MediumStack *before, Hit *hit, Surface *surface,
                              uint *diagnostics) {
  Interface interface;
  interface.before = interface.behind = *before;
  interface.crosses = interface.floor = false;
  if (before->count == 0 && !is_dielectric(scene, surface)) return interface;
  ContactFaces faces;
  contact_find(scene, ray, *hit, surface, &faces, &interface);
  interface.crosses = contact_media(&faces, &interface, diagnostics);
  real error = surface->error;
  Hit first = *hit;
  if (interface.crosses) {
    bool dielectric = is_dielectric(scene, surface);
    uint material = boundary_material(&interface);
    if (!dielectric) first = faces.hit[0];
    for (uint i = 0; i < faces.count; ++i)
      if (faces.material[i] == material && !(dielectric && surface->material == material)) first = faces.hit[i];
  } else if (interface.floor) {
    first = interface.floor_hit;
    interface.floor = false;
  }
  if (first.primitive != hit->primitive) {
    real t = hit->t;
    Ray at = {surface->position, ray.direction};
    first.t = 0;
    geometry_surface(&scene->geometry, at, first, surface);
    surface->error = fmax(surface->error, error);
    *hit = first;
    hit->t = t;
  }
  return interface;
}
