// Walls: the surfaces that may stand between a visible point and a photon near it. Part of types.h.
#pragma once

#define WALL_TRIANGLE 0u
#define WALL_PLANE 1u
#define WALL_DISK 2u
#define WALL_SPHERE 3u
#define WALL_PARALLELOGRAM 4u

#define WALL_GROUP 16u

typedef struct {
  float4 origin;   // triangle: a corner; plane: a point of it; else the centre; w: WALL_*
  float4 normal;   // unit; w: the radius of a disk or sphere
  // Triangle: the unit vector in its plane from each edge inward; w: that edge's distance from `origin`. Parallelogram: in
  // the first two the unit vectors in its plane across its two pairs of edges; w: their distance from `origin`.
  float4 edge[3];
} Wall;
CHECK_SIZE(Wall, 80);

// A grid of cells over all that is bounded, each with a list of the walls that matter to visible points within it: see
// walls.cl. In its buffer follow the first entry of each cell's list and the end of the last, the entries, and the walls.
// A list that is not empty begins with two numbers. The first is that of its walls that part something, which come next.
// The second is the place of the boxes around groups of WALL_GROUP of these, in units of 16 bytes, or 0 where they are few:
// for each group the low and the high corner.
// Cell 0 is all space outside the grid, cell 1 + (k * ny + j) * nx + i the cell (i, j, k).
typedef struct {
  float4 origin;    // the low corner of the cell (0, 0, 0); w: 1 / edge of a cell
  uint nx, ny, nz;  // cells along each axis
  uint first_wall;  // the place of the first wall in the buffer, in units of 16 bytes; 0 where there is none at all
} WallGrid;
CHECK_SIZE(WallGrid, 32);
