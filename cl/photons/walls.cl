// Whether a wall stands between a visible point and a photon. A photon counts for a visible point only where a short path
// through free space leads from one to the other, so that light does not leak through walls, floors and ceilings that are
// thinner than the search radius. Two paths are tried:
// - the straight line between the two, which suffices on flat and on hollow surfaces;
// - up along the normal of the one, across, and down along the normal of the other, which passes over a surface that
//   bulges between the two.
// The correction of the kernel's area (kernel_area.cl) asks the same, so that area behind a wall is not divided by.
#include "core/prelude.cl"
#include "shared/types.h"

// Heights of the two paths, over the distance between their ends. Two points of a sphere whose normals are 60 degrees apart
// see each other from 0.155, facets of such an angle from 0.34.
#define WALL_STRAIGHT_HEIGHT 0.01f
#define WALL_OVER_HEIGHT 0.35f

// What counts as lying in a wall: this part of the distance between the ends, and of the coordinates, whose rounding it
// bounds. It is less than the heights above, so that no surface is a wall to its own points.
#define WALL_SLACK 1e-4f
#define WALL_ROUNDING 1e-6f

// Walls, or groups of them, beyond so many are not told apart by their distance.
#define WALLS_NEAR 48u

// The walls near a visible point.
typedef struct {
  real3 point, normal;  // of the visible point; the normal on its side
  real rounding;        // of coordinates there
  global const Wall *walls;
  global const uint *listed;  // those of its cell, first those that part something
  uint parting, listed_count;
  global const float4 *boxes;  // two corners for each group of WALL_GROUP parting walls; 0 where they are few
  // Of the parting walls, or of their groups where there are boxes: how many of `near` count, or with `all` all.
  uint count;
  bool all;
  uint near[WALLS_NEAR];
} NearWalls;

// The cell of a point.
INLINE uint wall_cell(global const WallGrid *grid, real3 p) {
  float4 origin = grid->origin;
  real3 q = (p - convert_real3(origin.xyz)) * (real)origin.w;
  uint nx = grid->nx, ny = grid->ny, nz = grid->nz;
  if (!(q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < nx && q.y < ny && q.z < nz)) return 0;
  return 1 + ((uint)q.z * ny + (uint)q.y) * nx + (uint)q.x;
}

// How far a wall is from a point at least, less than it where that is not worth the time.
INLINE real wall_distance(global const Wall *wall, real3 p) {
  real3 from = p - convert_real3(wall->origin.xyz);
  uint type = (uint)wall->origin.w;
  if (type == WALL_SPHERE) return fabs(length(from) - wall->normal.w);
  real distance = fabs(dot(from, convert_real3(wall->normal.xyz)));
  if (type == WALL_TRIANGLE)
    for (uint i = 0; i < 3; ++i)
      distance = fmax(distance, wall->edge[i].w - dot(from, convert_real3(wall->edge[i].xyz)));
  if (type == WALL_PARALLELOGRAM)
    for (uint i = 0; i < 2; ++i)
      distance = fmax(distance, fabs(dot(from, convert_real3(wall->edge[i].xyz))) - wall->edge[i].w);
  return distance;
}

// Whether the box has a point between the two corners.
INLINE bool box_meets(global const float4 *box, real3 low, real3 high) {
  return all(convert_real3(box[0].xyz) <= high) && all(convert_real3(box[1].xyz) >= low);
}

// Takes all walls that the cell of a visible point lists, for paths to points within `radius` of it. False if there are
// none. Enough where few points are asked about: telling which walls are near takes longer.
INLINE bool walls_listed(global const WallGrid *grid, real3 point, real3 normal, real radius, NearWalls *near) {
  if (!grid || grid->first_wall == 0) return false;
  global const uint *starts = (global const uint *)(grid + 1);
  uint cells = 1 + grid->nx * grid->ny * grid->nz, cell = wall_cell(grid, point);
  uint begin = starts[cell], end = starts[cell + 1];
  if (begin == end) return false;
  near->point = point;
  near->normal = normal;
  near->rounding = (real)WALL_ROUNDING * (max(fabs(point.x), max(fabs(point.y), fabs(point.z))) + radius);
  near->walls = (global const Wall *)((global const float4 *)grid + grid->first_wall);
  near->listed = starts + cells + 1 + begin + 2;
  near->listed_count = end - begin - 2;
  near->parting = near->listed[-2];
  uint boxes = near->listed[-1];
  near->boxes = boxes ? (global const float4 *)grid + boxes : 0;
  near->count = boxes ? (near->parting + WALL_GROUP - 1) / WALL_GROUP : near->parting;
  near->all = true;
  return true;
}

