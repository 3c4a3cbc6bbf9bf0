// Rays, hits and the surface found at a hit.
#include "core/diagnostics.cl"
#include "core/prelude.cl"
#include "core/vector.cl"

// The ray origin + t direction for 0 < t < t_max; direction is of unit length.
typedef struct {
  real3 origin;
  real3 direction;
} Ray;

// The nearest intersection so far. `t` starts as the ray's t_max (INFINITY for none).
typedef struct {
  real t;
  uint primitive;  // HIT_NONE; HIT_SHAPE | index into shapes; else a triangle reference
  real u, v;       // triangle: barycentric weights of vertices 1 and 2; bezier: see bezier.cl; else unused
  uint diagnostics;     // DIAGNOSTIC_* bits of this ray; see diagnostics.cl
} Hit;

#define HIT_NONE 0xffffffffu
#define HIT_SHAPE 0x80000000u

// Nothing yet, and nothing beyond t_max.
INLINE Hit hit_none(real t_max) {
  Hit hit = {t_max, HIT_NONE, 0, 0, 0};
  return hit;
}

// Geometry at a hit. Both normals have unit length; `geometric_normal` points outward (sphere, box, bezier),
// to local +z (rectangle, disk, plane) or by counter-clockwise winding (mesh). `shading_normal` is on the
// same side of the surface as `geometric_normal`.
typedef struct {
  real3 position;
  real3 geometric_normal;
  real3 shading_normal;
  real2 uv;
  real error;  // bound of |position - the exact surface point|, per component
  uint material;
} Surface;

// A surface by components.
typedef struct {
  real position[3], geometric_normal[3], shading_normal[3], uv[2], error;
  uint material;
} SurfaceParts;

INLINE void surface_unpack(const Surface *surface, SurfaceParts *parts) {
  real3 p = surface->position, g = surface->geometric_normal, s = surface->shading_normal;
  parts->position[0] = p.x, parts->position[1] = p.y, parts->position[2] = p.z;
  parts->geometric_normal[0] = g.x, parts->geometric_normal[1] = g.y, parts->geometric_normal[2] = g.z;
  parts->shading_normal[0] = s.x, parts->shading_normal[1] = s.y, parts->shading_normal[2] = s.z;
  parts->uv[0] = surface->uv.x, parts->uv[1] = surface->uv.y;
  parts->error = surface->error, parts->material = surface->material;
}

// Puts all but the material of `own` into `parts`, if it is chosen. No loop over components: PoCL's compiler would not
// vectorise one around it.
INLINE void surface_choose(bool chosen, const SurfaceParts *own, SurfaceParts *parts) {
  parts->position[0] = chosen ? own->position[0] : parts->position[0];
  parts->position[1] = chosen ? own->position[1] : parts->position[1];
  parts->position[2] = chosen ? own->position[2] : parts->position[2];
  parts->geometric_normal[0] = chosen ? own->geometric_normal[0] : parts->geometric_normal[0];
  parts->geometric_normal[1] = chosen ? own->geometric_normal[1] : parts->geometric_normal[1];
  parts->geometric_normal[2] = chosen ? own->geometric_normal[2] : parts->geometric_normal[2];
  parts->shading_normal[0] = chosen ? own->shading_normal[0] : parts->shading_normal[0];
  parts->shading_normal[1] = chosen ? own->shading_normal[1] : parts->shading_normal[1];
  parts->shading_normal[2] = chosen ? own->shading_normal[2] : parts->shading_normal[2];
  parts->uv[0] = chosen ? own->uv[0] : parts->uv[0];
  parts->uv[1] = chosen ? own->uv[1] : parts->uv[1];
  parts->error = chosen ? own->error : parts->error;
}

INLINE void surface_pack(const SurfaceParts *parts, Surface *surface) {
  surface->position = (real3)(parts->position[0], parts->position[1], parts->position[2]);
  surface->geometric_normal =
      (real3)(parts->geometric_normal[0], parts->geometric_normal[1], parts->geometric_normal[2]);
  surface->shading_normal = (real3)(parts->shading_normal[0], parts->shading_normal[1], parts->shading_normal[2]);
  surface->uv = (real2)(parts->uv[0], parts->uv[1]);
  surface->error = parts->error, surface->material = parts->material;
}

// The origin of a ray that leaves `position` along `direction`, moved off the surface by the bound of its
// error, along the geometric normal `n`, to the side that the ray goes to, then to the next number outward
// (Pharr, Jakob, Humphreys, PBR section 6.8.6), so that it can neither hit the same surface nor pass one that
// is farther away than the error.
INLINE real3 offset_origin(real3 position, real error, real3 n, real3 direction) {
  real distance = error * (fabs(n.x) + fabs(n.y) + fabs(n.z));
  real3 offset = scaled3(dot3(direction, n) < 0 ? -distance : distance, n);
  real3 origin = add3(position, offset);
  return (real3)(next_beyond(origin.x, offset.x), next_beyond(origin.y, offset.y), next_beyond(origin.z, offset.z));
}
