// Where the camera sees: cells of space that hold visible points, and which way the surfaces there face, so that of a thin
// wall one side may be marked and the other not. One byte for each bucket of a grid, a bit for each way along an axis.
#include "photons/grid.cl"

// The bit of the axis that a unit normal is closest to.
INLINE uint facing_bit(float3 n) {
  float x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
  uint axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  float along = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  return 1u << (2 * axis + (along < 0 ? 1 : 0));
}

// The bits of all normals that a visible point of normal `n` gathers photons of: those within 60 degrees, by
// GATHER_NORMAL_COSINE, are within 55 of their axis, and cos 115 degrees is -0.42.
INLINE uint gathered_facings(float3 n) {
  const float least = -0.43f;
  return (n.x > least ? 1u : 0u) | (n.x < -least ? 2u : 0u) | (n.y > least ? 4u : 0u) | (n.y < -least ? 8u : 0u) |
         (n.z > least ? 16u : 0u) | (n.z < -least ? 32u : 0u);
}

// Marks the cells that a box of `reach` to each side of a visible point touches. With `reach` at most half a cell these
// are eight at most.
INLINE void mark_visible_facing(volatile global uint *visibility, Grid cells, uint facings, real3 position, real reach) {
  for (uint corner = 0; corner < 8; ++corner) {
    real3 side = (real3)(corner & 1u ? 1 : -1, corner & 2u ? 1 : -1, corner & 4u ? 1 : -1);
    uint bucket = grid_bucket(cells, position + reach * side);
    atomic_or(visibility + bucket / 4, facings << (8 * (bucket % 4)));
  }
}

// The same for the facings of all photons that a visible point of that normal gathers.
INLINE void mark_visible_cells(volatile global uint *visibility, Grid cells, float3 normal, real3 position, real reach) {
  mark_visible_facing(visibility, cells, gathered_facings(normal), position, reach);
}

// Whether a point lies in the grid as it is, before its cells wrap around: where space has no end, what is far off would
// else pass for what is in view.
INLINE bool lies_in_grid(Grid cells, real3 position) {
  real3 place = (position - convert_real3(cells.origin.xyz)) * (real)cells.origin.w;
  return place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x < cells.nx && place.y < cells.ny && place.z < cells.nz;
}

// Whether visible points have been seen around a photon that landed there on a surface of that normal. An estimate is all
// that is asked for: within their radius, points may find photons of cells that are not marked.
INLINE bool is_visible(global const uint *visibility, Grid cells, float3 normal, real3 position) {
  uint bucket = grid_bucket(cells, position);
  return (visibility[bucket / 4] >> (8 * (bucket % 4)) & facing_bit(normal)) != 0;
}
