// The photon grid: which bucket a point belongs to. See Grid in photon_records.h.
#include "core/prelude.cl"
#include "shared/types.h"

// The cube that holds coordinate x along one axis, before it becomes an int; of vectors that of each component. Both the
// sort and the gather take this, and it must round alike in both: hence no contraction, and one expression. Beyond what
// fits an int all is one cube: 128 is the distance between floats there.
#define GRID_COORDINATE(x, origin, inverse_cell) \
  floor(clamp(((x) - (origin)) * (inverse_cell), (real)-2147483648.0f, (real)(2147483648.0f - 128)))

INLINE int grid_coordinate(real x, float origin, float inverse_cell) {
  return (int)GRID_COORDINATE(x, origin, inverse_cell);
}

// x modulo n in [0, n) for any int x and n a power of two.
INLINE uint grid_wrap(int x, uint n) { return (uint)x & (n - 1); }

INLINE uint grid_bucket(Grid grid, real3 p) {
  uint i = grid_wrap(grid_coordinate(p.x, grid.origin.x, grid.origin.w), grid.nx);
  uint j = grid_wrap(grid_coordinate(p.y, grid.origin.y, grid.origin.w), grid.ny);
  uint k = grid_wrap(grid_coordinate(p.z, grid.origin.z, grid.origin.w), grid.nz);
  return grid.first_bucket + (k * grid.ny + j) * grid.nx + i;
}

// The bucket of a photon at p with that word of marks and normal.
INLINE uint photon_bucket(PhotonGrids grids, real3 p, uint normal) {
  if (grids.separate && (normal & INDIRECT_PHOTON)) return grid_bucket(grids.grid[INDIRECT_PHOTONS], p);
  return grid_bucket(grids.grid[FOCUSED_PHOTONS], p);
}

// Photons whose surface leans away by more than this cosine lie on another wall.
#define GATHER_NORMAL_COSINE 0.5f

// A unit normal in 24 bits, eight a component. Coarse, and enough to tell the sides of a surface and the
// walls of a corner apart, which is all that it is compared for.
INLINE uint normal_pack(real3 n) {
  int x = (int)rint((float)n.x * 127.0f), y = (int)rint((float)n.y * 127.0f), z = (int)rint((float)n.z * 127.0f);
  return ((uint)x & 0xffu) | ((uint)y & 0xffu) << 8 | ((uint)z & 0xffu) << 16;
}
INLINE float3 normal_unpack(uint packed) {
  int3 q = (int3)((int)(packed << 24) >> 24, (int)(packed << 16) >> 24, (int)(packed << 8) >> 24);
  return convert_float3(q) * (1.0f / 127.0f);
}

// A unit direction in 30 bits, by the octahedron (Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014), under the mark IN_MEDIUM.
INLINE uint direction_pack(real3 d) {
  real2 p = d.xy / (fabs(d.x) + fabs(d.y) + fabs(d.z));
  if (d.z < 0) p = (1 - fabs(p.yx)) * (real2)(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
  uint2 q = convert_uint2_sat_rte((p + 1) * (real)16383.5);
  return IN_MEDIUM | min(q.x, 32767u) | min(q.y, 32767u) << 15;
}
INLINE real3 direction_unpack(uint packed) {
  real2 p = (real2)(packed & 32767u, packed >> 15 & 32767u) / (real)16383.5 - 1;
  real z = 1 - fabs(p.x) - fabs(p.y);
  if (z < 0) p = (1 - fabs(p.yx)) * (real2)(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
  return normalize((real3)(p.x, p.y, z));
}

// The same in 14 bits, dithered so that the mean of what a smooth function makes of it keeps its value.
INLINE uint direction_pack_dithered(real3 d, real2 dither) {
  real2 p = d.xy / (fabs(d.x) + fabs(d.y) + fabs(d.z));
  if (d.z < 0) p = (1 - fabs(p.yx)) * (real2)(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
  uint2 q = convert_uint2_sat_rtz((p + 1) * (real)63.5 + dither);
  return min(q.x, 127u) | min(q.y, 127u) << 7;
}
INLINE real3 direction_unpack_dithered(uint packed) {
  real2 p = (real2)(packed & 127u, packed >> 7 & 127u) / (real)63.5 - 1;
  real z = 1 - fabs(p.x) - fabs(p.y);
  if (z < 0) p = (1 - fabs(p.yx)) * (real2)(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
  return normalize((real3)(p.x, p.y, z));
}
