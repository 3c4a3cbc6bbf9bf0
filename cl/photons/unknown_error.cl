// Pixels whose error cannot be told. One that never found a photon has estimates that agree with each other, whatever is
// missing from all of them. Where photons are stored around what it sees, their light is known to be missing: the space
// that the camera sees is cut into coarse cells that add up the flux stored in each, by the axis that its surface faces.
#include "photons/grid.cl"
#include "film/film.cl"

// Flux is added up in units of so many of a photon's record, so that sums of 2^32 hold what a pass can store.
#define FLUX_SUM_SHIFT 6u

// The sums of a cell: one of each way along an axis that a surface may face, and one of the medium.
#define FACINGS 7u
#define NO_CELL 0xffffffffu

// The place of a point's sum, or NO_CELL outside of the cells: these do not wrap around.
INLINE uint flux_cell(Grid cells, uint normal, real3 p) {
  real3 place = (p - convert_real3(cells.origin.xyz)) * (real)cells.origin.w;
  if (!(place.x >= 0 && place.y >= 0 && place.z >= 0 && place.x < cells.nx && place.y < cells.ny && place.z < cells.nz))
    return NO_CELL;
  float3 n = normal_unpack(normal);
  float x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
  uint axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  float along = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  uint facing = (normal & IN_MEDIUM) ? 6u : 2 * axis + (along < 0 ? 1 : 0);
  return FACINGS * (((uint)place.z * cells.ny + (uint)place.y) * cells.nx + (uint)place.x) + facing;
}

// Adds the flux of each photon, of its largest channel, to the sum of its cell.
kernel void add_flux(global const Photon *photons, volatile global uint *sums, Grid cells, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Photon photon = photons[i];
  uint cell = flux_cell(cells, photon.normal, vload3(0, photon.position));
  if (cell == NO_CELL) return;
  uint flux = max(max(photon.flux_rg & 0xffffu, photon.flux_rg >> 16), photon.flux_b & 0xffffu);
  atomic_add(sums + cell, (flux >> FLUX_SUM_SHIFT) + 1u);
}

// Tells each pixel of the chunk that has not found any photon so far how much light those around may bring.
kernel void find_unknown(global const VisiblePoint *points, global FilmPixel *film, global const uint *sums, Grid cells,
                         Params params) {
  uint i = get_global_id(0);
  if (i >= params.pixel_count) return;
  global FilmPixel *pixel = film + params.first_pixel + i;
  if (pixel->missed < 0) return;
  real light = 0, scale = params.photon_flux / PHOTON_FLUX_UNIT * (1u << FLUX_SUM_SHIFT) * cells.origin.w * cells.origin.w;
  for (uint s = 0; s < params.visible_points; ++s) {
    VisiblePoint point = points[i * params.visible_points + s];
    uint cell = flux_cell(cells, point.normal, vload3(0, point.position));
    if (cell == NO_CELL || !(point.weight[0] + point.weight[1] + point.weight[2] > 0)) continue;
    light += luminance(point.weight[0], point.weight[1], point.weight[2]) * sums[cell] * scale / params.visible_points;
  }
  pixel->missed = (float)light;
}
