// Photons that start where the useful ones do. How a photon starts is decided by a few random numbers: a point of the unit
// cube. Where few photons land near what the camera sees, as from an emitter whose light comes through a gap,
// or of which a part alone shines into the room, the useful ones start in a small part of that cube. Before
// the first pass pilot paths tell which: the cube is cut into cells, the host says how likely each is, and
// flux is divided by the density, so that the picture keeps its expectation. It is importance sampling in the
// space of random numbers (as Guo et al., "Primary Sample Space Path Guiding", EGSR 2018), of emission alone,
// so that no kind of light needs a map of its own.
#include "core/prelude.cl"
#include "shared/types.h"

// The cell that owns random number `u` in [0, 1).
INLINE uint emission_cell(global const EmissionCell *cells, uint count, real u) {
  uint number = (uint)(u * EMISSION_NUMBERS), low = 0, high = count - 1;
  while (low < high) {
    uint middle = (low + high) / 2;
    if (number < cells[middle].end)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

// Coordinate `axis` of the point of a cell that uniform number x stands for. Below the cell's end after rounding too.
INLINE real emission_number(global const EmissionCell *cell, uint axis, real x) {
  real low = cell->low[axis], size = cell->size[axis];
  return fmin(low + size * x, (low + size) * (real)0.99999994f);
}

// The same of all numbers: `choice` of DIM_EMITTER, (*u, *v) of DIM_EMISSION.
INLINE real4 emission_numbers(global const EmissionCell *cell, real4 choice, real *u, real *v) {
  *u = emission_number(cell, 3, *u);
  *v = emission_number(cell, 4, *v);
  return (real4)(emission_number(cell, 0, choice.x), emission_number(cell, 1, choice.y), emission_number(cell, 2, choice.z),
                 choice.w);
}
