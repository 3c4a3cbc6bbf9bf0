// Rays, hits and the surface found at a hit.
#include "faults.cl"
#include "prelude.cl"

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
  uint faults;     // FAULT_* bits of this ray; see faults.cl
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

// The origin of a ray that leaves `position` along `direction`, moved off the surface by the bound of its
// error, along the geometric normal `n`, to the side that the ray goes to, then to the next number outward
// (Pharr, Jakob, Humphreys, PBR section 6.8.6), so that it can neither hit the same surface nor pass one that
// is farther away than the error.
INLINE real3 offset_origin(real3 position, real error, real3 n, real3 direction) {
  real distance = error * (fabs(n.x) + fabs(n.y) + fabs(n.z));
  real3 offset = dot(direction, n) < 0 ? -distance * n : distance * n;
  real3 origin = position + offset;
  if (offset.x != 0) origin.x = nextafter(origin.x, offset.x > 0 ? (real)INFINITY : -(real)INFINITY);
  if (offset.y != 0) origin.y = nextafter(origin.y, offset.y > 0 ? (real)INFINITY : -(real)INFINITY);
  if (offset.z != 0) origin.z = nextafter(origin.z, offset.z > 0 ? (real)INFINITY : -(real)INFINITY);
  return origin;
}
