// Photons aimed at what focuses them. A photon leaves its emitter in a direction, or from a place on the disc before
// the scene, by two numbers: a point of the unit square. Before the first pass pilot paths tell into which cells of that
// square those fall that become caustics, and from then on photons are drawn from these more often, with so much less
// flux each. A caustic is then made of more photons, and all else of somewhat fewer, in expectation of the same light. It
// is the projection map of Jensen ("Realistic Image Synthesis Using Photon Mapping", 2001, section 5.3), learned from
// photons as by Peter & Pietrek ("Importance Driven Construction of Photon Maps", EGWR 1998): no matter what the scene is
// made of.
#include "core/prelude.cl"
#include "shared/types.h"

// What photons of the projection map read and write beside the map: PROJECTION_CELLS for each square, and how many pilot paths of each cell landed as
// parts of caustics.
typedef struct {
  global const ProjectionCell *cells;
  volatile global uint *deposited;
} Aim;

// The first cell of an emitter's square.
INLINE uint projection_square(uint emitter, uint emitters) {
  uint squares = min(emitters, PROJECTION_SQUARES);
  return min((uint)(emitter * (squares / (float)emitters)), squares - 1) * PROJECTION_CELLS;
}

// The cell of a square that (u, v) lies in.
INLINE uint projection_cell(real u, real v) { return (uint)(v * PROJECTION_SIDE) * PROJECTION_SIDE + (uint)(u * PROJECTION_SIDE); }

// Moves (*u, *v), uniform numbers, to where in the square that begins with cell `square` a photon leaves by: their place
// within the cell stays, and the third number draws the cell. Returns the weight of its flux.
INLINE real aim(global const ProjectionCell *cells, uint square, real third, real *u, real *v) {
  real across = *u * PROJECTION_SIDE, up = *v * PROJECTION_SIDE;
  uint column = (uint)across, row = (uint)up, cell = row * PROJECTION_SIDE + column;
  uint chosen = third < cells[square + cell].stay ? cell : cells[square + cell].other;
  *u = (chosen % PROJECTION_SIDE + (across - column)) / PROJECTION_SIDE;
  *v = (chosen / PROJECTION_SIDE + (up - row)) / PROJECTION_SIDE;
  return cells[square + chosen].weight;
}
