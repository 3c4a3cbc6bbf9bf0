// Rays and their hits by component: the lists of components.cl that states of many rays share, and arrays that belong to
// such a state.
#include "core/components.cl"
#include "shapes/ray.cl"

// Of a Ray.
#define RAY_COMPONENTS(ROW, x) \
  ROW(x, VECTOR, real, origin, origin, ALWAYS) \
  ROW(x, VECTOR, real, direction, direction, ALWAYS)

// Of a Hit, but for its diagnostics.
#define HIT_COMPONENTS(ROW, x) \
  ROW(x, SCALAR, real, t, t, ALWAYS) \
  ROW(x, SCALAR, real, u, u, ALWAYS) \
  ROW(x, SCALAR, real, v, v, ALWAYS) \
  ROW(x, SCALAR, uint, primitive, primitive, ALWAYS)

// Rays, and up to where they are traced or what they have met so far, as Hit has it.
typedef struct {
  const real *origin[3], *direction[3];
  real *t, *u, *v;
  uint *primitive;
} RayArrays;

// Those of a state.
#define RAY_ARRAYS(state) \
  {{(state)->origin[0], (state)->origin[1], (state)->origin[2]}, \
   {(state)->direction[0], (state)->direction[1], (state)->direction[2]}, \
   (state)->t, (state)->u, (state)->v, (state)->primitive}

INLINE Ray arrays_ray(const RayArrays *state, uint i) {
  Ray ray;
  RAY_COMPONENTS(LOAD_ENTRY, ray)
  return ray;
}

INLINE Hit arrays_hit(const RayArrays *state, uint i) {
  Hit hit;
  HIT_COMPONENTS(LOAD_ENTRY, hit)
  hit.diagnostics = 0;
  return hit;
}

INLINE void arrays_put_hit(const RayArrays *state, uint i, Hit hit) { HIT_COMPONENTS(STORE_ENTRY, hit) }