// Finds the walls within `radius` of a visible point. False if there are none.
INLINE bool walls_near(global const WallGrid *grid, real3 point, real3 normal, real radius, NearWalls *near) {
  if (!walls_listed(grid, point, normal, radius, near)) return false;
  uint all = near->count;
  near->count = 0;
  near->all = false;
  real reach = radius * (real)(1 + WALL_OVER_HEIGHT + WALL_SLACK) + 8 * near->rounding;
  for (uint i = 0; i < all; ++i) {
    if (near->boxes ? !box_meets(near->boxes + 2 * i, point - reach, point + reach)
                    : !(wall_distance(near->walls + near->listed[i], point) <= reach))
      continue;
    if (near->count == WALLS_NEAR) {
      near->all = true;
      near->count = all;
      break;
    }
    near->near[near->count++] = i;
  }
  return near->count > 0;
}

// Whether the way from `a` to `b` crosses the wall, or ends at it within `slack`.
INLINE bool wall_crossed(global const Wall *wall, real3 a, real3 b, real slack) {
  real3 origin = convert_real3(wall->origin.xyz), from = a - origin, to = b - origin;
  uint type = (uint)wall->origin.w;
  if (type == WALL_SPHERE) {
    real radius = wall->normal.w, outside = length(from) - radius, end = length(to) - radius;
    if (outside < 0) return end > -slack;
    if (end < slack) return true;
    real3 way = to - from;
    real nearest = clamp(-dot(from, way) / fmax(dot(way, way), (real)FLT_MIN), (real)0, (real)1);
    return length(from + nearest * way) < radius;
  }
  real3 n = convert_real3(wall->normal.xyz);
  real before = dot(n, from), after = dot(n, to);
  after = before < 0 ? -after : after;
  before = fabs(before);
  if (after >= slack) return false;
  if (type == WALL_PLANE) return true;
  real fraction = clamp(before / fmax(before - after, (real)FLT_MIN), (real)0, (real)1);
  real3 p = from + fraction * (to - from);
  if (type == WALL_DISK) return length(p) <= wall->normal.w + slack;
  bool inside = true;
  if (type == WALL_PARALLELOGRAM) {
    for (uint i = 0; i < 2; ++i) inside = inside && fabs(dot(convert_real3(wall->edge[i].xyz), p)) <= wall->edge[i].w + slack;
    return inside;
  }
  for (uint i = 0; i < 3; ++i) inside = inside && dot(convert_real3(wall->edge[i].xyz), p) >= wall->edge[i].w - slack;
  return inside;
}

// Whether the way crosses none of the walls that part something.
INLINE bool parting_walls_leave_free(const NearWalls *near, real3 a, real3 b, real slack) {
  real3 low = fmin(a, b) - 2 * slack, high = fmax(a, b) + 2 * slack;
  for (uint i = 0; i < near->count; ++i) {
    uint begin = near->all ? i : near->near[i], end = begin + 1;
    if (near->boxes) {
      if (!box_meets(near->boxes + 2 * begin, low, high)) continue;
      begin *= WALL_GROUP;
      end = min(begin + WALL_GROUP, near->parting);
    }
    for (uint k = begin; k < end; ++k)
      if (wall_crossed(near->walls + near->listed[k], a, b, slack)) return false;
  }
  return true;
}

// Whether the way crosses no wall at all: one that parts nothing by itself, as a low ceiling, may bar the way over another.
INLINE bool way_is_free(const NearWalls *near, real3 a, real3 b, real slack) {
  if (!parting_walls_leave_free(near, a, b, slack)) return false;
  for (uint i = near->parting; i < near->listed_count; ++i)
    if (wall_crossed(near->walls + near->listed[i], a, b, slack)) return false;
  return true;
}

// Whether a wall parts the visible point from a point with that normal, both on surfaces.
OUTLINE bool walls_between(const NearWalls *near, real3 point, real3 normal) {
  real distance = length(point - near->point), slack = (real)WALL_SLACK * distance + near->rounding;
  real low = (real)WALL_STRAIGHT_HEIGHT * distance + 4 * near->rounding, high = (real)WALL_OVER_HEIGHT * distance + low;
  real3 a = near->point + low * near->normal, b = point + low * normal;
  if (parting_walls_leave_free(near, a, b, slack)) return false;
  real3 over_a = near->point + high * near->normal, over_b = point + high * normal;
  return !(way_is_free(near, over_a, over_b, slack) && way_is_free(near, over_a, a, slack) &&
           way_is_free(near, over_b, b, slack));
}
